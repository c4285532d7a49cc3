"""A timber pier of 12 m on ten piles, with ladder, fenders, cleats, railing and lamp."""
import numpy as np

import surfaces as on
from mesh import join, overgrow
from model import Model
from shapes import Paint, ball, bar, box, circle, closed_box, closed_lathe, coil, fan, lathe, panel, rect, ring, spline, sweep, tube
from textures import Sheet

sheet = Sheet("sheet", 256, 512, [("grey", 160, on.weathered), ("oak", 128, on.old_oak), ("weed", 96, on.weed), ("steel", 32, on.steel),
                                  ("rust", 32, on.rusty), ("rope", 16, on.rope), ("rubber", 48, on.rubber)], 41)
GREY, OAK = Paint(sheet["grey"], (0.97, 0.93, 0.88)), Paint(sheet["oak"])
WEED, STEEL, RUST = Paint(sheet["weed"], (0.95, 0.95, 0.9)), Paint(sheet["steel"], (0.75, 0.76, 0.76)), Paint(sheet["rust"])
ROPE, RUBBER = Paint(sheet["rope"], (0.9, 0.85, 0.7), whole=True), Paint(sheet["rubber"], (0.08, 0.08, 0.085))
LENGTH, HALF, DECK, BED = 12.0, 1.2, 1.50, -4.5
ROWS = (-5.4, -2.7, 0.0, 2.7, 5.4)


def deck(d):
    parts, rng = [], np.random.RandomState(5)
    count = 80 if not d.far else 1
    w = LENGTH / count
    for k in range(count):
        z = -LENGTH / 2 + (k + 0.5) * w
        jut, tone, lift = rng.uniform(-0.025, 0.025), 1 - 0.16 * rng.uniform(), rng.uniform(-0.002, 0.002)
        tint = GREY.tinted(0.97 * tone, 0.93 * tone, 0.88 * tone)
        a, b = (-HALF - 0.03 + jut, DECK - 0.024 + lift, z), (HALF + 0.03 + jut, DECK - 0.024 + lift, z)
        parts.append(bar(a, b, w - (0.009 if count > 1 else 0), 0.048, tint, bevel=0.004 if d.full else 0, ends=False))
    for x in (-0.95, 0.0, 0.95):
        parts.append(bar((x, DECK - 0.14, -LENGTH / 2 + 0.05), (x, DECK - 0.14, LENGTH / 2 - 0.05), 0.12, 0.18, OAK))
    if not d.far:
        for x in (-1, 1):  # kerbs on blocks
            parts.append(bar((x * 1.14, DECK + 0.10, -LENGTH / 2 + 0.1), (x * 1.14, DECK + 0.10, LENGTH / 2 - 0.1), 0.11, 0.10, GREY.tinted(.85, .8, .74), bevel=0.012))
            for z in np.arange(-5.6, 5.7, 1.4):
                parts.append(box((x * 1.14, DECK + 0.026, z), (0.10, 0.052, 0.22), GREY.tinted(.8, .75, .7)))
    return parts


def pile(x, z, d, top):
    lean = 0.02 * np.sin(9 * x + 5 * z)
    y = np.array([BED, -2.0, -0.6, 0.3, 1.0, top - 0.02, top])
    y = y if not d.far else y[[0, 6]]
    r = np.interp(y, [BED, top], [0.185, 0.155]) * (1 + 0.03 * np.sin(7 * y + 3 * x + z))
    r[-1] *= 0.86
    path = np.stack([x + lean * (y - DECK) * 0.3, y, np.full(len(y), z)], -1)
    return sweep(path, circle(1, d.sides(14)), OAK, up=(0, 0, 1), scale=r)


