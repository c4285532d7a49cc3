"""Rooms to look at the sea from: a square diving bell of riveted iron, a room on the sea bed with three round windows, a barge
with a cabin that has one at its waterline, and a hall around a tank of water."""
import numpy as np

import physics
import surfaces as on
from mesh import join
from model import Model
from shapes import Paint, ball, box, closed_box, grid, lathe, rope_path, tube
from textures import Sheet

T = 0.06  # of all walls, m


def papers(seed):
    sheet = Sheet("sheet", 256, 512, [("iron", 192, on.painted_steel), ("rust", 128, on.rusty), ("wood", 128, on.varnished),
                                      ("brass", 32, on.steel), ("rope", 32, on.rope)], seed)
    paints = {"iron": Paint(sheet["iron"], (0.86, 0.88, 0.84)), "hull": Paint(sheet["iron"], (0.30, 0.36, 0.38)),
              "rust": Paint(sheet["rust"], (0.9, 0.86, 0.84)), "wood": Paint(sheet["wood"], (0.8, 0.66, 0.5)),
              "brass": Paint(sheet["brass"], (0.86, 0.66, 0.32)), "rope": Paint(sheet["rope"], (0.85, 0.76, 0.58), whole=True)}
    return sheet, paints


def pierced(w, h, r, d, paint, brass, at=(0.0, 0.0)):
    """A wall of w x h m around z = 0 with a round window of radius r at a place of it, in a ring of brass."""
    x, y = at
    corners = [np.arctan2(sy * h / 2 - y, sx * w / 2 - x) for sx in (-1, 1) for sy in (-1, 1)]
    a = np.unique(np.round(np.concatenate([np.linspace(-np.pi, np.pi, d.sides(40) + 1)[:-1], corners]), 9))
    a = np.concatenate([a, [a[0] + 2 * np.pi]])
    c, s = np.cos(a), np.sin(a)
    far = np.minimum(np.where(c > 0, w / 2 - x, w / 2 + x) / np.maximum(np.abs(c), 1e-9),
                     np.where(s > 0, h / 2 - y, h / 2 + y) / np.maximum(np.abs(s), 1e-9))
    side = lambda z: np.stack([np.stack([x + q * c, y + q * s, np.full(len(a), z)], -1) for q in (r, *(r + (far - r) * k for k in (0.25, 0.5, 0.75)), far)])
    parts = [grid(side(T / 2), paint), grid(side(-T / 2), paint, flip=True)]
    ring = np.linspace(0, 2 * np.pi, d.sides(40) + 1)[:-1]
    path = np.stack([x + (r + 0.02) * np.cos(ring), y + (r + 0.02) * np.sin(ring), np.zeros(len(ring))], -1)
    parts.append(tube(path, 0.055, brass, d.sides(10), caps=False, closed=True))
    if d.full:
        for k in range(12):
            q = 2 * np.pi * (k + 0.5) / 12
            for z in (-1, 1):
                parts.append(ball((x + (r + 0.13) * np.cos(q), y + (r + 0.13) * np.sin(q), z * T / 2), 0.018, brass, 6))
    return join(parts)


def rivets(a, b, count, d, paint):
    if not d.full:
        return []
    return [ball(np.asarray(a) + (np.asarray(b, float) - a) * (k + 0.5) / count, 0.022, paint, 6) for k in range(count)]


def bell_mesh(d, p):
    """Open below; a window in each of two walls, benches along the others, a bridle and its rope."""
    w, h = 2.4, 2.2
    walls = [box((0, h / 2, 0), (w, T, w), p["iron"])]
    for z in (-1, 1):
        walls.append(pierced(w, h, 0.33, d, p["iron"], p["brass"], (0, 0.25)).move(z=z * (w - T) / 2))
    for x in (-1, 1):
        walls.append(box((x * (w - T) / 2, 0, 0), (T, h, w - 2 * T), p["iron"]))
        walls.append(box((x * (w / 2 - T - 0.2), -0.35, 0), (0.4, 0.05, w - 2 * T), p["wood"]))
        walls += rivets((x * w / 2, 0.95, -1.1), (x * w / 2, 0.95, 1.1), 14, d, p["rust"])
        walls += rivets((x * w / 2, -0.95, -1.1), (x * w / 2, -0.95, 1.1), 14, d, p["rust"])
    for x in (-1, 1):
        for z in (-1, 1):
            walls.append(box((x * w / 2, 0, z * w / 2), (0.09, h + 0.06, 0.09), p["rust"]))
            walls.append(tube(rope_path((x * 1.0, h / 2, z * 1.0), (0, h / 2 + 1.3, 0), 0.0, 2), 0.03, p["rust"], d.sides(8)))
    for a in (-1, 1):
        walls.append(box((0, -h / 2, a * w / 2), (w + 0.1, 0.12, 0.12), p["rust"]))
        walls.append(box((a * w / 2, -h / 2, 0), (0.12, 0.12, w), p["rust"]))
    walls.append(tube(rope_path((0, h / 2 + 1.3, 0), (0, 16.0, 0), 0.0, 2), 0.05, p["rope"], d.sides(8)))
    walls.append(lathe(np.array([(0.0, -0.10), (0.12, -0.05), (0.12, 0.05), (0.0, 0.10)]), d.sides(14), p["rust"]).move(y=h / 2 + 1.3))
    return join(walls)


