"""A clinker rowing boat of 3.2 m with two oars, as a dinghy of 50 kg with a rower of 80 kg aboard."""
import numpy as np

import physics
import surfaces as on
from hull import Loft, closed_from
from mesh import cut, join, linear
from model import Model
from shapes import (Paint, ball, bar, circle, fan, grid, lathe, panel, rect, ring, spline, sweep, tube, upward)
from textures import Sheet

THICK, LAP = 0.010, 0.008
STATIONS = [
    [(.010, .10, -1.36), (.010, .18, -1.47), (.010, .34, -1.55), (.010, .52, -1.59), (.010, .70, -1.61)],
    [(.015, .035, -1.15), (.10, .05, -1.17), (.22, .16, -1.19), (.30, .38, -1.20), (.36, .615, -1.22)],
    [(.018, .005, -.5), (.32, -.01, -.5), (.50, .10, -.5), (.53, .30, -.5), (.57, .53, -.5)],
    [(.018, 0, .2), (.40, -.02, .2), (.62, .06, .2), (.61, .28, .2), (.645, .49, .2)],
    [(.018, .02, .9), (.32, .03, .9), (.54, .12, .9), (.55, .3, .9), (.58, .50, .9)],
    [(.015, .10, 1.46), (.18, .14, 1.47), (.36, .22, 1.50), (.42, .38, 1.54), (.43, .575, 1.58)]]

sheet = Sheet("sheet", 512, 1024, [("strakes", 64, on.strakes), ("painted", 48, on.painted), ("varnished", 96, on.varnished),
                                   ("weathered", 80, on.weathered), ("steel", 32, on.steel), ("rope", 32, on.rope),
                                   ("antifouling", 64, on.antifouling), ("moulding", 32, on.moulding), ("end", 64, on.old_oak)], 11)
CREAM, TEAL, RED = (0.93, 0.90, 0.82), (0.10, 0.30, 0.33), (0.55, 0.20, 0.15)
PLANK = Paint(sheet["strakes"], CREAM, whole=True)
BOTTOM = Paint(sheet["antifouling"], RED)
OAK = Paint(sheet["varnished"], (0.86, 0.74, 0.60))
PINE = Paint(sheet["varnished"], (1.0, 0.97, 0.92))
INNER = Paint(sheet["varnished"], (0.98, 0.90, 0.80))
GREY = Paint(sheet["weathered"], (0.95, 0.93, 0.90))
BRASS = Paint(sheet["steel"], (0.86, 0.66, 0.34))
ROPE = Paint(sheet["rope"], (0.92, 0.84, 0.66), whole=True)
LEATHER = Paint(sheet["moulding"], (0.36, 0.20, 0.11))


