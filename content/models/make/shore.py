"""What stands in the sea for good: a lighthouse on its plinth, and a breakwater of armour stones."""
import numpy as np

import surfaces as on
from mesh import Mesh, join, linear, overgrow
from model import Model
from shapes import Paint, ball, bar, bare_grid, box, box_mapped, circle, closed_lathe, grid, lathe, panel, ring, spline, sweep, tube
from textures import Sheet


class Lighthouse:
    TOP, PLINTH = 14.0, 2.2

    def __init__(self):
        self.wall = Sheet("wall", 128, 512, [("masonry", 512, on.masonry)], 51)
        self.trim = Sheet("trim", 128, 512, [("concrete", 128, on.concrete), ("weed", 96, on.weed), ("paint", 96, on.painted_steel),
                                             ("steel", 32, on.steel), ("glass", 32, on.glass), ("rust", 32, on.rusty), ("wood", 96, on.painted)], 52)
        self.white = Paint(self.wall["masonry"], (0.97, 0.96, 0.93))
        self.red = Paint(self.wall["masonry"], (0.66, 0.11, 0.09))
        self.p = {name: Paint(skin) for name, skin in self.trim.skins.items()}
        self.iron = self.p["paint"].tinted(0.55, 0.09, 0.08)
        self.dark = self.p["paint"].tinted(0.10, 0.11, 0.12)

    def r(self, y):
        """The tower's radius: a slight curve, wider at its foot."""
        k = (y - self.PLINTH) / (self.TOP - self.PLINTH)
        return 2.75 - 1.05 * k + 0.25 * (1 - k) ** 3

    def tower(self, d):
        n = d.sides(44)
        parts = []
        for low, high, paint in ((2.2, 6.0, self.white), (6.0, 9.0, self.red), (9.0, 13.6, self.white)):
            y = np.linspace(low, high, d.n(5, 2))
            parts.append(lathe(np.stack([self.r(y), y], -1), n, paint))
        return parts

    def plinth(self, d):
        c = self.p["concrete"]
        n = d.sides(44)
        profile = [(5.4, -5.0), (4.9, -1.0), (4.6, 0.4), (4.45, 1.9), (4.35, 1.98), (0, 2.0)]
        parts = [lathe(np.array(profile[:4]), n, c), lathe(np.array(profile[3:]), n, c.tinted(1.0, .99, .97)),
                 lathe(np.array([(3.35, 1.99), (3.35, 2.2), (3.3, 2.25), (2.9, 2.3)]), n, c)]
        parts.append(lathe(np.array([(1.75, 13.45), (2.0, 13.62), (2.02, 13.72), (2.5, 13.9), (2.56, 13.95), (2.56, 14.08), (2.5, 14.1), (1.2, 14.12)]), n, c.tinted(1.1, 1.1, 1.08)))
        if d.far:
            return parts
        for k in range(8 if d.full else 0):
            # Brackets under the gallery.
            shape = np.array([[1.74, 13.1, 0.09], [2.42, 13.82, 0.09], [2.42, 13.9, 0.09], [1.74, 13.9, 0.09]])
            parts.append(panel(shape, 0.18, c).turn("y", 45 * k))
        # Steps, ladder, bollards on the plinth.
        for k in range(4):
            parts.append(box((0, 2.04 + 0.16 * k, 3.62 - 0.26 * k + 0.0), (1.5, 0.16, 0.5), c, bevel=0.01))
        for s in (-0.25, 0.25):
            parts.append(tube(spline([(s, -2.0, 4.98), (s, 0.4, 4.78), (s, 2.1, 4.62), (s, 2.75, 4.42), (s, 2.6, 4.1), (s, 2.0, 4.1)], d.n(18)), 0.03, self.p["rust"], d.sides(8)).turn("y", 60))
        for y in np.arange(-1.8, 2.0, 0.32):
            z = np.interp(y, [-2.0, 0.4, 2.1], [4.98, 4.78, 4.62])
            parts.append(tube(np.array([[-.25, y, z], [.25, y, z]]), 0.02, self.p["rust"], d.sides(6), caps=False).turn("y", 60))
        for a in (20, 100, 200, 300):
            bollard = lathe(np.array([(0.16, 1.98), (0.15, 2.02), (0.11, 2.08), (0.11, 2.28), (0.16, 2.33), (0.16, 2.38), (0.1, 2.42), (0, 2.43)]), d.sides(16), self.dark)
            parts.append(bollard.move(0, 0, 4.0).turn("y", a))
        return parts

    def openings(self, d):
        if d.far:
            return []
        parts = []
        c, glass = self.p["concrete"].tinted(0.9, 0.9, 0.88), self.p["glass"].tinted(0.05, 0.07, 0.09)

        def opening(y, h, w, turn, fill):
            r = self.r(y)
            lean = np.degrees(np.arctan2(self.r(y) - self.r(y + h), h))
            t = np.linspace(0, np.pi, 9)
            arch = [[w / 2 * np.cos(a), h - w / 2 + w / 2 * np.sin(a), 0] for a in t]
            outline = np.array([[-w / 2, 0, 0], [w / 2, 0, 0]] + arch)
            frame = outline * [1.0, 1.0, 1] + np.sign(outline * [1, 0, 0]) * [0.13, 0, 0] + [[0, 0.10 if q[1] > h * 0.6 else 0, 0] for q in outline]
            m = [panel(frame, 0.30, c, bevel=0.02).move(z=r + 0.05), panel(outline + [0, 0.02, 0], 0.05, fill).move(z=r + 0.058)]
            m.append(box((0, -0.06, r + 0.06), (w + 0.4, 0.12, 0.28), c, bevel=0.015))
            if fill is glass:
                bars = [box((0, h / 2, r + 0.065), (0.035, h - 0.04, 0.03), self.p["wood"].tinted(.9, .9, .88)), box((0, h * .5, r + 0.065), (w, 0.035, 0.03), self.p["wood"].tinted(.9, .9, .88))]
                m += bars
            else:
                for k in range(5 if d.full else 0):
                    m.append(box((-w / 2 + (k + 0.5) * w / 5, h * 0.43, r + 0.064), (w / 5 - 0.012, h * 0.84, 0.024), fill, bevel=0.004))
                m.append(ball((w * 0.34, h * 0.42, r + 0.10), 0.04, self.p["steel"].tinted(.85, .7, .4), 10))
                for yy in (0.35, 1.5):
                    m.append(box((-w * 0.18, yy, r + 0.082), (w * 0.6, 0.06, 0.012), self.dark))
            return join(m).turn("x", -lean, (0, 0, r)).move(y=y).turn("y", turn)

        parts.append(opening(2.62, 2.15, 0.95, 0, self.p["wood"].tinted(0.10, 0.25, 0.32)))
        for y, turn in ((5.2, 40), (7.4, 150), (9.6, 260), (11.6, 10), (11.4, 200)):
            parts.append(opening(y, 1.05, 0.55, turn, glass))
        return parts

    def gallery(self, d):
        if d.far:
            return []
        parts = []
        for k in range(20 if d.full else 10):
            a = k * 360 / (20 if d.full else 10)
            parts.append(tube(np.array([[0, 14.05, 2.42], [0, 15.05, 2.42]]), 0.022, self.iron, d.sides(6), caps=False).turn("y", a))
        for y in (14.4, 14.72, 15.06):
            parts.append(ring((0, y, 0), (0, 1, 0), 2.42, 0.026 if y > 15 else 0.016, self.iron, d.n(48), d.sides(6)))
        return parts

    def lantern(self, d):
        n = d.sides(32)
        parts = [lathe(np.array([(1.28, 14.1), (1.28, 14.18), (1.22, 14.2), (1.22, 15.0), (1.28, 15.02), (1.28, 15.08), (1.1, 15.09)]), n, self.p["paint"].tinted(.93, .93, .9))]
        dome = [(1.12, 16.98), (1.42, 17.0), (1.45, 17.04), (1.42, 17.10)] + [(1.36 * np.cos(a), 17.08 + 1.0 * np.sin(a)) for a in np.linspace(0.05, 1.35, d.n(9))] + [(0.2, 18.1), (0.2, 18.3), (0.0, 18.32)]
        parts.append(lathe(np.array(dome), n, self.iron))
        if d.far:
            parts.append(lathe(np.array([(1.15, 15.08), (1.15, 17.0)]), n, self.p["glass"].tinted(0.2, 0.23, 0.25)))
            return parts
        parts.append(lathe(np.array([(0, 16.97), (1.12, 16.98)]), n, self.p["paint"].tinted(.85, .85, .82)).flipped())
        parts.append(lathe(np.array([(1.1, 15.09), (0, 15.1)]), n, self.p["paint"].tinted(.5, .5, .48)))
        parts.append(ball((0, 18.42, 0), 0.17, self.iron, d.sides(14)))
        parts.append(tube(np.array([[0, 18.5, 0], [0, 19.8, 0]]), 0.018, self.p["steel"], 6))
        parts.append(panel(np.array([[0, 19.15, -0.5], [0, 19.1, 0.12], [0, 19.3, 0.12], [0, 19.27, -0.15], [0, 19.36, -0.24]]), 0.012, self.iron))
        for k in range(10):
            parts.append(bar((1.17, 15.05, 0), (1.17, 17.0, 0), 0.05, 0.07, self.iron, up=(0, 0, 1)).turn("y", 36 * k))
        parts.append(ring((0, 16.0, 0), (0, 1, 0), 1.17, 0.02, self.iron, d.n(40), d.sides(6)))
        if d.full:
            for k in range(12):
                a = np.radians(30 * k)
                rib = spline([(1.44 * np.cos(a), 17.08, 1.44 * np.sin(a)), (1.0 * np.cos(a), 17.80, 1.0 * np.sin(a)), (0.2 * np.cos(a), 18.10, 0.2 * np.sin(a))], 7)
                parts.append(tube(rib, 0.02, self.iron, 5, caps=False))
        return parts

    def lens(self, d):
        """A Fresnel lens on its turntable: stepped rings above and below a bull's-eye belt, in two panels."""
        y = np.linspace(15.35, 16.75, d.n(29))
        k = (y - 16.05) / 0.7
        r = 0.46 * np.sqrt(np.maximum(1 - 0.45 * k * k, 0.2)) + 0.03 * (1 - ((k * 7) % 1)) * (np.abs(k) > 0.16) + 0.05 * (np.abs(k) <= 0.16)
        glass = lathe(np.concatenate([[[0, 15.35]], np.stack([r, y], -1), [[0, 16.75]]]), d.sides(24), self.p["glass"].tinted(1.0, 0.96, 0.82))
        metal = [lathe(np.array([(0.3, 15.09), (0.28, 15.2), (0.5, 15.25), (0.52, 15.33), (0, 15.34)]), d.sides(20), self.p["steel"].tinted(.8, .65, .35))]
        if not d.far:
            for a in (0, 90, 180, 270):
                metal.append(bar((0.5, 15.3, 0), (0.5, 16.8, 0), 0.035, 0.035, self.p["steel"].tinted(.8, .65, .35), up=(0, 0, 1)).turn("y", a))
        metal.append(lathe(np.array([(0.5, 16.74), (0.5, 16.80), (0, 16.86)]), d.sides(20), self.p["steel"].tinted(.8, .65, .35)))
        return {"lens": glass, "trim": join(metal)}

    def build(self):
        model = Model("lighthouse", "fixed", [self.wall, self.trim], (45, 160, 20000), 0.16)
        model.material("lens", "trim", emissive=(1.0, 0.93, 0.72))
        model.material("glazing", "trim", alpha=0.22, double_sided=True)
        sea = lambda m: overgrow(m, [self.p["concrete"], self.p["rust"]], self.p["weed"], 0.45)
        model.part("tower", lambda d: {"wall": join(self.tower(d)), "trim": sea(join(self.plinth(d) + self.openings(d) + self.gallery(d) + self.lantern(d)))})
        model.part("lamp", lambda d: None if d.far else self.lens(d), (0, 15.1, 0), axis=(0, 1, 0))
        model.part("glazing", lambda d: None if d.far else {"glazing": lathe(np.array([(1.15, 15.08), (1.15, 17.0)]), d.sides(30), self.p["glass"].tinted(.75, .85, .85))})
        model.body("collision", closed_lathe([(0, -5), (5.4, -5), (4.45, 1.98), (2.95, 2.1), (1.72, 13.7), (2.5, 14.1), (1.25, 14.15), (1.25, 17.0), (0, 18.3)], 16))
        model.extras.update({"length_m": 10.8, "beam_m": 10.8, "height_m": 19.8, "seats": [], "grips": [],
                             "lights": [{"at_m": [0, 16.05, 0], "colour": "white", "sector_deg": [0, 360], "range_m": 26000, "turn_s": 10.0, "beams": 2, "node": "lamp"}]})
        return model


