"""A wooden fishing boat of 12 m, 19 t: carvel hull, wheelhouse forward, net drum and gantry aft."""
import numpy as np

import boatparts as gear
import physics
import surfaces as on
from hull import Loft, closed_from
from mesh import join
from model import Model
from shapes import Paint, bar, box, circle, closed_box, coil, grid, lathe, panel, rect, rope_path, spline, sweep, tube, upward
from textures import Sheet

# Keel to deck edge, then the bulwark.
STATIONS = [
    [(.03, .55, -4.9), (.03, .9, -5.25), (.03, 1.4, -5.5), (.03, 2.0, -5.75), (.03, 2.75, -5.95), (.03, 3.1, -6.05), (.03, 3.45, -6.15)],
    [(.05, .15, -4.2), (.45, .25, -4.2), (.95, .75, -4.25), (1.25, 1.7, -4.3), (1.6, 2.45, -4.4), (1.66, 2.8, -4.42), (1.74, 3.15, -4.45)],
    [(.06, 0, -2), (1.2, -.05, -2), (1.85, .55, -2), (1.9, 1.4, -2), (2.0, 2.12, -2), (2.03, 2.45, -2), (2.05, 2.78, -2)],
    [(.06, 0, .8), (1.5, -.1, .8), (2.1, .5, .8), (2.05, 1.3, .8), (2.1, 1.9, .8), (2.1, 2.2, .8), (2.1, 2.5, .8)],
    [(.06, .2, 3.6), (1.15, .25, 3.6), (1.95, .75, 3.6), (1.95, 1.4, 3.6), (2.0, 1.92, 3.6), (2.0, 2.22, 3.6), (2.0, 2.5, 3.6)],
    [(.06, .95, 5.55), (.9, .98, 5.6), (1.62, 1.15, 5.65), (1.72, 1.6, 5.75), (1.75, 2.0, 5.8), (1.75, 2.3, 5.85), (1.74, 2.62, 5.9)]]
PIECES = [(0, 1, 2, 3, 4), (4, 5, 6)]
MASS = 19000.0

sheet = Sheet("sheet", 256, 1024, [("carvel", 64, on.carvel), ("painted", 96, on.painted), ("deck", 96, on.deck_planks), ("antifouling", 64, on.antifouling),
                                   ("steel", 32, on.steel), ("paint_steel", 64, on.painted_steel), ("rope", 16, on.rope), ("rubber", 48, on.rubber),
                                   ("net", 32, on.net)], 71)
BLUE, WHITE, RED = (0.07, 0.24, 0.44), (0.92, 0.92, 0.88), (0.46, 0.15, 0.11)
HULL = Paint(sheet["carvel"], BLUE, whole=True)
INSIDE = Paint(sheet["painted"], (0.70, 0.74, 0.70))
HOUSE = Paint(sheet["painted"], WHITE)
TRIM = Paint(sheet["painted"], (0.62, 0.28, 0.10))
DECK = Paint(sheet["deck"], (0.98, 0.95, 0.9), whole=True)
BOTTOM = Paint(sheet["antifouling"], RED)
STEEL, IRON = Paint(sheet["steel"], (0.72, 0.72, 0.72)), Paint(sheet["paint_steel"], (0.13, 0.14, 0.15))
ORANGE, GREEN = Paint(sheet["paint_steel"], (0.95, 0.38, 0.06)), Paint(sheet["paint_steel"], (0.10, 0.36, 0.24))
ROPE, RUBBER = Paint(sheet["rope"], (0.32, 0.50, 0.62), whole=True), Paint(sheet["rubber"], (0.08, 0.08, 0.085))
NET = Paint(sheet["net"], (0.30, 0.55, 0.42))
PLASTIC = Paint(sheet["rubber"], (0.85, 0.55, 0.10))
GLASS = Paint(sheet["rubber"], (0.04, 0.06, 0.07))
THICK = 0.09