class Boat:
    def __init__(self):
        self.loft = Loft(STATIONS)
        girths = np.array([0, .12, .25, .38, .52, .68, .84, 1])
        self.loft.shift = physics.sink(self.loft.closed_hull(10, girths), 130.0)
        self.collision = self.loft.closed_hull(10, girths)
        self.rowlock_z = 0.30
        # Strakes of even breadth amidships.
        s = np.linspace(0, 1, 101)
        mid = self.loft.points([0.55], s)[0]
        length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(mid, axis=0), axis=1))])
        self.breaks = np.interp(np.linspace(0, 1, 10), length / length[-1], s)

    def rows(self, t, lap, base):
        """For each strake its lower, middle and upper edge as points (nt, 3, 3), and the step below it."""
        fade = np.clip(t / 0.08, 0, 1)[:, None]
        for k in range(len(self.breaks) - 1):
            s = np.linspace(self.breaks[k], self.breaks[k + 1], 3)
            out = lap * np.array([[1.0, 0.45, 0.0]]) * fade
            lower = self.loft.offset(t, s[:1], np.full((1, 1), base))
            yield k, self.loft.offset(t, s, base + out), lower

    def planking(self, d):
        t = np.linspace(0, 1, d.n(27)) ** 0.9
        parts = []
        if d.far:
            s = np.array([0, .2, .4, .6, .8, 1])
            parts.append(self.loft.shell(t, s, PLANK))
            parts.append(self.loft.shell(t, s, INNER, -THICK, inward=True))
        else:
            for k, p, lower in self.rows(t, LAP, 0.0):
                v = np.array([1.0, 0.5, 0.0])
                top = k == len(self.breaks) - 2
                parts.append(grid(p, PLANK.tinted(*TEAL) if top else PLANK, flip=True, v=v))
                if k:
                    parts.append(grid(np.concatenate([lower, p[:, :1]], axis=1), PLANK.tinted(0.8, 0.77, 0.7), flip=True))
            for k, p, lower in self.rows(t, LAP, -THICK):
                parts.append(grid(p[:, ::2] if not d.full else p, INNER, v=np.array([0, .06, .12])[::1 if d.full else 2]))
                if k and d.full:
                    parts.append(grid(np.concatenate([lower, p[:, :1]], axis=1), INNER.tinted(0.8, 0.7, 0.55)))
        return join(parts)

    def keel(self, d):
        """Keel, stem and skeg as one timber along the profile."""
        t = np.linspace(1, 0, d.n(24))
        bottom = self.loft.points(t, [0])[:, 0]
        stem = self.loft.points([0], np.linspace(0, 1, d.n(12)))[0][1:]
        path = np.concatenate([bottom, stem, stem[-1:] + [[0, 0.06, -0.004]]])
        path[:, 0] = 0
        path = spline(path, d.n(48))
        out = np.gradient(path, axis=0)
        out = np.stack([np.zeros(len(out)), out[:, 2], -out[:, 1]], -1)  # away from the planking
        out /= np.linalg.norm(out, axis=1, keepdims=True)
        wide = np.clip(np.abs(np.linspace(-1, 1, len(path))), 0, 1)
        profile = rect(0.034, 0.062, 0.006)
        timber = sweep(path + out * 0.022, profile, OAK, up=-out, scale=np.stack([1 - 0.25 * wide ** 4, np.ones(len(path))], -1))
        z = np.linspace(0.55, 1.47, d.n(10))
        under = np.array([self.profile_y(v) for v in z]) - 0.02
        straight = np.minimum(np.full(len(z), under[0] - 0.03), under - 0.004)
        skeg = panel(np.concatenate([np.stack([np.full(len(z), 0.014), under, z], -1),
                                     np.stack([np.full(len(z), 0.014), straight, z], -1)[::-1]])[::-1], 0.028, OAK, bevel=0.003)
        return join([timber, skeg])

    def profile_y(self, z):
        p = self.loft.points(np.linspace(0, 1, 101), [0])[:, 0]
        return float(np.interp(z, p[:, 2], p[:, 1]))

    def rail(self, t, inset_x, drop, profile, paint):
        p = self.loft.points(t, [1.0])[:, 0]
        n = self.loft.normals(t, [1.0])[:, 0] * [1, 0, 1]
        n /= np.linalg.norm(n, axis=1, keepdims=True)
        return sweep(p - n * inset_x + [0, drop, 0], profile, paint)

    def rails(self, d):
        t = np.linspace(0.004, 1, d.n(28))
        parts = [self.rail(t, -0.014, -0.012, rect(0.030, 0.040, 0.010, 2 if d.full else 1), OAK)]
        if not d.far:
            t = np.linspace(0.05, 0.985, d.n(24))
            parts.append(self.rail(t, 0.026, -0.010, rect(0.020, 0.034, 0.005), OAK))
            parts.append(self.rail(t, 0.005, 0.009, rect(0.046, 0.006), OAK))
            # The riser, under the thwarts.
            t = np.linspace(0.10, 0.97, d.n(24))
            p = self.loft.offset(t, [0.66], np.full((1, 1), -THICK - 0.016))[:, 0]
            parts.append(sweep(p, rect(0.016, 0.045, 0.004), PINE, up=(0, 1, 0)))
        return join(parts)

    def frames(self, d):
        parts = []
        if d.far:
            return join(parts)
        for z in np.arange(-1.22, 1.40, 0.155 if d.full else 0.31):
            sec = self.loft.section(z, 21 if d.full else 11, THICK + 0.003)
            sec = sec[(sec[:, 0] > 0.004)]
            path = np.concatenate([sec[::-1] * [-1, 1, 1], sec])
            parts.append(sweep(spline(path, d.n(24)), rect(0.012, 0.024), INNER.tinted(.92, .82, .68), up=(0, 0, 1), caps=False))
        return join(parts)

    def inside_y(self, z, x):
        sec = self.loft.section(z, 41, THICK + 0.012)
        return float(np.interp(x, sec[:, 0], sec[:, 1]))

    def floor(self, d):
        if d.far:
            return None
        parts = []
        for x, z0, z1 in ((0.0, -1.05, 1.28), (0.115, -0.92, 1.20), (0.23, -0.72, 1.02)):
            z = np.linspace(z0, z1, d.n(12))
            for side in ((1,) if x == 0 else (1, -1)):
                y = [max(self.inside_y(v, x + 0.05), self.inside_y(v, 0.0)) + 0.008 for v in z]
                path = np.stack([np.full(len(z), side * x), y, z], -1)
                parts.append(sweep(path, rect(0.102, 0.012, 0.002), GREY.tinted(*(np.array([.95, .93, .9]) * (1 - 0.06 * ((z0 * 37) % 1))))))
        for z in (-0.45, 0.12, 0.7):
            if d.full:
                parts.append(bar((-0.27, self.inside_y(z, 0.25) + .001, z), (0.27, self.inside_y(z, 0.25) + .001, z), 0.04, 0.012, GREY))
        return join(parts)

    def seat_outline(self, z0, z1, y, gap=0.004):
        z = np.linspace(z0, z1, 5)
        right = np.array([[self.loft.half_width(v, y, THICK + gap), y, v] for v in z])
        return upward(np.concatenate([right, right[::-1] * [-1, 1, 1]]))

    def thwarts(self, d):
        parts = []
        self.seat_y = 0.235 + self.loft.shift + 0.05
        y = self.seat_y
        for z0, z1 in ((-0.98, -0.76), (-0.21, 0.02)):
            parts.append(panel(self.seat_outline(z0, z1, y), 0.024, PINE, bevel=0 if d.far else 0.005))
        # Stern sheets: boards athwart the stern and benches along the sides.
        parts.append(panel(self.seat_outline(0.98, 1.22, y), 0.020, PINE, bevel=0 if d.far else 0.004))
        parts.append(panel(self.seat_outline(1.225, 1.46, y), 0.020, PINE.tinted(.95, .93, .86), bevel=0 if d.far else 0.004))
        if not d.far:
            for z in (-0.87, -0.095):
                low = self.inside_y(z, 0.0)
                parts.append(bar((0, low, z), (0, y - 0.02, z), 0.035, 0.035, OAK, bevel=0.004))
                for side in (1, -1) if d.full else ():
                    parts.append(self.knee(z, y, side, d))
        return join(parts)

    def knee(self, z, y, side, d):
        """A thwart's knee: from the thwart's top up the planking to the gunwale."""
        top = self.loft.section(z, 31, THICK + 0.004)
        top = top[(top[:, 1] > y - 0.002)]
        heights = np.linspace(y, top[-1, 1] - 0.015, 5)
        outer = np.array([[np.interp(h, top[:, 1], top[:, 0]), h, z - 0.011] for h in heights])
        inner = spline(np.array([outer[-1] - [0.022, 0, 0], outer[2] - [0.045, 0.01, 0], [outer[0][0] - 0.17, y + 0.012, z - 0.011], [outer[0][0] - 0.19, y, z - 0.011]]), 8)
        shape = np.concatenate([outer, inner])
        facing = np.cross(shape[1] - shape[0], shape[6] - shape[0])[2] > 0
        m = panel(shape if not facing else shape[::-1], 0.022, OAK, bevel=0.003)
        m = m if np.allclose(m.p[:, :, 2].min(), z - 0.011, atol=1e-3) else m.move(z=0)
        return m if side > 0 else m.mirror()

    def ends(self, d):
        """Transom, breasthook, quarter knees."""
        s = np.linspace(0, 1, d.n(18))
        edge = self.loft.points([1.0], s)[0]
        crown = edge[-1, 1] + 0.035
        top = [(edge[-1, 0] * k, crown - 0.035 * k * k + (-0.0), edge[-1, 2] + 0.006 * (1 - k * k)) for k in (0.75, 0.5, 0.25, 0, -0.25, -0.5, -0.75)]
        outline = np.concatenate([edge, top, (edge * [-1, 1, 1])[::-1]])
        # Seen from astern counter-clockwise is keel, starboard, top, port.
        board = panel(outline + [0, 0, 0.012], 0.026, OAK.tinted(.80, .62, .46), bevel=0 if d.far else 0.005)
        parts = [board]
        if not d.far:
            p = self.loft.offset([0.035, 0.07, 0.105, 0.14], [1.0], np.full((1, 1), -THICK))[:, 0]
            hook = np.concatenate([p, [[0.05, p[-1, 1], p[-1, 2] - 0.05]], [[-0.05, p[-1, 1], p[-1, 2] - 0.05]], (p * [-1, 1, 1])[::-1]])
            hook[:, 1] = np.interp(hook[:, 2], p[:, 2], p[:, 1]) + 0.004
            parts.append(panel(upward(hook), 0.026, OAK, bevel=0.004))
            q = self.loft.offset([0.90, 0.93, 0.96, 0.992], [1.0], np.full((1, 1), -THICK))[:, 0]
            knee = np.concatenate([q, [[q[-1, 0] - 0.19, q[-1, 1] + .004, q[-1, 2] - .005], [q[-1, 0] - 0.18, q[-1, 1] + .004, q[-1, 2] - .03], [q[2, 0] - .05, q[2, 1], q[2, 2]]]])
            knee[:, 1] += 0.004
            parts.append(panel(upward(knee), 0.024, OAK, bevel=0.004).both_sides())
        return join(parts)

    def fittings(self, d):
        """Rowlock blocks, rings, painter, bailer."""
        if not d.full:
            return None
        x, y = self.rowlock()[:2]
        parts = [bar((x - 0.012, y - 0.045, self.rowlock_z - 0.11), (x - 0.012, y - 0.045, self.rowlock_z + 0.11), 0.05, 0.034, OAK, bevel=0.006),
                 bar((x - 0.012, y - 0.026, self.rowlock_z - 0.04), (x - 0.012, y - 0.026, self.rowlock_z + 0.04), 0.034, 0.006, BRASS)]
        out = [join(parts).both_sides()]
        stem = self.loft.points([0], [0.78])[0, 0]
        out.append(ring((0, stem[1] - 0.02, stem[2] - 0.065), (1, 0, 0), 0.022, 0.004, BRASS, d.n(16), d.n(6)))
        z, y = 1.52, self.seat_y + 0.12
        out.append(ring((0, y, z - 0.02), (0.2, 0, 1), 0.024, 0.004, BRASS, d.n(16), d.n(6)))
        if d.full:
            out += self.painter()
            out.append(lathe([(0.0, 0.002), (.05, .002), (.06, .1), (.056, .1), (.047, .008), (0, .008)], 14, LEATHER.tinted(.75, .72, .62)).turn("x", 62).move(0.2, self.inside_y(0.5, 0.2) + 0.07, 0.5))
        return join(out)

    def painter(self):
        """A coil of rope on the bottom boards before the bow thwart, made fast to the ring."""
        y = self.inside_y(-0.62, 0.05) + 0.03
        turns, r = 5, 0.012
        a = np.linspace(0, turns * 2 * np.pi, turns * 13)
        radius = 0.085 + 0.035 * (a / a[-1]) + 0.006 * np.sin(3.3 * a)
        coil = np.stack([radius * np.cos(a), y + 0.006 * np.sin(a * 0.9) + 0.010 * (a / (2 * np.pi)) % 0.02, -0.56 + radius * 0.92 * np.sin(a)], -1)
        stem = self.loft.points([0.05], [1.0])[0, 0]
        lead = spline([coil[-1], [0.10, y + .02, -0.70], [0.05, y + 0.03, -1.02], [0.02, stem[1] - 0.14, -1.36], [0, stem[1] + 0.03, -1.50], [0, stem[1] + 0.035, -1.615], [0, stem[1] - 0.07, -1.66]], 30)
        return [tube(coil, r, ROPE, 5), tube(lead, r, ROPE, 5)]

    def rowlock(self):
        p = self.loft.points(self.loft.t_at(self.rowlock_z), [1.0])[0, 0]
        return np.array([p[0] + 0.005, p[1] + 0.055, self.rowlock_z])

    def hull(self, d):
        skin = self.planking(d)
        outside = skin
        for y in (0.035, 0.055):
            outside = cut(outside, "y", y)
        outside = self.bottom_paint(outside)
        parts = [outside.both_sides(), self.keel(d), self.rails(d).both_sides(), self.frames(d), self.floor(d), self.thwarts(d), self.ends(d), self.fittings(d)]
        return join(parts)

    def bottom_paint(self, m):
        """Antifouling below the boot-top, a grubby band above it. Only on what faces outwards."""
        c = m.centres()
        n = np.cross(m.p[:, 1] - m.p[:, 0], m.p[:, 2] - m.p[:, 0])
        n /= np.linalg.norm(n, axis=1, keepdims=True) + 1e-12
        t = self.loft.t_at(c[:, 2], 0.6)
        outward = np.abs(m.uv[:, 0, 1] - self.middle(PLANK)) <= (PLANK.skin.v1 - PLANK.skin.v0) / 2 + 1e-6
        low = outward & (c[:, 1] < 0.035)
        m.uv[low, :, 1] = m.uv[low, :, 1] - PLANK.skin.v0 + BOTTOM.skin.v0
        m.c[low] = linear(BOTTOM.colour)
        band = outward & (c[:, 1] >= 0.035) & (c[:, 1] < 0.055)
        m.c[band] = linear((0.12, 0.13, 0.14))
        grub = outward & (c[:, 1] >= 0.055)
        fade = np.clip(1 - (m.p[:, :, 1] - 0.055) / 0.12, 0, 1)[..., None]
        m.c[grub] = (m.c * (1 - fade * (1 - np.array([0.80, 0.80, 0.70]))))[grub]
        return m

    @staticmethod
    def middle(paint):
        return (paint.skin.v0 + paint.skin.v1) / 2