def diving_bell():
    sheet, p = papers(61)
    model = Model("diving_bell", "fixed", [sheet], (8, 30, 600), 0.05)
    model.part("bell", lambda d: bell_mesh(d, p))
    model.body("collision", closed_box((-1.2, 1.04, -1.2), (1.2, 1.1, 1.2)))
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model


def room_mesh(d, p):
    """6 x 2.6 x 4 m within; three windows in its front (-z), benches, a ladder to a hatch."""
    w, h, l = 6.0, 2.6, 4.0
    parts = [box((0, -h / 2 - T / 2, 0), (w + 2 * T, T, l + 2 * T), p["wood"]), box((0, h / 2 + T / 2, 0), (w + 2 * T, T, l + 2 * T), p["iron"]),
             box((0, 0, l / 2 + T / 2), (w + 2 * T, h, T), p["iron"])]
    for x in (-1, 1):
        parts.append(box((x * (w / 2 + T / 2), 0, 0), (T, h, l), p["iron"]))
    for k in (-1, 0, 1):
        parts.append(pierced(2.0, h, 0.62, d, p["iron"], p["brass"], (0, 0.1)).move(x=2.0 * k, z=-l / 2 - T / 2))
    for x in (-2.0, -1.0, 1.0, 2.0):
        parts.append(box((x if abs(x) > 1 else x, h / 2 - 0.06, 0), (0.10, 0.12, l), p["hull"]))
    parts.append(box((0, -h / 2 + 0.42, l / 2 - 0.3), (4.0, 0.06, 0.5), p["wood"]))
    for x in (-1.8, 0, 1.8):
        parts.append(box((x, -h / 2 + 0.2, l / 2 - 0.3), (0.08, 0.4, 0.4), p["hull"]))
    for x in (-0.22, 0.22):
        parts.append(tube(rope_path((2.75, -h / 2, 0.8 + x), (2.75, h / 2, 0.8 + x), 0.0, 2), 0.025, p["brass"], d.sides(8)))
    for y in np.arange(-1.0, 1.25, 0.3):
        parts.append(tube(rope_path((2.75, y, 0.58), (2.75, y, 1.02), 0.0, 2), 0.018, p["brass"], d.sides(7)))
    for x in (-1, 1):
        for z in (-1, 1):
            parts.append(box((x * 2.7, -h / 2 - 0.7, z * 1.7), (0.24, 1.3, 0.24), p["rust"]))
    return join(parts)


def lamps(places, paint):
    return lambda d: None if d.far else {"lamp": join([ball(at, 0.09, paint, d.sides(16)) for at in places])}


def undersea_room():
    sheet, p = papers(62)
    model = Model("undersea_room", "fixed", [sheet], (12, 40, 800), 0.08)
    model.material("lamp", "sheet", emissive=(1.0, 0.8, 0.5))
    model.part("room", lambda d: room_mesh(d, p))
    model.part("lamp", lamps([(-1.5, 1.13, 0), (1.5, 1.13, 0)], p["brass"].tinted(1, .9, .7)), (0, 1.13, 0))
    model.body("collision", closed_box((-3.06, -1.36, -2.06), (3.06, -1.3, 2.06)))
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model


