"""Loose things: a crate of boards and an oak barrel, which floats on its side."""
import numpy as np

import physics
import surfaces as on
from mesh import join
from model import Model
from shapes import Paint, bar, box, closed_box, closed_lathe, grid, lathe, panel, tube
from textures import Sheet


def crate_mesh(d, p, low, size):
    """Boards on corner posts, battens around both ends, a brace on the long sides."""
    x, y, z = size[0] / 2, size[1], size[2] / 2
    t = 0.018
    parts = []
    if d.far:
        return box((0, low + y / 2, 0), size, p["bare"].tinted(0.9, 0.88, 0.85))
    tone = lambda k: p["bare"].tinted(*(np.array([1.0, 0.97, 0.92]) * (1 - 0.09 * ((k * 7) % 5) / 4)))
    n = 4
    h = y / n
    bevel = 0.004 if d.full else 0
    for k in range(n):
        yy = low + (k + 0.5) * h
        for side in (1, -1):
            parts.append(bar((side * (x - t / 2), yy, -z + t), (side * (x - t / 2), yy, z - t), t, h - 0.006, tone(k + side), bevel=0))
            parts.append(bar((-x, yy, side * (z - t / 2)), (x, yy, side * (z - t / 2)), t, h - 0.006, tone(k + 2 * side), bevel=0))
    m = 5
    w = (2 * x) / m
    for k in range(m):
        xx = -x + (k + 0.5) * w
        parts.append(bar((xx, low + y + t / 2, -z), (xx, low + y + t / 2, z), w - 0.007, t, tone(k)))
    parts.append(box((0, low + t / 2, 0), (2 * x - 0.02, t, 2 * z - 0.02), tone(3)))
    f, b = 0.062, 0.022
    for side in (1, -1):
        zz = side * (z + b / 2)
        for xx in (x - f / 2, -x + f / 2):
            parts.append(bar((xx, low - 0.002, zz), (xx, low + y + t, zz), f, b, p["bare"], up=(0, 0, 1), bevel=bevel, ends=False))
        for yy in (low + f / 2, low + y - f / 2):
            parts.append(bar((-x + f, yy, zz), (x - f, yy, zz), b, f, p["bare"]))
        for zz in (z - f / 2, -z + f / 2):
            parts.append(bar((side * (x + b / 2), low - 0.002, zz), (side * (x + b / 2), low + y + t, zz), b, f, p["bare"], up=(0, 0, 1), bevel=bevel))
        parts.append(bar((side * (x + b / 2 - 0.002), low + 0.05, -z + f), (side * (x + b / 2 - 0.002), low + y - 0.03, z - f), f * 0.9, b - 0.004, p["bare"].tinted(.93, .9, .86), up=(side, 0, 0)))
        if d.full:
            a = np.linspace(0, np.pi, 8)
            handle = np.stack([0.09 * np.cos(a), low + y * 0.60 - 0.065 * np.sin(a), side * (z + 0.012 + 0.035 * np.sin(a))], -1)
            parts.append(tube(handle, 0.010, p["rope"], 5))
    return join(parts)


def crate():
    sheet = Sheet("sheet", 512, 512, [("bare", 192, on.weathered), ("rope", 32, on.rope), ("spare", 32, on.steel)], 31)
    p = {"bare": Paint(sheet["bare"], (1.0, 0.93, 0.82)), "rope": Paint(sheet["rope"], (0.85, 0.76, 0.58), whole=True)}
    size, mass = (0.60, 0.46, 0.84), 70.0
    draught = mass / physics.WATER / (0.60 * 0.84)
    model = Model("crate", "loose", [sheet], (6, 25, 500), 0.02)
    model.part("body", lambda d: crate_mesh(d, p, -draught, size))
    model.body("collision", closed_box((-0.30, -draught, -0.42), (0.30, 0.46 - draught, 0.42)))
    model.floats(mass, round(-draught + 0.19, 4), physics.box_inertia(mass, size), 0.84, 0.60)
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model


R, HALF = 0.33, 0.45


def stave_radius(z):
    return 0.275 + (R - 0.275) * (1 - (z / HALF) ** 2)


