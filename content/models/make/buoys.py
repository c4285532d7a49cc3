"""Buoys: two lateral marks of steel (IALA region A: red can to port, green cone to starboard) and a mooring buoy."""
import numpy as np

import physics
import surfaces as on
from mesh import cut, join, linear, overgrow
from model import Model
from shapes import Paint, bar, closed_lathe, grid, lathe, panel, ring, spline, tube
from textures import Sheet

STRIPS = [("steel_paint", 128, on.painted_steel), ("weed", 96, on.weed), ("rust", 64, on.rusty), ("steel", 32, on.steel),
          ("rubber", 64, on.rubber), ("rope", 32, on.rope), ("glass", 32, on.glass), ("moulding", 64, on.moulding)]


def paints(sheet, colour):
    p = {name: Paint(sheet[name]) for name, _, _ in STRIPS}
    p["rope"].whole = True
    p["body"] = p["steel_paint"].tinted(*colour)
    p["black"] = p["rubber"].tinted(0.10, 0.10, 0.11)
    return p


def growth(m, p, tide=0.06):
    return overgrow(m, [p["steel_paint"], p["rust"], p["moulding"]], p["weed"].tinted(0.95, 0.95, 0.95), tide, 0.012)


FLOAT = [(0, -1.75), (0.20, -1.75), (0.20, -1.55), (0.11, -1.5), (0.11, -0.72), (0.30, -0.66), (0.74, -0.42), (0.76, -0.36), (0.76, 0.26), (0.72, 0.34), (0, 0.40)]


def lateral_body(d, p):
    n = d.sides(40)
    if d.far:
        return [lathe(np.array([FLOAT[k] for k in (0, 1, 4, 5, 6, 8, 10)]), n, p["body"])]
    parts = [lathe(np.array(FLOAT[:6]), d.sides(16), p["rust"])]
    parts.append(lathe(np.array([(0.11, -0.74), (0.30, -0.66), (0.74, -0.42), (0.758, -0.40), (0.76, -0.36), (0.76, 0.0), (0.76, 0.24), (0.755, 0.28), (0.72, 0.34), (0.40, 0.385), (0.3, 0.39)]), n, p["body"]))
    # The rubbing band, and the flange to which the mark is bolted.
    parts.append(lathe(np.array([(0.755, 0.10), (0.805, 0.115), (0.815, 0.15), (0.805, 0.185), (0.755, 0.20)]), n, p["black"]))
    parts.append(lathe(np.array([(0.30, 0.375), (0.455, 0.385), (0.46, 0.39), (0.46, 0.425), (0.455, 0.43), (0.3, 0.43)]), n, p["body"].tinted(*(0.8 * np.array(p["body"].colour)))))
    if not d.far:
        for k in range(16 if d.full else 0):
            bolt = lathe(np.array([(0.017, 0.43), (0.017, 0.448), (0.010, 0.449), (0.010, 0.462), (0, 0.464)]), 6, p["steel"])
            parts.append(bolt.move(0.425).turn("y", k * 22.5))
        for side in (1, -1):
            eye = join([bar((-0.045, 0.33, 0), (-0.045, 0.42, 0), 0.02, 0.05, p["body"]), bar((0.045, 0.33, 0), (0.045, 0.42, 0), 0.02, 0.05, p["body"]),
                        tube(np.array([[0.045 * np.cos(a), 0.42 + 0.045 * np.sin(a), 0] for a in np.linspace(0, np.pi, 8)]), 0.016, p["body"], 6)])
            parts.append(eye.turn("y", 25).move(0, 0, 0.60 * side))
        parts.append(ring((0, -1.80, 0), (0, 0, 1), 0.08, 0.022, p["rust"], d.n(16), 6))
        for k in range(4):
            parts.append(ring((0, -1.92 - 0.14 * k, 0), (0, 0, 1) if k % 2 else (1, 0, 0), 0.055, 0.018, p["rust"], d.n(14), d.sides(6)).scale(1, 1, 1))
    return parts