class Boat:
    def __init__(self):
        self.loft = Loft(STATIONS, PIECES)
        girths = np.array([0, .10, .2, .3, .4, .5])
        coarse = lambda: closed_from(self.loft.points(np.linspace(0, 1, 12), girths))
        self.loft.shift = physics.sink(coarse(), MASS)
        self.collision = coarse()
        t = np.linspace(0, 1, 60)
        self.edge = self.loft.points(t, [0.5])[:, 0]
        self.wheel_at = np.array([0.0, self.deck_y(-1.5) + 1.05, -2.02])
        self.throttle_at = np.array([0.42, self.deck_y(-1.5) + 1.04, -1.92])

    def deck_y(self, z, x=0.0):
        y = float(np.interp(z, self.edge[:, 2], self.edge[:, 1]))
        half = float(np.interp(z, self.edge[:, 2], self.edge[:, 0]))
        return y + 0.07 * (1 - min(1, (x / max(half, 0.01)) ** 2))

    def shell(self, d):
        t = np.linspace(0, 1, d.n(33)) ** 0.95
        low = gear.even_breaks(self.loft, 0.5, 0, 0.5, 12 if not d.far else 4)
        high = np.linspace(0.5, 1.0, 4 if not d.far else 2)
        paint = HULL
        outside = join([gear.strakes(self.loft, t, low, paint), gear.strakes(self.loft, t, high[:-1] if not d.far else high, paint)])
        if not d.far:
            outside = join([outside, gear.strakes(self.loft, t, high[-2:], HULL.tinted(*WHITE))])
        outside.g[:] = 0
        outside = gear.painted_bottom(outside, [HULL], BOTTOM, WHITE, 0.06, 0.16)
        inner_t = np.linspace(0.012, 0.995, d.n(36))
        inside = grid(self.loft.offset(inner_t, np.linspace(0.5, 1, 3 if d.full else 2), np.full((1, 1), -THICK)), INSIDE)
        return [outside.both_sides(), inside.both_sides()]

    def ends(self, d):
        s = np.linspace(0, 1, d.n(24))
        edge = self.loft.points([1.0], s)[0]
        outline = np.concatenate([edge, (edge * [-1, 1, 1])[::-1]])
        board = gear.painted_bottom(panel(outline + [0, 0, 0.03], 0.10, HULL.tinted(*BLUE)), [HULL], BOTTOM, WHITE, 0.06, 0.16)
        return [board]

    def timbers(self, d):
        """Keel and stem, rub rails with iron bands, the bulwark's capping and stanchions."""
        parts = []
        stem = self.loft.points([0], np.linspace(0, 1, d.n(14)))[0]
        stem[:, 0] = 0
        stem = np.concatenate([stem, stem[-1:] + [[0, 0.10, -0.03]]])
        stem = gear.painted_bottom(sweep(stem + [0, 0, -0.05], rect(0.12, 0.16, 0.03), HULL, up=(0, 0.4, 1)), [HULL], BOTTOM, WHITE, 0.06, 0.16)
        parts.append(stem)
        keel = self.keel_line()
        x = 0.07
        z = np.linspace(-4.6, 4.75, d.n(16))
        top = np.array([self.profile_y(v) + 0.05 for v in z])
        low = np.interp(z, keel[:, 0], keel[:, 1])
        outline = np.concatenate([np.stack([np.full(len(z), x), np.minimum(low, top - 0.02), z], -1), np.stack([np.full(len(z), x), top, z], -1)[::-1]])
        parts.append(panel(outline[::-1] if np.cross(outline[1] - outline[0], outline[-1] - outline[0])[0] < 0 else outline, 2 * x, BOTTOM))
        n = d.n(26)
        t = np.linspace(0.0, 1, n)
        for s, paint, w, h in ((0.5, TRIM, 0.09, 0.13), (0.36, TRIM, 0.07, 0.10)) if not d.far else ((0.5, TRIM, 0.09, 0.13),):
            p = self.loft.points(t, [s])[:, 0] + self.loft.normals(t, [s])[:, 0] * 0.03
            parts.append(sweep(p, rect(w, h, 0.02 if d.full and s == 0.5 else 0), paint).both_sides())
            if d.full and s == 0.5:
                p = self.loft.points(t, [s])[:, 0] + self.loft.normals(t, [s])[:, 0] * (0.03 + w / 2)
                parts.append(sweep(p, rect(0.016, 0.05), IRON.tinted(.4, .38, .36)).both_sides())
        t = np.linspace(0.0, 1, n)
        cap = self.loft.points(t, [1.0])[:, 0]
        normal = self.loft.normals(t, [1.0])[:, 0] * [1, 0, 1]
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        parts.append(sweep(cap - normal * THICK / 2 + [0, 0.02, 0], rect(0.19, 0.055, 0.012 if d.full else 0), TRIM).both_sides())
        end = cap[-1]
        parts.append(bar((-end[0], end[1] + 0.02, end[2] - 0.02), (end[0], end[1] + 0.02, end[2] - 0.02), 0.19, 0.055, TRIM, bevel=0.012))
        if d.full:
            for z in np.arange(-4.6, 5.5, 0.84):
                tt = self.loft.t_at(z, 0.75)
                low, high = self.loft.offset(tt, [0.51, 0.985], np.full((1, 1), -THICK - 0.04))[0]
                parts.append(bar(low, high, 0.09, 0.09, INSIDE, up=(0, 0, 1)).both_sides())
        return parts

    def keel_line(self):
        y = self.loft.shift
        return np.array([[-5.0, y + 0.5], [-4.3, y - 0.02], [-3.0, y - 0.18], [4.75, y - 0.42], [5.0, y - 0.42]])

    def profile_y(self, z):
        p = self.loft.points(np.linspace(0, 1, 101), [0])[:, 0]
        return float(np.interp(z, p[:, 2], p[:, 1]))

    def deck(self, d):
        t = np.linspace(0.01, 0.998, d.n(30))
        edge = self.loft.offset(t, [0.5], np.full((1, 1), -0.02))[:, 0]
        edge[:, 0] = np.maximum(edge[:, 0], 0.01)
        if d.far:
            return [gear.deck(edge, DECK, 2.2, 0.07)]
        parts = [gear.deck(edge, DECK, 0.36, 0.07)]
        if d.full:
            for z in np.arange(-3.2, 5.2, 1.2):  # freeing ports: dark slots low in the bulwark, in and out
                tt = self.loft.t_at(z, 0.55)
                for off, k in ((0.004, 1), (-THICK - 0.004, -1)):
                    p = self.loft.offset([tt - 0.02, tt + 0.02], [0.53, 0.60], np.full((1, 1), off))
                    parts.append(grid(p, RUBBER.tinted(.05, .05, .05), flip=k > 0).both_sides())
        return parts

    # The wheelhouse: its corners from the front, narrower above.
    Z0, Z1, HALF = -2.65, -0.55, 1.08

    def house(self, d):
        y0, top = self.deck_y(-1.5) - 0.05, self.deck_y(-1.5) + 2.12
        h, z0, z1 = self.HALF, self.Z0, self.Z1
        lean, tuck = 0.26, 0.06
        f = 0 if d.far else 1
        frame = RUBBER.tinted(.12, .12, .12) if d.full else None
        rows = (0.52, 0.86)
        walls, panes = [], []
        corner = {"fl": (-h, y0, z0), "fr": (h, y0, z0), "bl": (-h, y0, z1), "br": (h, y0, z1)}
        up = {"fl": (-h + tuck, top, z0 - lean + 0.1), "fr": (h - tuck, top, z0 - lean + 0.1), "bl": (-h + tuck, top, z1), "br": (h - tuck, top, z1)}
        three = [(0.05, rows[0], 0.32, rows[1]), (0.37, rows[0], 0.63, rows[1]), (0.68, rows[0], 0.95, rows[1])]
        two = [(0.07, rows[0], 0.46, rows[1]), (0.54, rows[0], 0.93, rows[1])]
        back = [(0.07, rows[0], 0.36, rows[1])]
        for a, b, windows in (("fr", "fl", three), ("br", "fr", two), ("fl", "bl", two), ("bl", "br", back)):
            w, g = gear.wall(corner[a], corner[b], up[b], up[a], windows if f else [], HOUSE, frame, 0.06, 0.055, GLASS.tinted(.6, .7, .7))
            walls.append(w)
            panes.append(g)
        roof = np.array([[-h - 0.05, top + 0.02, z0 - 0.42], [h + 0.05, top + 0.02, z0 - 0.42], [h + 0.05, top + 0.02, z1 + 0.28], [-h - 0.05, top + 0.02, z1 + 0.28]])
        walls.append(panel(upward(roof), 0.09, HOUSE, bevel=0 if d.far else 0.03))
        self.roof_y = top + 0.02
        if d.far:
            return walls, None
        for p, q in ((corner["fl"], up["fl"]), (corner["fr"], up["fr"]), (corner["bl"], up["bl"]), (corner["br"], up["br"])):
            walls.append(bar(p, q, 0.075, 0.075, HOUSE.tinted(.85, .85, .8), up=(0, 0, 1), bevel=0.015, ends=False))
        walls.append(sweep(np.array([(h + .005, y0 + 1.02, z1), (h - .02, y0 + 1.02, z0 - 0.02), (-h + .02, y0 + 1.02, z0 - 0.02), (-h - .005, y0 + 1.02, z1)]), rect(0.05, 0.06, 0.012), TRIM))
        # The door aft, to starboard.
        door = np.array([[0.12, y0 + 0.16, z1 + 0.03], [0.86, y0 + 0.16, z1 + 0.03], [0.86, y0 + 1.95, z1 + 0.03], [0.12, y0 + 1.95, z1 + 0.03]])
        walls.append(panel(door, 0.04, TRIM, bevel=0.008))
        walls.append(panel(door[[0, 1, 2, 3]] * [1, 1, 1] * 1.0 + (np.array([[.14, 1.05, .006], [-.14, 1.05, .006], [-.14, -.18, .006], [.14, -.18, .006]])), 0.012, GLASS))
        walls.append(tube(np.array([[0.78, y0 + 0.95, z1 + .035], [0.78, y0 + 0.97, z1 + .08], [0.68, y0 + 0.97, z1 + .08]]), 0.012, STEEL, 6))
        return walls, join(panes)

    def cabin(self, d):
        """Inside the wheelhouse: console, screens, chair."""
        if not d.full:
            return []
        y = self.deck_y(-1.5)
        parts = [box((0, y + 0.46, -2.33), (1.9, 0.92, 0.42), TRIM.tinted(.55, .36, .2), bevel=0.015),
                 panel(np.array([[-0.95, y + 0.9, -2.10], [0.95, y + 0.9, -2.10], [0.95, y + 1.06, -2.5], [-0.95, y + 1.06, -2.5]]), 0.03, RUBBER.tinted(.2, .2, .2))]
        for x in (-0.55, 0.35):
            parts.append(box((x, y + 1.14, -2.36), (0.42, 0.28, 0.06), RUBBER.tinted(.14, .14, .15), bevel=0.012).turn("x", -12, (x, y + 1.14, -2.36)))
            parts.append(box((x, y + 1.14, -2.328), (0.37, 0.23, 0.004), GLASS).turn("x", -12, (x, y + 1.14, -2.36)))
        parts.append(lathe(np.array([(0.06, 0), (0.07, 0.05), (0.06, 0.09), (0, 0.12)]), 16, RUBBER.tinted(.1, .1, .1)).move(0, y + 1.0, -2.3))
        parts.append(gear.seat(d, (0, y, -1.15), (0.5, 0.62, 0.46), RUBBER.tinted(.15, .15, .17), STEEL))
        return parts

    def above(self, d):
        """On the roof and behind it: mast, radar, aerials, lights, funnel, raft."""
        y = self.roof_y if hasattr(self, "roof_y") else self.deck_y(-1.5) + 2.14
        mast = tube(np.array([[0, self.deck_y(-0.3), -0.25], [0, y + 2.9, -0.05]]), 0.085, HOUSE, d.sides(14), scale=np.array([1, 0.6]))
        parts = [mast, tube(np.array([[0, self.deck_y(0) + 1.3, -0.2], [0, y + 1.1, 3.6]]), 0.055, HOUSE, d.sides(10))]
        if d.far:
            return parts
        s = d.sides
        parts.append(tube(rope_path([0, y + 2.8, -0.05], [0, y + 1.12, 3.55], 0.0, 3), 0.008, STEEL, 5))
        for x in (-1, 1):
            cap = self.loft.points(self.loft.t_at(0.2), [1.0])[0, 0]
            parts.append(tube(np.array([[0, y + 2.5, -0.05], [x * (cap[0] - .05), cap[1], 0.2]]), 0.010, STEEL, 5))
        parts.append(tube(np.array([[0, y + 2.7, -0.07], [0, self.loft.points([0], [1])[0, 0][1] + .1, -6.1]]), 0.010, STEEL, 5))
        parts.append(bar((-0.55, y + 1.7, -0.1), (0.55, y + 1.7, -0.1), 0.06, 0.05, HOUSE))
        parts.append(lathe(np.array([(0, 0), (0.30, 0.02), (0.33, 0.08), (0.30, 0.2), (0.1, 0.25), (0, 0.25)]), s(22), HOUSE).move(0, y + 0.45, -1.9))
        parts.append(tube(np.array([[0, y, -1.9], [0, y + 0.46, -1.9]]), 0.07, HOUSE, s(10)))
        for x in (-0.9, 0.9):
            parts.append(tube(np.array([[x, y, -0.9], [x * 1.02, y + 2.3, -0.7]]), 0.012, HOUSE, 5))
        if d.full:
            parts += [gear.lamp(d, (0, y + 2.9, -0.05), (1, 1, .95), IRON, HOUSE), gear.lamp(d, (0, y + 2.2, -0.2), (1, 1, .95), IRON, HOUSE),
                      gear.lamp(d, (0.98, y + 0.03, -2.6), (.05, .7, .3), IRON, HOUSE, .06), gear.lamp(d, (-0.98, y + 0.03, -2.6), (.8, .06, .05), IRON, HOUSE, .06)]
            for x in (-0.6, 0.6):  # deck floodlights
                parts.append(lathe(np.array([(0.03, 0), (0.09, 0.10), (0.095, 0.12), (0, 0.11)]), 14, IRON).turn("x", 120).move(x, y + 0.18, -0.45))
            rail = spline([(-.95, y, -2.4), (-.95, y + .3, -2.35), (-.95, y + .32, -1.5), (-.95, y + .32, -.6), (-.95, y, -.5)], 14)
            parts += [tube(rail, 0.016, STEEL, 6).both_sides()]
        parts.append(lathe(np.array([(0, 0), (0.24, 0.02), (0.26, 0.1), (0.26, 0.95), (0.24, 1.03), (0, 1.05)]), s(18), HOUSE).turn("x", 90).move(-0.5, y + 0.34, -1.5 - 0.5))
        parts.append(tube(np.array([[-0.72, self.deck_y(-.3), -0.28], [-0.72, y + 0.7, -0.28], [-0.72, y + 0.95, -0.12]]), 0.09, IRON.tinted(.25, .22, .2), s(14)))
        if d.full:
            parts.append(gear.life_ring(d, (self.HALF + 0.07, self.deck_y(-1.5) + 0.55, -1.6), "x", ORANGE, HOUSE, ROPE))
        return parts

    def working_deck(self, d):
        """Net drum, gantry, hatch, fish boxes, bitts, windlass, tyres."""
        s, parts = d.sides, []
        z = 4.3
        y = self.deck_y(z)
        # Gantry.
        legs = spline([(1.55, y, 5.15), (1.52, y + 0.9, 5.2), (1.5, y + 1.7, 5.25), (1.38, y + 2.1, 5.28), (1.05, y + 2.3, 5.3), (.5, y + 2.34, 5.3), (0, y + 2.34, 5.3)], d.n(14))
        parts.append(tube(np.concatenate([legs, (legs * [-1, 1, 1])[::-1][1:]]), 0.075, ORANGE, s(12)))
        for x in (-1, 1):
            parts.append(tube(np.array([[x * 1.5, y + 1.55, 5.24], [x * 1.5, self.deck_y(3.9), 3.9]]), 0.05, ORANGE, s(10)))
        # The net drum, its net wound on.
        drum = np.array([(0.10, -1.02), (0.55, -1.0), (0.56, -0.985), (0.55, -0.97), (0.16, -0.95)])
        cheeks = [lathe(drum, s(28), GREEN), lathe(np.array([(0.16, 0.95), (0.55, 0.97), (0.56, 0.985), (0.55, 1.0), (0.10, 1.02), (0, 1.02)]), s(28), GREEN)]
        yy = np.linspace(-0.95, 0.95, d.n(15))
        bundle = lathe(np.stack([0.37 + 0.05 * np.sin(yy * 9) * np.cos(yy * 13), yy], -1), s(28), NET)
        parts.append(join(cheeks + [bundle]).turn("z", 90).move(0, y + 0.66, 4.0))
        for x in (-1.1, 1.1):
            shape = np.array([[x - 0.03, y - 0.05, 3.55], [x - 0.03, y - 0.05, 4.45], [x - 0.03, y + 0.74, 4.1], [x - 0.03, y + 0.74, 3.9]])
            shape = shape if np.cross(shape[1] - shape[0], shape[2] - shape[0])[0] > 0 else shape[::-1]
            parts.append(panel(shape + [0.03, 0, 0], 0.06, GREEN))
        if d.far:
            return parts
        # Fish hatch with coaming.
        h = self.deck_y(1.6)
        parts += [box((0, h + 0.15, 1.7), (1.3, 0.34, 1.2), INSIDE, bevel=0.02), box((0, h + 0.35, 1.7), (1.4, 0.08, 1.3), TRIM.tinted(.6, .4, .25), bevel=0.02)]
        # Stacked fish boxes.
        for k, (x, zz, n) in enumerate(((1.35, 1.0, 3), (1.35, 1.85, 2), (-1.35, 0.6, 2))):
            for m in range(n):
                parts.append(self.fish_box(d, (x, self.deck_y(zz, x) + 0.01 + 0.25 * m, zz), PLASTIC if (k + m) % 3 else PLASTIC.tinted(.12, .35, .6), turn=3 * ((k * 7 + m * 5) % 3 - 1)))
        if not d.full:
            return parts
        y = self.deck_y(-4.2)
        parts += [gear.bollard(d, (0.0, self.deck_y(-4.9), -4.85), IRON, 0.4), gear.bollard(d, (1.2, self.deck_y(4.9, 1.2), 4.9), IRON), gear.bollard(d, (-1.2, self.deck_y(4.9, 1.2), 4.9), IRON)]
        parts.append(lathe(np.array([(0, -.45), (.16, -.44), (.11, -.3), (.11, -.18), (.2, -.17), (.2, .17), (.11, .18), (.11, .3), (.16, .44), (0, .45)]), s(18), GREEN).turn("z", 90).move(0, y + 0.36, -4.0))
        parts += [box((x, y + 0.2, -4.0), (0.08, 0.46, 0.34), GREEN, bevel=0.01) for x in (-.25, .25)]
        parts.append(coil((-0.6, self.deck_y(-3.6, .6), -3.55), 0.26, 0.02, 7, ROPE.tinted(.85, .8, .66), 10, 4))
        parts.append(coil((-1.3, self.deck_y(2.6, 1.3), 2.6), 0.28, 0.018, 7, ROPE, 10, 4))
        parts.append(gear.round_bow_anchor(d, (0.35, self.loft.points([0.03], [1])[0, 0][1] + 0.12, -5.6), IRON.tinted(.45, .44, .42)))
        for z, x in ((-1.0, 1), (1.2, 1), (3.2, 1), (-1.0, -1), (1.2, -1), (3.2, -1)):
            p = self.loft.points(self.loft.t_at(z, 0.5), [0.47])[0, 0]
            a = np.arange(16) * 2 * np.pi / 16
            tyre = sweep(np.stack([0 * a, 0.24 * np.sin(a), 0.24 * np.cos(a)], -1), circle(0.1, 7), RUBBER, up=(1, 0, 0), closed=True)
            hang = tube(np.array([[0.02, 0.2, 0], [0.06, 0.75, 0.0], [-0.05, 1.0, 0]]), 0.014, ROPE, 5)
            m = join([tyre, hang]).move(p[0] + 0.14, p[1], z)
            parts.append(m if x > 0 else m.mirror())
        return parts

    def fish_box(self, d, at, paint, turn=0.0):
        w, h, l, t = 0.5, 0.24, 0.78, 0.018
        parts = [box((0, t / 2, 0), (w, t, l), paint)]
        for s in (-1, 1):
            parts += [box((s * (w - t) / 2, h / 2, 0), (t, h, l), paint), box((0, h / 2, s * (l - t) / 2), (w - 2 * t, h, t), paint)]
            parts += [box((s * (w / 2 + 0.004), h - 0.02, 0), (0.03, 0.035, l + 0.03), paint)] if d.full else []
        return join(parts).turn("y", turn).move(*at)

    def hull(self, d):
        walls, _ = self.house(d)
        m = join(self.shell(d) + self.ends(d) + self.timbers(d) + self.deck(d) + walls + self.cabin(d) + self.above(d) + self.working_deck(d))
        return m

    def rudder(self, d):
        y = self.loft.shift
        outline = np.array([[0, y - 0.35, 5.06], [0, y - 0.35, 5.62], [0, y + 0.3, 5.72], [0, y + 0.72, 5.6], [0, y + 0.75, 5.06]])
        outline = outline if np.cross(outline[1] - outline[0], outline[2] - outline[0])[0] > 0 else outline[::-1]
        return join([panel(outline + [0.035, 0, 0], 0.07, BOTTOM, bevel=0 if d.far else 0.015), tube(np.array([[0, y - 0.42, 5.06], [0, y + 1.0, 5.06]]), 0.04, IRON, d.sides(10))])