def lighthouse():
    return Lighthouse().build()


def icosphere(level):
    t = (1 + 5 ** 0.5) / 2
    v = np.array([(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)])
    f = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])
    p = v[f] / np.linalg.norm(v[0])
    for _ in range(level):
        a, b, c = p[:, 0], p[:, 1], p[:, 2]
        ab, bc, ca = [(q + r) / np.linalg.norm(q + r, axis=1, keepdims=True) for q, r in ((a, b), (b, c), (c, a))]
        p = np.concatenate([np.stack(q, 1) for q in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return p


def stone(seed, level):
    """A quarried block about 1 m in radius: a ball cut by random planes, its edges worn."""
    rng = np.random.RandomState(seed)
    n = rng.standard_normal((13, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    n[:6] = n[:6] * 0.25 + np.repeat(np.eye(3), 2, 0) * np.tile([1, -1], 3)[:, None]
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    depth = np.concatenate([rng.uniform(0.62, 0.85, 6), rng.uniform(0.72, 0.95, 7)])
    dirs = icosphere(level).reshape(-1, 3)
    reach = depth / np.maximum(dirs @ n.T, 1e-3)
    r = (np.minimum(reach, 2.0) ** -14).sum(1) ** (-1 / 14.0)
    k = rng.standard_normal((4, 3)) * 3.5
    r *= 1 + 0.018 * np.sin(dirs @ k.T + rng.uniform(0, 6, 4)).sum(1)
    return Mesh((dirs * r[:, None]).reshape(-1, 3, 3))


class Breakwater:
    SPAN, CREST, SLOPE = 5.0, 1.9, 1.35  # half length of the ridge, its height, width a metre of height

    def __init__(self):
        self.sheet = Sheet("sheet", 256, 512, [("rock", 512, on.rock)], 61)
        self.rock = Paint(self.sheet["rock"])
        rng = np.random.RandomState(7)
        self.stones = []
        z = -12.0
        row = 0
        while z < 12.0:
            x = -7.2 + (0.71 if row % 2 else 0)
            while x < 7.4:
                px, pz = x + rng.uniform(-0.2, 0.2), z + rng.uniform(-0.2, 0.2)
                y = self.height(px, pz)
                if y > -2.2:
                    self.stones.append((px, y - 0.30 + rng.uniform(-0.15, 0.15), pz, rng.uniform(0.82, 1.12), rng.uniform(0, 360, 3), rng.uniform(0.8, 1.25, 3), rng.randint(0, 14), rng.uniform(0.82, 1.08)))
                x += 1.42
            z += 1.30
            row += 1

    def height(self, x, z):
        away = np.hypot(x, max(abs(z) - self.SPAN, 0))
        return self.CREST - max(0.0, away - 0.9) / self.SLOPE

    def mesh(self, d):
        parts = []
        for x, y, z, size, turn, stretch, kind, tone in self.stones:
            if y < (-9, -1.4, 0.0)[d.level]:
                continue
            level = (2 if y > 0.3 else 1, 1 if y > -0.3 else 0, 0)[d.level]
            m = stone(kind, level).scale(*(size * stretch * 1.02))
            m = m.turn("x", turn[0]).turn("z", turn[2] * 0.2).turn("y", turn[1])
            warm = 1 + 0.05 * np.sin(kind * 2.3)
            parts.append(box_mapped(m, self.rock.tinted(min(1, tone * warm), tone, tone / warm), aslant=not d.full).move(x, y, z))
        ridge = [self.mound(8, 0.75)]
        return self.tide(join(parts + [box_mapped(r, self.rock.tinted(.6, .6, .58)) for r in ridge]))

    def tide(self, m):
        """Weed below the low mark, black lichen at the high one, bleached above; the marks wander from stone to stone."""
        def shade(q):
            y = q[:, 1] + 0.12 * np.sin(q[:, 0] * 2.1 + 1.3 * np.sin(q[:, 2] * 1.7)) + 0.06 * np.sin(q[:, 2] * 5.3)
            stops = [-3.0, -0.2, 0.25, 0.5, 0.95, 1.3]
            colours = np.array([(0.16, 0.19, 0.10), (0.17, 0.20, 0.08), (0.26, 0.29, 0.13), (0.30, 0.29, 0.26), (0.62, 0.60, 0.56), (1, 1, 1)])
            return np.stack([np.interp(y, stops, linear(colours)[:, k]) for k in range(3)], -1)
        return m.wear(shade)

    def mound(self, n, under):
        """The closed mound under the stones."""
        rings = []
        for y in (-3.4, -1.0, self.CREST - under):
            reach = 0.9 + (self.CREST - y) * self.SLOPE * 1.0 - under * 0.5
            a = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
            rings.append(np.stack([reach * np.cos(a), np.full(2 * n, y), reach * np.sin(a) + np.sign(np.round(np.sin(a), 6)) * self.SPAN], -1))
        middle = lambda r: np.broadcast_to(r.mean(0), r.shape)
        p = np.stack([middle(rings[0])] + rings + [middle(rings[-1])])
        return bare_grid(np.concatenate([p, p[:, :1]], axis=1))

    def build(self):
        model = Model("breakwater", "fixed", [self.sheet], (40, 140, 4000), 0.16, crease=80)
        model.part("stones", self.mesh)
        model.body("collision", self.mound(10, 0.0))
        model.extras.update({"length_m": 2 * (self.SPAN + 6), "beam_m": 13.0, "seats": [], "grips": [], "lights": []})
        return model


def breakwater():
    return Breakwater().build()