def lateral_mark(d, p, port):
    """The daymark: a plated can or cone with ribs, ladder rungs, a number plate and a lantern's stand."""
    n = d.sides(36)
    y0, y1 = 0.43, 1.95
    at = (lambda y: 0.45) if port else (lambda y: 0.46 - 0.42 * (y - 0.62) / (y1 + 0.10 - 0.62) if y > 0.62 else 0.46)
    rows = [0.43, 0.62, 0.95, 1.3, 1.65, 1.95] if d.full else [0.43, 0.62, 1.95]
    profile = [(at(y), y) for y in rows]
    if port:
        profile += [(0.44, 1.97), (0, 2.0)]
    else:
        profile += [(0.03, 2.0), (0, 2.0)]
    parts = [lathe(np.array(profile), n, p["body"])]
    for y in () if d.far else ([0.62, 1.28, 1.94] if port else [0.62, 1.1]):
        r = at(y)
        parts.append(lathe(np.array([(r - 0.002, y - 0.03), (r + 0.016, y - 0.022), (r + 0.016, y + 0.022), (r - 0.002, y + 0.03)]), n, p["body"].tinted(*(0.85 * np.array(p["body"].colour)))))
    if d.far:
        return parts
    for y in np.arange(0.72, 1.9, 0.26):
        r = at(y)
        if r > 0.16:
            a = np.array([[-0.14, y, r * 0.96], [-0.14, y, r + 0.07], [0.14, y, r + 0.07], [0.14, y, r * 0.96]])
            parts.append(tube(a, 0.011, p["steel"], d.sides(6)).turn("y", 180))
    white = p["steel_paint"].tinted(0.95, 0.95, 0.93)
    r = at(1.12)
    a = np.linspace(-0.32, 0.32, 7)
    tilt = 0 if port else 0.42 / 1.43
    plate = np.array([[[np.sin(t) * (r + 0.014 - tilt * h), 1.12 + h, np.cos(t) * (r + 0.014 - tilt * h)] for h in (-0.17, 0, 0.17)] for t in a])
    parts.append(grid(plate, white))
    ink = p["steel_paint"].tinted(0.08, 0.08, 0.08)
    one = [(-0.02, -0.11, 0.02, 0.11), (-0.06, 0.06, -0.02, 0.10)]
    two = [(-0.07, 0.07, 0.07, 0.11), (0.03, 0.0, 0.07, 0.07), (-0.07, -0.02, 0.07, 0.02), (-0.07, -0.11, -0.03, 0.0), (-0.07, -0.11, 0.07, -0.07)]
    for x0, h0, x1, h1 in two if port else one:  # even numbers to port
        corner = lambda x, h: [x, 1.12 + h, np.sqrt((r + 0.017 - tilt * h) ** 2 - x * x) + 0.002]
        parts.append(panel(np.array([corner(x0, h0), corner(x1, h0), corner(x1, h1), corner(x0, h1)]), 0.004, ink))
    return parts


def lantern(d, p):
    """Stand, solar panels and cap: what stays dark. The lens is a part of its own."""
    if d.far:
        return []
    parts = [lathe(np.array([(0.10, 1.98), (0.10, 2.02), (0.035, 2.03), (0.035, 2.13), (0.085, 2.14), (0.085, 2.16), (0.0, 2.161)]), d.sides(16), p["steel"])]
    parts.append(lathe(np.array([(0.0, 2.279), (0.085, 2.28), (0.085, 2.30), (0.05, 2.325), (0, 2.33)]), d.sides(16), p["steel"]))
    if not d.far:
        for k in range(3):
            solar = panel(np.array([[-0.10, 2.0, 0.06], [0.10, 2.0, 0.06], [0.10, 2.14, 0.015], [-0.10, 2.14, 0.015]]) + [0, 0, 0.07], 0.012, p["glass"].tinted(0.08, 0.10, 0.20))
            parts.append(solar.turn("y", 120 * k + 60))
        parts.append(tube(np.array([[0, 2.32, 0], [0, 2.48, 0]]), 0.004, p["steel"], 5))
    return parts


def lateral(name, port):
    colour = (0.80, 0.10, 0.07) if port else (0.05, 0.42, 0.20)
    sheet = Sheet("sheet", 256, 512, STRIPS, 21)
    p = paints(sheet, colour)
    model = Model(name, "buoy", [sheet], (14, 60, 2500), 0.035)
    model.material("lens", "sheet", emissive=(0.9, 0.05, 0.03) if port else (0.03, 0.8, 0.25))
    model.part("body", lambda d: growth(join(lateral_body(d, p) + lateral_mark(d, p, port) + lantern(d, p)), p))
    model.part("lamp", lambda d: {"lens": lathe(np.array([(0.07, 2.16), (0.078, 2.19), (0.082, 2.22), (0.078, 2.25), (0.07, 2.28)]), d.sides(16), p["glass"].tinted(*colour))}, (0, 2.22, 0))
    at = [(0, -1.75), (0.20, -1.75), (0.20, -1.55), (0.11, -0.72), (0.74, -0.42), (0.76, 0.26), (0.45, 0.43), (0.45, 1.95), (0, 2.0)]
    model.body("collision", closed_lathe(at, 16))
    mass = round(physics.displaced(model.bodies["collision"])[0] * physics.WATER, 1)
    roll = mass * (0.45 ** 2 + 1.0 ** 2)
    model.floats(mass, -0.55, np.diag([roll, mass * 0.42 ** 2, roll]), 1.52, 1.52)
    model.extras["seats"], model.extras["grips"] = [], []
    model.extras["lights"] = [{"at_m": [0, 2.22, 0], "colour": "red" if port else "green", "sector_deg": [0, 360], "range_m": 5500, "flash_s": [0.5, 2.0], "node": "lamp"}]
    model.extras["moored_at_m"] = [0, -2.3, 0]
    return model