def hall_mesh(d, p):
    """A floor of 26 x 26 m, columns around, and the corners, sill and head of a tank of 5 x 4.6 x 7 m without glass."""
    parts = []
    for k in range(13 if d.full else 1):
        w = 26.0 / (13 if d.full else 1)
        parts.append(box((-13 + (k + 0.5) * w, -0.15, 0), (w - 0.01, 0.3, 26), p["stone"].tinted(*(np.array([0.86, 0.84, 0.8]) * (1 - 0.05 * (k * 5 % 3))))))
    for x in (-9, 9):
        for z in (-9, -3, 3, 9):
            parts.append(lathe(np.array([(0.55, 0.0), (0.55, 0.3), (0.42, 0.4), (0.36, 5.2), (0.5, 5.4), (0.5, 5.6)]), d.sides(24), p["stone"]).move(x, 0, z))
        parts.append(box((x, 5.85, 0), (0.9, 0.5, 20), p["stone"]))
    for z in (-9, 9):
        parts.append(box((0, 5.85, z), (18, 0.5, 0.9), p["stone"]))
    for x in (-1, 1):
        parts.append(box((x * 2.56, 0.12, 0), (0.12, 0.24, 7.24), p["brass"]))
        for z in (-1, 1):
            parts.append(box((x * 2.56, 2.4, z * 3.56), (0.1, 4.8, 0.1), p["brass"]))
    for z in (-1, 1):
        parts.append(box((0, 0.12, z * 3.56), (5.0, 0.24, 0.12), p["brass"]))
    return join(parts)


def aquarium_hall():
    sheet = Sheet("sheet", 256, 512, [("stone", 448, on.concrete), ("brass", 64, on.steel)], 64)
    p = {"stone": Paint(sheet["stone"], (0.9, 0.87, 0.82)), "brass": Paint(sheet["brass"], (0.86, 0.66, 0.32))}
    model = Model("aquarium_hall", "fixed", [sheet], (25, 80, 1500), 0.1)
    model.part("hall", lambda d: hall_mesh(d, p))
    model.body("collision", closed_box((-13, -0.3, -13), (13, 0, 13)))
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model


LOW, HIGH, LONG, BEAM = -0.9, 1.5, 7.0, 2.8


def barge_mesh(d, p):
    """A box of a hull with one cabin, a window of it at the waterline on the port side."""
    w, h, l, y = BEAM, HIGH - LOW, LONG, (LOW + HIGH) / 2
    parts = [box((0, LOW + T / 2, 0), (w, T, l), p["wood"]), box((0, HIGH - T / 2, 0), (w, T, l), p["iron"])]
    parts.append(box(((w - T) / 2, y, 0), (T, h - 2 * T, l), p["iron"]))
    for z in (-1, 1):
        parts.append(box((0, y, z * (l - T) / 2), (w - 2 * T, h - 2 * T, T), p["iron"]))
    wall = pierced(2.0, h - 2 * T, 0.42, d, p["iron"], p["brass"], (0, -y)).turn("y", 90).move(-(w - T) / 2, y, 0)
    parts.append(wall)
    for z in (-1, 1):
        parts.append(box((-(w - T) / 2, y, z * (l / 4 + 0.5)), (T, h - 2 * T, l / 2 - 1.0), p["iron"]))
        parts.append(box((0.0, LOW + 0.45, z * 2.2), (1.6, 0.06, 0.7), p["wood"]))
    parts.append(box((1.0, LOW + 0.45, 0), (0.5, 0.06, 2.4), p["wood"]))
    for x in (-1, 1):
        parts.append(box((x * w / 2, HIGH, 0), (0.12, 0.14, l), p["wood"]))
    return join(parts)


def porthole_barge():
    sheet, p = papers(63)
    mass = physics.WATER * LONG * BEAM * -LOW
    model = Model("porthole_barge", "hull", [sheet], (12, 40, 800), 0.08)
    model.material("lamp", "sheet", emissive=(1.0, 0.8, 0.5))
    model.part("hull", lambda d: barge_mesh(d, p))
    model.part("lamp", lamps([(0.4, 1.3, 0)], p["brass"].tinted(1, .9, .7)), (0.4, 1.3, 0))
    model.body("collision", closed_box((-BEAM / 2, LOW, -LONG / 2), (BEAM / 2, HIGH, LONG / 2)))
    model.body("inside_cabin", closed_box((-BEAM / 2 + T, LOW + T, -LONG / 2 + T), (BEAM / 2 - T, HIGH - T, LONG / 2 - T)))
    model.floats(round(mass, 1), -0.25, physics.box_inertia(mass, (BEAM, HIGH - LOW, LONG)), LONG, BEAM)
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model
