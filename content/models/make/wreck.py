"""The wreck of a wooden trawler of 15 m on the bed: heeled, its planking gone in places, ribs bare, engine rusted, overgrown.

Its frame stands on the bed: y = 0 is the sand, -z where the bow pointed.
"""
import numpy as np

import boatparts as gear
import surfaces as on
from fishing_boat import PIECES, STATIONS
from hull import Loft, closed_from
from mesh import corner_normals, cut, join, linear
from model import Model
from shapes import Paint, bar, box, fan, grid, lathe, rect, ring, spline, sweep, tube
from shore import stone
from textures import Sheet

SIZE, HEEL, TRIM, SUNK = 1.28, 21.0, 4.5, 0.55

sheet = Sheet("sheet", 192, 512, [("oak", 160, on.old_oak), ("rust", 192, on.rusty), ("grey", 160, on.weathered)], 95)
OAK, GREY = Paint(sheet["oak"], (0.95, 0.92, 0.85)), Paint(sheet["grey"], (0.62, 0.58, 0.50))
RUST, GROWTH, BRONZE = Paint(sheet["rust"]), Paint(sheet["oak"], (1.0, 1.1, 0.8)), Paint(sheet["rust"], (0.45, 0.85, 0.70))


def noise(a, b):
    """A number 0..1 of two whole numbers."""
    return float(np.random.RandomState((a * 7919 + b * 104729 + 17) % (2 ** 31)).uniform())