def oar(d, boat):
    """The starboard oar with its rowlock, lying outboard and a little down, the blade clear of the water."""
    n = d.sides(12)
    x = np.array([-0.61, -0.605, -0.50, -0.49, -0.1, 0.0, 0.3, 0.9, 1.12, 1.2])
    r = np.array([0.012, 0.016, 0.017, 0.021, 0.023, 0.0235, 0.0225, 0.019, 0.017, 0.014])
    shaft = sweep(np.stack([x, 0 * x, 0 * x], -1), circle(1, n), PINE, scale=r)
    parts = [shaft]
    # The blade: a lens section, a little spooned, with a copper tip.
    bx = np.linspace(1.05, 1.58, d.n(12))
    k = (bx - 1.05) / 0.53
    half = 0.012 + 0.058 * np.clip(np.sin(np.minimum(k * 1.7, 1.57)), 0, 1) ** 1.2
    thick = 0.014 * (1 - 0.62 * k)
    lens = np.stack([np.cos(np.arange(8) * np.pi / 4), np.sin(np.arange(8) * np.pi / 4)], -1)
    bend = 0.035 * k ** 2
    path = np.stack([bx, 0 * bx, bend], -1)
    parts.append(sweep(path, lens, PINE.tinted(.98, .94, .86), up=(0, 1, 0), scale=np.stack([thick, half], -1)))
    if not d.far:
        parts.append(sweep(np.array([[1.54, 0, bend[-1] * .87], [1.585, 0, bend[-1] * 1.01]]), lens, BRASS.tinted(.75, .45, .28), scale=np.stack([[.0085, .0085], [.071, .071]], -1)))
        parts.append(sweep(np.array([[-0.11, 0, 0], [0.14, 0, 0]]), circle(0.0258, n), LEATHER))
        parts.append(sweep(np.array([[-0.125, 0, 0], [-0.105, 0, 0]]), circle(0.034, n), LEATHER))
        parts.append(sweep(np.array([[-0.612, 0, 0], [-0.50, 0, 0]]), circle(0.0185, n), LEATHER.tinted(.16, .13, .12)))
    m = join(parts).turn("z", -boat.oar_droop)
    if not d.far:
        # The rowlock: a brass horn around the loom, its shank in the block.
        a = np.radians(np.linspace(-215, 35, d.n(14)))
        horn = np.stack([0 * a, 0.042 * np.sin(a) + 0.006, 0.036 * np.cos(a)], -1)
        m = join([m, tube(horn, 0.007, BRASS, d.sides(8)), tube(np.array([[0, -0.036, 0], [0, -0.075, 0]]), 0.008, BRASS, d.sides(8))])
    return m.move(*boat.rowlock())