def structure(d):
    parts = []
    for k, z in enumerate(ROWS):
        for x in (-1, 1):
            tall = x > 0 and k % 2 == 0
            parts.append(pile(x * 1.32, z, d, DECK + (0.75 if tall else 0.10)))
            if tall and d.full:
                parts.append(lathe(np.array([(0.172, -0.05), (0.172, 0.0), (0.10, 0.035), (0, 0.045)]), 14, STEEL).move(x * 1.32, DECK + 0.75, z))
        for y in (DECK - 0.34,):
            for dz in (-0.15, 0.15) if d.full else (0,):
                parts.append(bar((-1.62, y, z + dz), (1.62, y, z + dz), 0.10, 0.22, OAK.tinted(.95, .92, .9), bevel=0 if d.far else 0.01))
        if not d.far:
            for s in (1, -1):
                parts.append(bar((-1.3 * s, -0.1, z + 0.19 * s), (1.3 * s, DECK - 0.5, z + 0.19 * s), 0.06, 0.16, OAK))
        if d.full:
            for x in (-1.32, 1.32):
                for y in (DECK - 0.30, DECK - 0.39):
                    parts.append(lathe(np.array([(0.03, 0), (0.03, 0.012), (0.016, 0.014), (0.016, 0.03), (0, 0.031)]), 6, RUST).turn("x", 90).move(x, y, z + 0.20))
    for x in (-1.32, 1.32):
        if not d.far:
            parts.append(bar((x * 0.9, 0.55, ROWS[0]), (x * 0.9, 0.55, ROWS[-1]), 0.07, 0.18, OAK))
    return parts


def ladder(d):
    x, z = HALF + 0.20, 1.35
    parts = []
    for side in (-0.22, 0.22):
        path = spline([(x, -1.4, z + side), (x, 0.5, z + side), (x, DECK + 0.35, z + side), (x - 0.10, DECK + 0.72, z + side), (x - 0.33, DECK + 0.62, z + side), (x - 0.36, DECK, z + side)], d.n(20))
        parts.append(tube(path, 0.024, STEEL, d.sides(8)))
    for y in np.arange(-1.25, DECK, 0.28):
        parts.append(tube(np.array([[x, y, z - 0.22], [x, y, z + 0.22]]), 0.016, STEEL, d.sides(7), caps=False))
    return parts


def tyre(d, x, y, z):
    if d.far:
        return []
    a = np.linspace(0, 2 * np.pi, d.n(10), endpoint=False)
    section = np.stack([0.10 * np.cos(a), 0.085 * np.sin(a) * (1 + 0.1 * np.cos(2 * a))], -1)
    t = np.arange(d.n(22)) * 2 * np.pi / d.n(22)
    path = np.stack([0 * t, 0.23 * np.sin(t), 0.23 * np.cos(t)], -1)
    out = [sweep(path, section, RUBBER, up=(1, 0, 0), closed=True).move(x, y, z)]
    for s in (-0.08, 0.08):
        out.append(tube(np.array([[x - 0.02, y + 0.2, z + s * 0.4], [x + 0.02, DECK - 0.1, z + s], [x - 0.1, DECK + 0.10, z + s]]), 0.012, ROPE, d.sides(6)))
    return out


def cleat(d, x, y, z):
    """A horned cleat of cast iron, 0.4 m."""
    k = np.linspace(-1, 1, 9)
    horn = np.stack([np.full(9, x), y + 0.075 + 0.035 * k ** 2, z + 0.2 * k], -1)
    parts = [tube(horn, 0.028, RUST, d.sides(8), scale=1 - 0.55 * k ** 4)]
    for s in (-0.07, 0.07):
        parts.append(lathe(np.array([(0.045, 0), (0.03, 0.03), (0.03, 0.085)]), d.sides(8), RUST).move(x, y, z + s))
    parts.append(box((x, y + 0.006, z), (0.12, 0.014, 0.26), RUST))
    return parts