def barrel_mesh(d, p):
    """Turned about y, then laid along z: staves with their joints, hoops with rivets, sunk heads of boards, the bung on top."""
    count = 20 if d.full else d.sides(16)
    y = np.linspace(-HALF, HALF, d.n(9, 4))
    parts = []
    if d.full:
        for k in range(count):
            a = 2 * np.pi * (k + np.array([0.02, 0.5, 0.98])) / count
            r = stave_radius(y)[:, None] + 0.004 * np.array([-0.8, 0.1, -0.8])
            stave = np.stack([r * np.cos(a), np.broadcast_to(y[:, None], r.shape), r * np.sin(a)], -1)
            tone = 1 - 0.12 * ((k * 11) % 7) / 6
            parts.append(grid(stave, p["oak"].tinted(tone, tone * 0.97, tone * 0.93)))
        parts.append(lathe(np.stack([stave_radius(y) - 0.004, y], -1), 20, p["oak"].tinted(0.25, 0.2, 0.16)))
    else:
        parts.append(lathe(np.stack([stave_radius(y), y], -1), count, p["oak"], across=False))
    n = d.sides(30)
    for yy, w in () if d.far else ((0.415, 0.05), (0.29, 0.045), (0.13, 0.045), (-0.13, 0.045), (-0.29, 0.045), (-0.415, 0.05)):
        r0, r1 = stave_radius(yy - w / 2), stave_radius(yy + w / 2)
        parts.append(lathe(np.array([(r0, yy - w / 2), (r0 + 0.006, yy - w / 2 + 0.001), (r1 + 0.006, yy + w / 2 - 0.001), (r1, yy + w / 2)]), n, p["hoop"]))
        if d.full:
            for k in (-1, 1):
                rivet = lathe(np.array([(0.008, 0), (0.006, 0.004), (0, 0.005)]), 6, p["hoop"]).turn("z", -90).move(0.5 * (r0 + r1) + 0.005, yy, 0.022 * k)
                parts.append(rivet.turn("y", 137 * (1 + int(yy * 100) % 5)))
    for side in (1, -1):
        rim = [(stave_radius(HALF), HALF), (stave_radius(HALF) - 0.022, HALF), (stave_radius(HALF) - 0.026, HALF - 0.035)]
        chime = lathe(np.array(rim), n, p["oak"].tinted(0.8, 0.74, 0.66))
        inner, at = rim[-1]
        boards = 6 if d.full else 1
        head = []
        edges = np.linspace(-inner, inner, boards + 1)
        for k in range(boards):
            x0, x1 = edges[k] + 0.0012, edges[k + 1] - 0.0012
            xs = np.linspace(x0, x1, 5 if d.full else 12)
            zs = np.sqrt(np.maximum(inner ** 2 - xs ** 2, 1e-6))
            outline = np.concatenate([np.stack([xs, np.full(len(xs), at), zs], -1), np.stack([xs, np.full(len(xs), at), -zs], -1)[::-1]])
            tone = 1 - 0.1 * ((k * 5) % 4) / 3
            head.append(panel(outline, 0.01, p["oak"].tinted(tone, tone * .96, tone * .9), bevel=0.0012 if d.full else 0))
        end = join([chime] + head)
        parts.append(end if side > 0 else end.turn("x", 180))
    if not d.far:
        bung = lathe(np.array([(0.032, 0.0), (0.030, 0.012), (0, 0.013)]), d.sides(12), p["oak"].tinted(0.7, 0.6, 0.5)).turn("z", 90).move(-R + 0.0, 0, 0)
        parts.append(bung)
    return join(parts).turn("z", -90).turn("y", 90)


def barrel():
    sheet = Sheet("sheet", 512, 512, [("oak", 160, on.varnished), ("hoop", 64, on.rusty), ("wet", 32, on.old_oak)], 32)
    p = {"oak": Paint(sheet["oak"], (0.74, 0.66, 0.58)), "hoop": Paint(sheet["hoop"], (0.75, 0.72, 0.72))}
    mass = 95.0
    y = np.linspace(-HALF, HALF, 9)
    profile = np.concatenate([[[0, -HALF]], np.stack([stave_radius(y), y], -1), [[0, HALF]]])
    hull = closed_lathe(profile, 16).turn("z", -90).turn("y", 90)
    dy = physics.sink(hull, mass)
    model = Model("barrel", "loose", [sheet], (6, 25, 500), 0.018)
    model.part("body", lambda d: barrel_mesh(d, p).move(y=dy))
    model.body("collision", hull.move(y=dy))
    across, along = mass * 0.75 * 0.30 ** 2, mass * (0.30 ** 2 / 2 + 0.9 ** 2 / 12)
    model.floats(mass, round(dy - 0.045, 4), np.diag([along, along, across]), 0.90, 0.66)
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model