def build():
    boat = Boat()
    boat.oar_droop = 13.0
    model = Model("rowing_boat", "hull", [sheet], (12, 45, 900), 0.022)
    model.part("hull", boat.hull)
    pivot = boat.rowlock()
    model.part("oar_right", lambda d: oar(d, boat), pivot, axis=(0, 1, 0))
    model.part("oar_left", lambda d: oar(d, boat).mirror(), pivot * [-1, 1, 1], axis=(0, 1, 0))
    model.body("collision", boat.collision)
    loft = boat.loft
    t, s = np.linspace(0.01, 0.99, 24), np.linspace(0, 1, 15)
    # Within the planks, whose inner side lies up to 2 mm below the loft: else slits of water stood along them.
    model.body("inside_boat", closed_from(loft.offset(t, s, np.full((1, 1), 0.001))))
    model.floats(130.0, round(0.19 + loft.shift, 4), physics.hull_inertia(130.0, 3.2, 1.29), 3.2, 1.29)
    seat = boat.seat_y if hasattr(boat, "seat_y") else 0.25
    droop = np.radians(boat.oar_droop)
    handle = pivot + [-0.55 * np.cos(droop), 0.55 * np.sin(droop), 0]
    model.extras.update({
        "light_kg": 50.0, "crew_kg": 80.0,
        "oars": [{"at_m": [round(float(side * pivot[0]), 3), round(float(pivot[1]), 3), round(float(pivot[2]), 3)], "length_m": 1.33, "area_m2": 0.06, "node": name}
                 for name, side in (("oar_left", -1), ("oar_right", 1))],
        "seats": [{"at_m": [0, round(seat, 3), -0.095], "yaw_deg": 180, "role": "rower"}, {"at_m": [0, round(seat, 3), 1.2], "yaw_deg": 0, "role": "passenger"},
                  {"at_m": [0, round(seat, 3), -0.87], "yaw_deg": 180, "role": "passenger"}],
        "grips": [{"name": name, "at_m": [round(side * float(handle[0]), 3), round(float(handle[1]), 3), round(float(handle[2]), 3)], "axis": [0, 1, 0],
                   "range_deg": [-55, 45], "node": name} for name, side in (("oar_left", -1), ("oar_right", 1))],
        "lights": []})
    return model
