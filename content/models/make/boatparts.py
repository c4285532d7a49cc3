"""What boats have in common: planking, decks, walls with windows, deck gear, steering, propellers."""
import numpy as np

from mesh import Mesh, cut, join, linear
from shapes import ball, bar, box, circle, fan, grid, lathe, lengths, panel, rect, ring, spline, sweep, tube


def strakes(loft, t, breaks, paint, rows=2, groove=0.0):
    """Carvel planking, one strip of texture a plank: starboard, facing outwards."""
    parts = []
    for a, b in zip(breaks[:-1], breaks[1:]):
        p = loft.points(t, np.linspace(a, b, rows))
        parts.append(grid(p, paint, flip=True, v=np.linspace(1, 0, rows)))
    out = join(parts)
    out.g[:] = 0  # the planks are fair: one smooth surface
    return out


def even_breaks(loft, t, low, high, count):
    """Girths between low and high that divide the section at t evenly."""
    s = np.linspace(low, high, 81)
    return np.interp(np.linspace(0, 1, count + 1), lengths(loft.points([t], s)[0]) / lengths(loft.points([t], s)[0])[-1], s)


def painted_bottom(mesh, loft_paints, bottom, stripe, y0, y1, bottom_paint_only=None):
    """Bottom paint below y0, a boot-top stripe up to y1, grime that fades out above it, on surfaces of the given paints."""
    for y in (y0, y1, y1 + 0.25):
        mesh = cut(mesh, "y", y)
    c, middle = mesh.centres()[:, 1], mesh.uv[:, :, 1].mean(1)
    for paint in loft_paints:
        s, b = paint.skin, bottom.skin
        ours = np.abs(middle - (s.v0 + s.v1) / 2) < (s.v1 - s.v0) / 2
        low = ours & (c < y0)
        mesh.uv[low, :, 1] = b.v0 + (mesh.uv[low, :, 1] - s.v0) / (s.v1 - s.v0) * (b.v1 - b.v0)
        mesh.c[low] = linear(bottom.colour)
        mesh.c[ours & (c > y0) & (c < y1)] = linear(stripe)
        fade = np.clip(1 - (mesh.p[:, :, 1] - y1) / 0.25, 0, 1)[..., None]
        grime = 1 - fade * (1 - np.array([0.78, 0.76, 0.62]))
        mesh.c = np.where((ours & (c > y1))[:, None, None], mesh.c * grime, mesh.c)
    return mesh


def deck(edge, paint, lane, camber=0.0, y=None, inner=None):
    """A planked deck between the sides: edge (n, 3) starboard, bow first. Lanes of texture run along the boat.

    inner: half widths (n) where the deck starts (side decks), else it reaches across.
    """
    edge = np.asarray(edge, float)
    start = np.zeros(len(edge)) if inner is None else np.asarray(inner, float)
    parts, x0 = [], 0.0
    while x0 < edge[:, 0].max():
        a, b = np.clip(x0, start, edge[:, 0]), np.clip(x0 + lane, start, edge[:, 0])
        rows = []
        for x in (a, b):
            lift = camber * (1 - (x / np.maximum(edge[:, 0], 1e-6)) ** 2)
            rows.append(np.stack([x, edge[:, 1] + lift, edge[:, 2]], -1))
        if (b - a).max() > 1e-6:
            parts.append(grid(np.stack(rows, 1), paint, v=np.array([0, lane])))
        x0 += lane
    out = join(parts)
    out.g[:] = 0
    return out.both_sides()