def build():
    boat = Boat()
    model = Model("fishing_boat", "hull", [sheet], (28, 110, 6000), 0.07)
    model.material("glazing", "sheet", alpha=0.25)
    model.part("hull", boat.hull)
    y = boat.loft.shift
    model.part("rudder", boat.rudder, (0, y, 5.06), axis=(0, 1, 0))
    screw = (0, y + 0.18, 4.9)
    model.part("propeller", lambda d: None if d.far else gear.propeller(d, screw, 0.42, 4, STEEL.tinted(.8, .62, .3)), screw, axis=(0, 0, 1))
    wheel = boat.wheel_at
    model.part("helm", lambda d: gear.steering_wheel(d, wheel, 0.27, -20, TRIM.tinted(.45, .26, .12), STEEL, 6, 0.018) if d.full else None, wheel, axis=(0, 0.342, 0.94))
    lever = boat.throttle_at
    model.part("throttle", lambda d: gear.lever(d, lever, 0.17, STEEL, Paint(sheet["rubber"], (.6, .05, .05))) if d.full else None, lever, axis=(1, 0, 0))
    model.part("glazing", lambda d: {"glazing": boat.house(d)[1]} if not d.far else None)
    model.body("collision", boat.collision)
    yd = boat.deck_y(-1.5)
    hold = closed_from(boat.loft.offset(np.linspace(0.06, 0.97, 10), np.array([0, .1, .2, .3, .4, .49]), np.full((1, 1), -0.1)))
    model.body("inside_hold", hold)
    model.body("inside_wheelhouse", closed_box((-1.0, yd, boat.Z0 + 0.1), (1.0, yd + 2.0, boat.Z1 - 0.08)))
    model.floats(MASS, round(y + 1.28, 4), physics.hull_inertia(MASS, 12.0, 4.2), 12.0, 4.2)
    top = yd + 2.14
    r = lambda v: [round(float(x), 3) for x in v]
    model.extras.update({
        "engine": {"at_m": r(screw), "propeller_m": 0.84, "turns_per_s": 13.0, "power_w": 150000},
        "rudder": {"at_m": r([0, y + 0.2, 5.35]), "area_m2": 0.62, "aspect": 1.8, "range_deg": [-35, 35]},
        "draught_keel_m": round(float(-(y - 0.42)), 3),
        "seats": [{"at_m": r([0, yd + 0.62, -1.15]), "yaw_deg": 0, "role": "helm"}, {"at_m": r([0, boat.deck_y(1.7) + 0.4, 1.7]), "yaw_deg": 0, "role": "passenger"}],
        "grips": [{"name": "helm", "at_m": r(wheel), "axis": [0, 0.342, 0.94], "range_deg": [-540, 540], "node": "helm", "radius_m": 0.27},
                  {"name": "throttle", "at_m": r(lever + [0, 0.17, 0]), "axis": [1, 0, 0], "range_deg": [-40, 40], "node": "throttle"}],
        "lights": [{"at_m": r([0, top + 2.2, -0.2]), "colour": "white", "sector_deg": [-112.5, 112.5], "range_m": 5500},
                   {"at_m": r([0.98, top + 0.08, -2.6]), "colour": "green", "sector_deg": [0, 112.5], "range_m": 3700},
                   {"at_m": r([-0.98, top + 0.08, -2.6]), "colour": "red", "sector_deg": [-112.5, 0], "range_m": 3700},
                   {"at_m": r([0, top + 2.95, -0.05]), "colour": "white", "sector_deg": [112.5, 247.5], "range_m": 3700}]})
    return model