def fittings(d):
    parts = []
    for z in (-4.0, -1.2, 4.0):
        parts += tyre(d, HALF + 0.23, DECK - 0.72, z)
    if d.far:
        return parts
    parts += ladder(d)
    for z in (-4.6, -0.5, 3.4):
        parts += cleat(d, 1.0, DECK, z)
    # Railing on the other side: posts, a top rail, a rope below.
    for z in np.arange(-5.6, 5.7, 1.6):
        parts.append(bar((-1.08, DECK - 0.1, z), (-1.08, DECK + 1.02, z), 0.09, 0.09, GREY, bevel=0.008, up=(0, 0, 1)))
    parts.append(bar((-1.08, DECK + 1.05, -5.75), (-1.08, DECK + 1.05, 5.75), 0.14, 0.045, GREY, bevel=0.008))
    for k, z in enumerate(np.arange(-5.6, 4.1, 1.6)):
        t = np.linspace(0, 1, d.n(8))
        path = np.stack([np.full(len(t), -1.03), DECK + 0.56 - 0.28 * t * (1 - t), z + 1.6 * t], -1)
        parts.append(tube(path, 0.014, ROPE, d.sides(6), caps=False))
    if d.full:
        parts.append(coil((0.62, DECK, -4.55), 0.22, 0.016, 9, ROPE))
        parts.append(tube(spline([(0.80, DECK + .02, -4.4), (0.92, DECK + .04, -4.5), (1.0, DECK + 0.06, -4.66), (1.03, DECK + .08, -4.55), (0.97, DECK + .10, -4.5), (1.0, DECK + .11, -4.7)], 20), 0.016, ROPE, 5))
    return parts


def lamp_post(d):
    if d.far:
        return []
    x, z = -1.08, -5.6
    arm = spline([(x, DECK + 1.0, z), (x, DECK + 2.9, z), (x + 0.12, DECK + 3.28, z), (x + 0.45, DECK + 3.38, z), (x + 0.62, DECK + 3.28, z)], d.n(20))
    shade = lathe(np.array([(0.17, 0.0), (0.16, 0.03), (0.07, 0.09), (0.035, 0.17), (0, 0.18)]), d.sides(18), STEEL.tinted(0.12, 0.2, 0.16))
    under = lathe(np.array([(0.0, 0.085), (0.06, 0.085), (0.158, 0.02), (0.17, 0.0)]), d.sides(18), STEEL.tinted(0.9, 0.9, 0.85))
    return [tube(arm, 0.032, STEEL.tinted(0.2, 0.28, 0.24), d.sides(10)), join([shade, under]).move(x + 0.62, DECK + 3.12, z)]


def build():
    model = Model("pier", "fixed", [sheet], (22, 80, 2500), 0.06)
    model.material("lamp", "sheet", emissive=(1.0, 0.85, 0.6))
    model.part("pier", lambda d: overgrow(join(deck(d) + structure(d) + fittings(d) + lamp_post(d)), [OAK, STEEL, RUBBER, ROPE, GREY], WEED, 0.32))
    at = (-0.46, DECK + 3.16, -5.6)
    model.part("lamp", lambda d: None if d.far else {"lamp": ball(at, 0.055, STEEL.tinted(1, .95, .8), d.sides(12))}, at)
    deck_body = closed_box((-1.25, DECK - 0.24, -LENGTH / 2), (1.25, DECK, LENGTH / 2))
    piles = [closed_lathe([(0, BED), (0.18, BED), (0.16, DECK - 0.25), (0, DECK - 0.25)], 6).move(x, 0, z) for z in ROWS for x in (-1.32, 1.32)]
    model.body("collision", join([deck_body] + piles))
    model.extras.update({"length_m": LENGTH, "beam_m": 2.64, "deck_m": DECK, "seats": [],
                         "grips": [{"name": "ladder", "at_m": [1.40, 1.9, 1.35], "axis": [0, 1, 0], "range_m": [-3.3, 0.3]}],
                         "lights": [{"at_m": list(at), "colour": "warm_white", "sector_deg": [0, 360], "range_m": 900, "node": "lamp"}],
                         "cleats": [[1.0, DECK, z] for z in (-4.6, -0.5, 3.4)]})
    return model