def port():
    return lateral("buoy_lateral_port", True)


def starboard():
    return lateral("buoy_lateral_starboard", False)


def mooring_body(d, p):
    n = d.sides(36)
    a = np.linspace(-np.pi / 2, np.pi / 2, d.n(24))
    shell = lathe(np.stack([0.45 * np.cos(a), 0.20 + 0.45 * np.sin(a)], -1), n, p["moulding"].tinted(0.93, 0.92, 0.88))
    for y in (0.22, 0.38):
        shell = cut(shell, "y", y)
    c = shell.centres()[:, 1]
    shell.c[(c > 0.22) & (c < 0.38)] = linear((0.06, 0.20, 0.50))
    parts = [shell]
    # The moulded seam, the plates of the tie rod, and its eye.
    parts.append(lathe(np.array([(0.445, 0.190), (0.455, 0.194), (0.455, 0.206), (0.445, 0.210)]), n, p["moulding"].tinted(0.86, 0.85, 0.8)))
    parts.append(lathe(np.array([(0.13, 0.628), (0.13, 0.648), (0.12, 0.655), (0.02, 0.66), (0.02, 0.70), (0, 0.70)]), d.sides(20), p["steel"].tinted(0.8, 0.78, 0.74)))
    parts.append(lathe(np.array([(0.0, -0.275), (0.12, -0.27), (0.12, -0.245)]), d.sides(20), p["rust"]))
    if not d.far:
        parts.append(ring((0, 0.755, 0), (0, 0, 1), 0.065, 0.017, p["steel"].tinted(0.8, 0.76, 0.7), d.n(22), d.sides(9)))
        for k in range(6):
            parts.append(ring((0, -0.33 - 0.10 * k, 0), (0, 0, 1) if k % 2 else (1, 0, 0), 0.045, 0.013, p["rust"], d.n(14), d.sides(6)))
        # A pick-up line spliced to the ring, lying over the shoulder into the water.
        line = [[0.0, 0.83, 0.0], [0.05, 0.79, 0.02], [0.17, 0.67, 0.06], [0.33, 0.53, 0.12], [0.435, 0.33, 0.16], [0.47, 0.16, 0.17], [0.49, 0.0, 0.17], [0.50, -0.35, 0.15]]
        parts.append(tube(spline(line, d.n(26)), 0.013, p["rope"].tinted(0.35, 0.55, 0.75), d.sides(7)))
        parts.append(tube(np.array([[0, 0.81, -0.02], [0, 0.845, 0], [0.02, 0.83, 0.01]]), 0.016, p["rope"].tinted(0.35, 0.55, 0.75), d.sides(7)))
        if d.full:
            for k in range(6):
                parts.append(lathe(np.array([(0.012, 0.655), (0.012, 0.668), (0, 0.67)]), 6, p["steel"]).move(0.085).turn("y", 60 * k))
    return growth(join(parts), p, 0.05)


def mooring():
    sheet = Sheet("sheet", 512, 512, STRIPS, 22)
    p = paints(sheet, (1, 1, 1))
    model = Model("buoy_mooring", "buoy", [sheet], (8, 30, 900), 0.018)
    model.part("body", lambda d: mooring_body(d, p))
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    profile = np.stack([0.45 * np.cos(a), 0.20 + 0.45 * np.sin(a)], -1)
    profile[[0, -1], 0] = 0
    model.body("collision", closed_lathe(profile, 16))
    mass = round(physics.displaced(model.bodies["collision"])[0] * physics.WATER, 1)
    model.floats(mass, 0.02, np.diag([mass * 0.09, mass * 0.08, mass * 0.09]), 0.9, 0.9)
    model.extras.update({"seats": [], "grips": [], "lights": [], "mooring_ring_m": [0, 0.755, 0], "moored_at_m": [0, -0.9, 0]})
    return model