def wall(a, b, c, d, windows, paint, frame, thickness=0.05, frame_width=0.05, glass=None):
    """A wall with window holes. Corners: a, b below (left to right seen from outside), c, d above (right, left).

    windows: (u0, v0, u1, v1) as shares of the wall. Gives the wall and, with a paint for it, the glass.
    """
    a, b, c, d = (np.asarray(q, float) for q in (a, b, c, d))
    normal = np.cross(b - a, d - a)
    normal /= np.linalg.norm(normal)
    at = lambda u, v: (a * (1 - u) + b * u) * (1 - v) + (d * (1 - u) + c * u) * v
    us = sorted({0.0, 1.0} | {w[0] for w in windows} | {w[2] for w in windows})
    vs = sorted({0.0, 1.0} | {w[1] for w in windows} | {w[3] for w in windows})
    parts, panes = [], []
    width, height = np.linalg.norm(b - a), np.linalg.norm(d - a)
    for u0, u1 in zip(us[:-1], us[1:]):
        for v0, v1 in zip(vs[:-1], vs[1:]):
            u, v = (u0 + u1) / 2, (v0 + v1) / 2
            if any(w[0] < u < w[2] and w[1] < v < w[3] for w in windows):
                continue
            q = np.array([[at(u0, v0), at(u0, v1)], [at(u1, v0), at(u1, v1)]])
            parts.append(grid(q, paint))
            parts.append(grid(q - normal * thickness, paint, flip=True))
    for w in windows:
        hole = np.array([at(w[0], w[1]), at(w[2], w[1]), at(w[2], w[3]), at(w[0], w[3])])
        loop = np.concatenate([hole, hole[:1]])
        parts.append(grid(np.stack([loop, loop - normal * thickness], 1), paint))
        if frame is not None:
            for p, q in zip(loop[:-1], loop[1:]):
                t = (q - p) / np.linalg.norm(q - p) * frame_width * 0.5
                parts.append(bar(p - t + normal * 0.006, q + t + normal * 0.006, frame_width, 0.024, frame, up=normal))
        if glass is not None:
            panes.append(panel(hole - normal * thickness * 0.5, 0.008, glass))
    rim = np.array([a, b, c, d])
    loop = np.concatenate([rim, rim[:1]])
    parts.append(grid(np.stack([loop, loop - normal * thickness], 1), paint, flip=True))
    return join(parts), join(panes)


def bollard(d, at, paint, height=0.28):
    """Twin mooring bitts on a plate, along z."""
    x, y, z = at
    parts = [box((x, y + 0.008, z), (0.14, 0.016, 0.42), paint)]
    for s in (-0.12, 0.12):
        parts.append(lathe(np.array([(0.045, 0), (0.045, height - 0.03), (0.062, height - 0.02), (0.062, height), (0.04, height + 0.012), (0, height + 0.014)]), d.sides(10), paint).move(x, y, z + s))
    return join(parts)


def horn_cleat(d, at, paint, length=0.25):
    x, y, z = at
    k = np.linspace(-1, 1, d.n(9))
    horn = np.stack([np.full(len(k), x), y + length * (0.18 + 0.07 * k ** 2), z + length / 2 * k], -1)
    parts = [tube(horn, length * 0.065, paint, d.sides(8), scale=1 - 0.55 * k ** 4)]
    for s in (-0.16, 0.16):
        parts.append(lathe(np.array([(0.10 * length, 0), (0.07 * length, 0.05 * length), (0.07 * length, 0.2 * length)]), d.sides(8), paint).move(x, y, z + s * length))
    return join(parts)


def life_ring(d, at, axis, orange, white, rope):
    """A life-buoy of 0.72 m with white bands and a grab line."""
    at = np.asarray(at, float)
    n = d.n(32, 8)
    m = ring((0, 0, 0), (0, 0, 1), 0.28, 0.06, orange, n, d.sides(12)).scale(1, 1, 0.8)
    angle = np.arctan2(m.centres()[:, 1], m.centres()[:, 0])
    band = np.abs(((angle / (np.pi / 2) + 0.5) % 1) - 0.5) < 0.14
    m.c[band] = linear(white.colour)
    parts = [m]
    if d.full:
        a = np.linspace(0, 2 * np.pi, 41)
        r = 0.345 + 0.018 * np.abs(np.sin(2 * a))
        parts.append(tube(np.stack([r * np.cos(a), r * np.sin(a), 0 * a], -1), 0.007, rope, 5, caps=False))
    out = join(parts)
    if axis == "x":
        out = out.turn("y", 90)
    return out.move(*at)


def propeller(d, at, radius, blades, paint, pitch=0.8):
    """A screw about the z axis; blades twist to the pitch (in diameters)."""
    parts = [lathe(np.array([(0, -0.22 * radius), (0.16 * radius, -0.2 * radius), (0.19 * radius, 0.1 * radius), (0.12 * radius, 0.3 * radius), (0, 0.36 * radius)]), d.sides(14), paint).turn("x", 90)]
    r = np.linspace(0.15, 1, d.n(8, 3)) * radius
    for k in range(blades):
        rows = []
        for q in r:
            twist = np.arctan2(pitch * 2 * radius, 2 * np.pi * q)
            chord = radius * 0.62 * np.sqrt(max(1 - (q / radius) ** 4, 0.02))
            c = np.linspace(-0.5, 0.5, 5) * chord
            sweep_back = 0.12 * q * q / radius
            angle = (c * np.cos(twist) + sweep_back) / q
            z = c * np.sin(twist)
            rows.append(np.stack([q * np.sin(angle), q * np.cos(angle), z], -1))
        rows = np.array(rows)
        thick = 0.02 * radius * np.linspace(1, 0.3, len(r))[:, None, None] * np.array([0.2, 1, 1, 1, 0.2])[None, :, None] * np.array([0.3, 0, 1])
        blade = join([grid(rows + thick, paint), grid(rows - thick, paint, flip=True)])
        parts.append(blade.turn("z", 360 * k / blades))
    return join(parts).move(*at)