class Wreck:
    def __init__(self):
        self.loft = Loft(np.array(STATIONS) * SIZE, PIECES)
        self.breaks = gear.even_breaks(self.loft, 0.5, 0.02, 0.62, 15)

    def there(self, k, i, n, side):
        """Is plank k there at segment i of n? The upper side amidships is open, the rest has holes."""
        t = (i + 0.5) / n
        height = k / (len(self.breaks) - 2)
        open_here = np.exp(-((t - 0.55) / 0.17) ** 2) * (1.15 if side > 0 else 0.5) + 0.25 * np.exp(-((t - 0.93) / 0.06) ** 2)
        edge = 0.92 - open_here * 0.95 + 0.16 * (noise(int(i / 2), 5 + side) - 0.5)
        return height < edge and noise(k * 31 + int(i / 3), 11 + side) > 0.05 + 0.22 * height * (height > 0.3)

    def planks(self, d, side):
        n = {0: 36, 1: 18, 2: 9}[d.level]
        parts = []
        t = np.linspace(0.004, 0.998, n + 1)
        step = 1 if not d.far else 3
        for k in range(0, len(self.breaks) - 1, step):
            top = self.breaks[min(k + step, len(self.breaks) - 1)]
            s = np.array([self.breaks[k] + 0.0015, top - 0.0015])
            i = 0
            while i < n:
                if not self.there(k, i * 36 // n, 36, side):
                    i += 1
                    continue
                j = i
                while j < n and self.there(k, j * 36 // n, 36, side):
                    j += 1
                run = t[i:j + 1].copy()
                run[0] += (noise(k, i) - 0.3) * 0.012 * (i > 0)
                run[-1] -= (noise(k, j + 99) - 0.3) * 0.012 * (j < n)
                sprung = 0.10 * max(0.0, noise(k * 3, i) - 0.82) * np.linspace(0, 1, len(run))[:, None] ** 3 * 8 * (j < n)
                out, inn = self.loft.offset(run, s, 0.0 + sprung + np.zeros((1, 2))), self.loft.offset(run, s, sprung - 0.065 + np.zeros((1, 2)))
                ring4 = np.stack([out[:, 1], out[:, 0], inn[:, 0], inn[:, 1]], 1)
                tone = 0.75 + 0.25 * noise(k, 77 + i)
                paint = OAK.tinted(.95 * tone, .92 * tone, .85 * tone)
                m = join([grid(ring4, paint, wrap=True), fan(ring4[0], paint), fan(ring4[-1], paint, flip=True)])
                parts.append(m)
                i = j
        m = join(parts)
        return m if side > 0 else m.mirror()

    def ribs(self, d):
        parts = []
        for q, z in enumerate(np.arange(-5.6, 6.9, 0.56 if d.full else (1.12 if not d.far else 3.0))):
            for side in (1, -1):
                sec = self.loft.section(z, 25, 0.065 + 0.07)
                end = 25 - int(8 * noise(q, 3 + side)) - int(7 * np.exp(-((z - 0.6) / 2.2) ** 2) * (side > 0) * noise(q, 9))
                sec = sec[:max(8, end)]
                sec[:, 0] = np.maximum(sec[:, 0], 0.05)
                path = spline(sec, d.n(12, 4))
                m = sweep(path, rect(0.14, 0.12, 0.02 if d.full else 0), OAK.tinted(.8, .76, .68), up=(0, 0, 1))
                parts.append(m if side > 0 else m.mirror())
        return join(parts)

    def backbone(self, d):
        bottom = self.loft.points(np.linspace(1, 0, d.n(24)), [0])[:, 0]
        stem = self.loft.points([0], np.linspace(0, 1, d.n(10)))[0][1:]
        path = np.concatenate([bottom, stem]) * [0, 1, 1]
        parts = [sweep(spline(path, d.n(32)), rect(0.20, 0.34, 0.03 if d.full else 0), OAK.tinted(.7, .66, .58), up=(0, 1, 0.35))]
        z = np.linspace(-4.2, 5.6, d.n(14))
        inner = np.array([np.interp(v, bottom[::-1, 2], bottom[::-1, 1]) for v in z])
        parts.append(sweep(np.stack([0 * z, inner + 0.24, z], -1), rect(0.24, 0.22, 0.02 if d.full else 0), OAK.tinted(.75, .7, .6)))
        post = np.array([[0, bottom[0][1] - 0.55, 6.4], [0, 3.2, 7.2]])
        parts.append(bar(post[0], post[1], 0.22, 0.28, OAK.tinted(.7, .66, .58), up=(0, 0, 1), bevel=0.03))
        if d.far:
            return join(parts)
        for k, zz in enumerate(np.arange(-5.2, 6.4, 0.95)):  # deck beams, some of them broken off
            sec = self.loft.section(zz, 41, 0.10)
            x, y = np.interp(0.5, np.linspace(0, 1, 41), sec[:, 0]), np.interp(0.5, np.linspace(0, 1, 41), sec[:, 1]) - 0.15
            luck = noise(k, 41)
            if abs(zz - 0.7) < 1.6 and luck > 0.25:
                continue
            right = x if luck < 0.6 else x * (0.1 + 0.5 * luck)
            drop = 0.0 if luck < 0.6 else 0.35 * luck
            parts.append(bar((-x, y, zz), (right, y - drop, zz + 0.1 * luck), 0.16, 0.18, OAK.tinted(.78, .72, .62), bevel=0.02 if d.full else 0))
        for x in np.arange(-1.9, 2.0, 0.20):  # what is left of the deck, fore and aft
            for a, b in ((-6.2, -3.6 + 1.1 * noise(int(x * 50), 6)), (3.9 + 1.3 * noise(int(x * 50), 8), 6.6)):
                half = min(self.half_at(a), self.half_at(b))
                if abs(x) > half - 0.1 or noise(int(x * 50), int(a * 10)) < 0.3:
                    continue
                zz = np.linspace(max(a, -5.7 + 1.5 * abs(x)), b, 4)
                y = np.array([self.deck_at(v) for v in zz])
                parts.append(sweep(np.stack([0 * zz + x, y, zz], -1), rect(0.17, 0.05), GREY))
        return join(parts)

    def half_at(self, z):
        return float(self.loft.points(self.loft.t_at(z, 0.5), [0.5])[0, 0, 0])

    def deck_at(self, z):
        return float(self.loft.points(self.loft.t_at(z, 0.5), [0.5])[0, 0, 1]) - 0.03

    def iron(self, d):
        """Boiler, engine, winch, shaft and screw, mast, the anchor's chain."""
        s, parts = d.sides, []
        boiler = lathe(np.array([(0, -0.9), (0.55, -0.88), (0.68, -0.8), (0.70, -0.74), (0.70, 0.74), (0.68, 0.8), (0.55, 0.88), (0, 0.9)]), s(26), RUST)
        parts.append(boiler.turn("x", 90).move(0.1, 1.25, -0.9))
        if not d.far:
            for z in (-1.55, -0.9, -0.25):
                parts.append(lathe(np.array([(0.70, -0.03), (0.735, -0.025), (0.735, 0.025), (0.70, 0.03)]), s(26), RUST.tinted(.8, .75, .7)).turn("x", 90).move(0.1, 1.25, z))
            parts.append(lathe(np.array([(0.24, 0), (0.24, 0.25), (0.29, 0.26), (0.29, 0.30), (0.2, 0.30), (0.2, 0.06), (0, 0.05)]), s(16), RUST).move(0.1, 1.9, -1.1))
        parts.append(box((0, 0.95, 1.55), (0.75, 0.7, 1.5), RUST.tinted(.85, .8, .75), bevel=0.06))
        if not d.far:
            for z in (1.05, 1.55, 2.05):
                parts.append(lathe(np.array([(0.20, 0), (0.20, 0.42), (0.24, 0.44), (0.24, 0.52), (0.10, 0.55), (0.10, 0.62), (0, 0.63)]), s(16), RUST).move(0, 1.28, z))
            parts.append(ring((0, 0.95, 2.45), (0, 0, 1), 0.42, 0.07, RUST, d.n(26, 8), s(8)))
            parts.append(bar((-.4, .95, 2.45), (.4, .95, 2.45), 0.08, 0.05, RUST, up=(0, 0, 1)))
            parts.append(bar((0, .55, 2.45), (0, 1.35, 2.45), 0.08, 0.05, RUST, up=(0, 0, 1)))
            parts.append(tube(np.array([[0, 0.75, 2.4], [0, 0.62, 6.6]]), 0.07, RUST, s(10)))
            drum = lathe(np.array([(0.06, -0.75), (0.38, -0.74), (0.38, -0.70), (0.17, -0.68), (0.19, 0), (0.17, 0.68), (0.38, 0.70), (0.38, 0.74), (0.06, 0.75)]), s(20), RUST)
            parts.append(drum.turn("z", 84).move(0.3, self.deck_at(-3.9) + 0.36, -4.2))
            parts += [box((x, self.deck_at(-4) + 0.24, -4.2), (0.09, 0.5, 0.4), RUST, bevel=0.02) for x in (-.35, .9)]
        parts.append(gear.propeller(d, (0, 0.62, 6.75), 0.62, 4, BRONZE))
        if d.full:
            hole = self.loft.points(0.05, [0.75])[0, 0]
            path = spline([hole + [0.1, 0, 0], hole + [0.35, -0.6, -0.25], hole + [0.55, -2.2, -0.8], hole + [0.8, -3.3, -1.6]], 34)
            for k in range(0, 33):
                a, b = path[k], path[k + 1]
                parts.append(self.link((a + b) / 2, b - a, k))
        return join(parts)

    @staticmethod
    def link(at, along, k):
        m = ring((0, 0, 0), (1, 0, 0) if k % 2 else (0, 1, 0), 0.05, 0.018, RUST, 8, 5).scale(1, 1, 1.7)
        along = along / np.linalg.norm(along)
        axis = np.cross([0, 0, 1.0], along)
        turn = np.degrees(np.arccos(np.clip(along[2], -1, 1)))
        return (m.turn(axis, turn) if np.linalg.norm(axis) > 1e-6 else m).move(*at)

    def lie(self, m):
        """Heels the hull to port and sets it into the sand."""
        return m.turn("z", HEEL).turn("x", -TRIM).move(y=-SUNK - 0.05, x=0.9)

    def around(self, d):
        """The fallen mast, planks on the sand, growth."""
        parts = [tube(np.array([[-0.4, 2.6, -1.6], [-4.6, 1.1, -0.2], [-7.4, 0.10, 0.7]]), 0.16, OAK.tinted(.8, .75, .65), d.sides(12), scale=np.array([1, 0.85, 0.62]))]
        if d.far:
            return join(parts)
        rng = np.random.RandomState(3)
        for k in range(14 if d.full else 6):
            x, z, a = rng.uniform(-5.2, 5.5), rng.uniform(-5, 7), rng.uniform(0, 180)
            if abs(x) < 2.4:
                x += 3.0 * np.sign(x)
            length = rng.uniform(1.2, 3.2)
            board = bar((-length / 2, 0, 0), (length / 2, rng.uniform(-0.1, 0.22), 0), 0.20, 0.065, GREY, bevel=0.006 if d.full else 0)
            parts.append(board.turn("y", a).move(x, 0.04, z))
        for k in range(34 if d.full else 12):
            x, z = rng.uniform(-3.8, 3.8), rng.uniform(-7, 7.5)
            size = rng.uniform(0.12, 0.38)
            m = stone(k % 9, 1 if d.full else 0).scale(size * 1.3, size * 0.8, size).turn("y", rng.uniform(0, 360))
            m.uv = GROWTH.place(m.p[..., 0] + 0.7 * m.p[..., 1], 0.30 * (m.p[..., 2] - 0.7 * m.p[..., 1]))
            m.c *= linear(GROWTH.colour)
            parts.append(m.move(x * 1.15 + 0.5 * np.sign(x), 0.02, z))
        return join(parts)

    def mesh(self, d):
        hull = self.lie(join([self.planks(d, 1), self.planks(d, -1), self.ribs(d), self.backbone(d), self.iron(d)]))
        hull = cut(hull, "y", -0.15)
        hull = hull.where(hull.centres()[:, 1] > -0.15)
        m = join([hull, self.around(d)])
        # Silt and growth on what faces up, darker below; broad patches of weed.
        up = np.clip(corner_normals(m.p, m.g, 62)[..., 1], 0, 1)
        silt = linear((0.62, 0.60, 0.44)) * 1.5
        patch = 0.5 + 0.5 * np.sin(m.p[..., 0] * 1.7 + 1.1 * np.sin(m.p[..., 2] * 1.3)) * np.sin(m.p[..., 2] * 0.9 + m.p[..., 1] * 1.5)
        share = (np.clip(up * 0.75 * (0.5 + 0.5 * patch), 0, 1))[..., None]
        m.c = np.clip(m.c * (1 - share) + silt * share * m.c.mean(axis=2, keepdims=True) * 1.3, 0, 1)
        green = np.array([0.72, 0.92, 0.60])
        return m.wear(lambda q: 1 - (1 - green) * np.clip(0.5 + 0.6 * np.sin(q[:, 0] * 2.3) * np.sin(q[:, 2] * 1.9 + q[:, 1]), 0, 1)[:, None])


def build():
    wreck = Wreck()
    model = Model("wreck", "fixed", [sheet], (22, 80, 600), 0.10, crease=62)
    model.part("hull", wreck.mesh)
    solid = closed_from(wreck.loft.points(np.linspace(0, 1, 10), np.array([0, .12, .25, .4, .55])))
    model.body("collision", wreck.lie(solid))
    model.extras.update({"length_m": 15.6, "beam_m": 5.4, "frame": "bed", "seats": [], "grips": [], "lights": []})
    return model