def steering_wheel(d, centre, radius, tilt, rim, spoke, spokes=5, rim_r=0.016):
    """A wheel that faces aft (+z), tilted back by degrees about x."""
    parts = [ring((0, 0, 0), (0, 0, 1), radius, rim_r, rim, d.n(32, 8), d.sides(8))]
    for k in range(spokes):
        a = 2 * np.pi * k / spokes + np.pi / 2
        parts.append(bar((0, 0, -0.02), (radius * np.cos(a), radius * np.sin(a), 0), 0.022, 0.008, spoke, up=(0, 0, 1)))
    parts.append(lathe(np.array([(0.05, 0), (0.05, 0.02), (0.03, 0.035), (0, 0.04)]), d.sides(14), spoke).turn("x", 90).move(z=-0.03))
    return join(parts).turn("x", tilt).move(*centre)


def lever(d, base, height, paint, knob, lean=0.0):
    """A throttle lever standing on its pivot at `base`, its knob at the top."""
    top = np.array([0, height, 0.0])
    parts = [tube(np.array([[0, 0, 0], top]), 0.010, paint, d.sides(8)), ball(top, 0.026, knob, d.sides(12)),
             lathe(np.array([(0.03, -0.015), (0.03, 0.015), (0, 0.016)]), d.sides(12), paint).turn("z", 90).move(0.015)]
    return join(parts).turn("x", lean).move(*base)


def lamp(d, at, colour, metal, glass, r=0.05):
    """A navigation light: base, lens and cap."""
    return join([lathe(np.array([(r, 0), (r, 0.3 * r), (0.8 * r, 0.35 * r)]), d.sides(9), metal), lathe(np.array([(0.8 * r, 0.35 * r), (0.85 * r, 1.0 * r), (0.8 * r, 1.7 * r)]), d.sides(9), glass.tinted(*colour)),
                 lathe(np.array([(0.8 * r, 1.7 * r), (r, 1.75 * r), (r, 2 * r), (0, 2.2 * r)]), d.sides(9), metal)]).move(*at)


def seat(d, at, size, cushion, shell):
    """A helm seat facing forward on a pedestal that stands on y of `at`; the seat's top at size[1]."""
    x, y, z = at
    w, h, depth = size
    parts = [lathe(np.array([(0.16, 0), (0.15, 0.02), (0.05, 0.04), (0.045, h - 0.14)]), d.sides(14), shell).move(x, y, z),
             box((x, y + h - 0.11, z), (w, 0.06, depth), shell, bevel=0.012), box((x, y + h - 0.04, z), (w * 0.96, 0.08, depth * 0.96), cushion, bevel=0.03)]
    back = bar((x, y + h - 0.02, z + depth / 2 - 0.02), (x, y + h + 0.42, z + depth / 2 + 0.07), w * 0.92, 0.08, cushion, up=(0, 0, 1), bevel=0.03)
    return join(parts + [back])


def winch(d, at, paint, drum, r=0.055):
    """A sheet winch standing on a deck."""
    s = r / 0.055
    body = lathe(np.array([(0.062, 0), (0.062, 0.02), (0.045, 0.03), (0.040, 0.08), (0.054, 0.113), (0.054, 0.125)]) * s, d.sides(14), paint)
    top = lathe(np.array([(0.054, 0.125), (0.05, 0.14), (0.012, 0.146), (0, 0.14)]) * s, d.sides(14), drum)
    return join([body, top]).move(*at)


def round_bow_anchor(d, at, paint):
    """A plough anchor on its roller, its shank along z, the plough forward and down."""
    shank = sweep(spline([(0, 0, 0.55), (0, 0.01, 0.1), (0, -0.02, -0.12), (0, -0.12, -0.25)], d.n(10)), rect(0.03, 0.06, 0.006), paint)
    half = np.array([[[0, -0.30, -0.02], [0.02, -0.22, 0.06]], [[0, -0.22, -0.24], [0.13, -0.08, -0.14]], [[0, -0.08, -0.36], [0.05, 0.03, -0.32]]])
    blade = join([grid(half, paint), grid(half - [0, 0.02, 0], paint, flip=True)])
    return join([shank, blade, blade.mirror()]).move(*at)
