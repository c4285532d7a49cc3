"""A rigid inflatable boat of 7.3 m, 2 t, with a 190 kW outboard: deep-V hull, tubes, console, jockey seats, A-frame."""
import numpy as np

import boatparts as gear
import physics
import surfaces as on
from hull import Loft, closed_from
from mesh import join
from model import Model
from shapes import Paint, bar, box, circle, coil, grid, lathe, panel, rect, ring, spline, sweep, tube, upward
from textures import Sheet

STATIONS = [
    [(.02, .85, -3.05), (.03, .92, -3.10), (.05, 1.0, -3.15), (.06, 1.05, -3.18), (.07, 1.10, -3.20)],
    [(.02, .42, -2.3), (.25, .58, -2.3), (.52, .72, -2.3), (.58, .86, -2.32), (.62, 1.0, -2.34)],
    [(.02, .12, -1.2), (.42, .32, -1.2), (.82, .52, -1.2), (.88, .68, -1.2), (.90, .86, -1.2)],
    [(.02, 0, .5), (.46, .19, .5), (.93, .40, .5), (.96, .56, .5), (.98, .74, .5)],
    [(.02, 0, 2.2), (.46, .18, 2.2), (.95, .37, 2.2), (.97, .53, 2.2), (.98, .70, 2.2)],
    [(.02, .01, 3.2), (.46, .18, 3.2), (.95, .37, 3.2), (.97, .53, 3.2), (.98, .70, 3.2)]]
MASS, R = 2000.0, 0.25

sheet = Sheet("sheet", 384, 1024, [("gelcoat", 96, on.gelcoat), ("nonskid", 96, on.nonskid), ("fabric", 96, on.rubber), ("steel", 32, on.steel), ("antifouling", 64, on.antifouling),
                                   ("moulding", 96, on.moulding), ("rope", 32, on.rope)], 91)
ORANGE = (0.90, 0.30, 0.05)
P = {"hull": Paint(sheet["gelcoat"], (0.16, 0.17, 0.19)), "white": Paint(sheet["gelcoat"], (0.92, 0.92, 0.90)), "deck": Paint(sheet["nonskid"], (0.55, 0.56, 0.57)),
     "tube": Paint(sheet["fabric"], ORANGE), "patch": Paint(sheet["fabric"], (0.10, 0.10, 0.11)), "grey": Paint(sheet["fabric"], (0.35, 0.36, 0.38)), "steel": Paint(sheet["steel"], (0.9, 0.9, 0.9)),
     "black": Paint(sheet["moulding"], (0.06, 0.06, 0.065)), "cushion": Paint(sheet["moulding"], (0.11, 0.12, 0.14)), "glass": Paint(sheet["moulding"], (0.03, 0.035, 0.04)),
     "engine": Paint(sheet["moulding"], (0.05, 0.055, 0.06)), "silver": Paint(sheet["gelcoat"], (0.55, 0.57, 0.6)), "rope": Paint(sheet["rope"], (0.85, 0.84, 0.8), whole=True),
     "bottom": Paint(sheet["antifouling"], (0.12, 0.13, 0.15)), "lens": Paint(sheet["moulding"])}
LINE = [(1.05, .74, 3.45), (1.05, .74, 2.2), (1.04, .78, .5), (0.98, .88, -1.1), (0.76, 1.03, -2.3), (0.44, 1.14, -3.05), (0.0, 1.19, -3.36)]


class Boat:
    def __init__(self):
        self.loft = Loft(STATIONS, [(0, 1, 2), (2, 3, 4)])
        self.shift = 0.0
        self.shift = physics.sink(self.coarse(), MASS)
        self.loft.shift = self.shift
        self.collision = self.coarse(0.0)
        self.floor = 0.60 + self.shift
        self.wheel_at = np.array([-0.32, self.floor + 0.98, 0.50])
        self.throttle_at = np.array([0.08, self.floor + 0.93, 0.40])

    def tube_line(self, n, shift=None):
        """The starboard tube's centre from the stern to the stem."""
        return spline(LINE, n) + [0, self.shift if shift is None else shift, 0]

    def coarse(self, shift=None):
        """Hull and tubes as one closed body, for physics."""
        line = self.tube_line(200, shift)[::-1]
        rows = []
        t = np.concatenate([[0], np.linspace(0.08, 1, 9)])
        p = self.loft.points(t, [0, 0.25, 0.5, 0.98])
        for k in range(len(t)):
            z = p[k, 3, 2]
            c = np.array([np.interp(z, line[:, 2], line[:, i]) for i in range(3)])
            away = np.array([1.0, 0, 0])
            if k == 0:
                c, away = line[0] + [0.05, 0, 0], np.array([0.15, 0, -1.0])
            q = [c + R * (np.cos(a) * away + np.sin(a) * np.array([0, 1, 0])) for a in np.radians([-50, 0, 50, 90])]
            rows.append(np.concatenate([p[k], q]))
        rows = np.array(rows)
        rows[..., 0] = np.maximum(rows[..., 0], 0)
        return closed_from(rows)

    def hull_shell(self, d):
        t = np.linspace(0, 1, d.n(34))
        low = self.loft.shell(t, np.linspace(0, 0.5, d.n(7, 2)), P["hull"])
        side = self.loft.shell(t, np.linspace(0.5, 1.0, d.n(4, 2)), P["hull"])
        parts = [gear.painted_bottom(join([low, side]), [P["hull"]], P["bottom"], (0.9, 0.9, 0.88), -0.02, 0.03)]
        if d.full:  # spray rails and the chine's flat
            for s, w in ((0.19, 0.035), (0.34, 0.035), (0.5, 0.06)):
                tt = np.linspace(0.06 + 0.12 * (0.5 - s), 0.995, 26)
                p = self.loft.points(tt, [s])[:, 0]
                parts.append(sweep(p, np.array([[w * 0.7, -0.006], [w * 0.55, 0.02], [-w * 0.6, 0.02], [-w * 0.6, -0.002]]), P["bottom"]))
        out = [join(parts).both_sides()]
        edge = self.loft.points([1.0], [0, .25, .5, .75, 1.0])[0]
        top = self.floor + 0.46
        outline = np.concatenate([edge, [[0.98, top, 3.2], [0.42, top, 3.2], [0.36, top - 0.13, 3.2]], [[-0.36, top - 0.13, 3.2], [-0.42, top, 3.2], [-0.98, top, 3.2]], (edge * [-1, 1, 1])[::-1]])
        out.append(panel(outline + [0, 0, 0.002], 0.07, P["hull"], bevel=0 if d.far else 0.01))
        return out

    def tubes(self, d):
        n = d.n(56, 9)
        line = self.tube_line(n)
        sides = d.sides(22)
        r = np.full(n, R)
        z = line[:, 2]
        both = np.concatenate([line, (line * [-1, 1, 1])[::-1][1:]])
        scale = np.concatenate([r, r[::-1][1:]])
        a = np.arange(sides) * 2 * np.pi / sides
        m = sweep(both, circle(1, sides), P["tube"], scale=scale, caps=False)
        parts = [m]
        # Cones aft: the fabric ends in a rounded cone.
        k = np.linspace(0, 1, d.n(7))
        cone = sweep(np.stack([0 * k + 1.05, 0 * k + line[0, 1], 3.45 + 0.34 * k], -1), circle(R, sides), P["tube"], scale=np.sqrt(np.maximum(1 - k ** 1.7, 0.0)) + 1e-3)
        parts.append(cone.both_sides())
        if d.far:
            return parts
        x, y = self.frames_of(both)
        # Rubbing strake outside, wear patches on top, seams, grab lines with their patches.
        strake = np.array([[-0.004, -0.055], [0.014, -0.05], [0.03, -0.025], [0.034, 0.0], [0.03, 0.025], [0.014, 0.05], [-0.004, 0.055]])
        parts.append(sweep(both + x * (R - 0.004), strake, P["patch"], up=y, caps=True))
        for z0, z1 in ((2.6, 1.5), (0.9, -0.1), (-1.2, -2.2)):
            seg = np.array([p for p in self.tube_line(160) if z1 <= p[2] <= z0])[::6 if d.full else 14]
            fx, fy = self.frames_of(seg)
            ang = np.radians(np.linspace(35, 145, d.n(8, 4)))
            pts = seg[:, None] + (R + 0.004) * (fx[:, None] * np.cos(ang)[None, :, None] + fy[:, None] * np.sin(ang)[None, :, None])
            parts.append(grid(pts, P["grey"]).both_sides())
        if d.full:
            for z in (2.9, 1.2, -0.5, -1.7, -2.75):
                at = min(range(len(line)), key=lambda i: abs(line[i, 2] - z))
                seg = line[max(at - 1, 0):at + 2]
                fx, fy = self.frames_of(seg)
                ang = np.linspace(0, 2 * np.pi, 21)
                mid = seg[len(seg) // 2]
                tangent = np.cross(fy[1], fx[1])
                rows = np.array([[mid + tangent * w + (R + 0.003) * (fx[1] * np.cos(q) + fy[1] * np.sin(q)) for q in ang] for w in (-0.03, 0.03)])
                m = grid(rows, P["tube"].tinted(.72, .22, .04))
                out = np.sum(np.cross(m.p[:, 1] - m.p[:, 0], m.p[:, 2] - m.p[:, 0]) * (m.centres() - mid))
                parts.append((m if out > 0 else m.flipped()).both_sides())
            parts += self.grab_lines()
            for z in (2.2, -0.8):
                p = self.tube_line(200)[np.argmin(np.abs(self.tube_line(200)[:, 2] - z))]
                parts.append(lathe(np.array([(0.045, 0), (0.045, 0.008), (0.03, 0.014), (0, 0.015)]), 12, P["black"]).turn("z", 62).move(p[0] - R * 0.88, p[1] + R * 0.47, z).both_sides())
        return parts

    @staticmethod
    def frames_of(path):
        t = np.gradient(path, axis=0)
        t /= np.linalg.norm(t, axis=1, keepdims=True)
        y = np.array([0, 1.0, 0]) - t * t[:, 1:2]
        y /= np.linalg.norm(y, axis=1, keepdims=True)
        return np.cross(t, y), y

    def grab_lines(self):
        parts = []
        line = self.tube_line(240)
        x, y = self.frames_of(line)
        stops = [2.7, 1.9, 1.1, 0.3, -0.5, -1.3, -2.0]
        a = np.radians(52)
        at = lambda z: (lambda i: (line[i] + (R + 0.012) * (x[i] * np.cos(a) + y[i] * np.sin(a)), x[i] * np.cos(a) + y[i] * np.sin(a)))(int(np.argmin(np.abs(line[:, 2] - z))))
        for z0, z1 in zip(stops[:-1], stops[1:]):
            pts = []
            for k in np.linspace(0, 1, 7):
                p, n = at(z0 + (z1 - z0) * k)
                drop = 4 * k * (1 - k)
                pts.append(p + n * 0.02 * drop - np.array([0, 0.05, 0]) * drop * 0.6)
            parts.append(tube(np.array(pts), 0.009, P["rope"], 5))
        for z in stops:
            p, n = at(z)
            parts.append(lathe(np.array([(0.055, -0.012), (0.05, 0.0), (0.02, 0.012), (0, 0.013)]), 10, P["patch"]).turn("z", -38).move(*p))
        return [join(parts).both_sides()]

    def deck(self, d):
        z = np.linspace(-2.75, 3.14, d.n(20))
        line = self.tube_line(200)[::-1]
        half = np.interp(z, line[:, 2], line[:, 0]) - R * 0.80
        rise = np.interp(z, [-2.75, -1.6, 3.2], [0.34, 0.0, 0.0])
        edge = np.stack([np.maximum(half, 0.02), self.floor + rise, z], -1)
        parts = [gear.deck(edge, P["deck"], 0.235 if not d.far else 1.2)]
        if d.far:
            return parts
        # The inner wall from the deck up under the tube.
        wall = np.stack([edge, edge + [0.05, 0.0, 0], np.stack([edge[:, 0] + 0.02, edge[:, 1] + 0.14, z], -1)], 1)
        parts.append(grid(wall[:, [0, 2]], P["white"]).both_sides())
        # Bow locker and sampson post.
        y = self.floor
        hatch = np.array([(-0.5, y + 0.36, -1.35), (0.5, y + 0.36, -1.35), (0.30, y + 0.40, -2.35), (-0.30, y + 0.40, -2.35)])
        parts.append(panel(upward(hatch), 0.38, P["white"], bevel=0.03))
        parts.append(panel(upward(hatch * [0.82, 1, 1] + [[0, 0.012, -.1], [0, 0.012, -.1], [0, 0.012, .1], [0, 0.012, .1]]), 0.02, P["deck"], bevel=0.006))
        parts.append(tube(np.array([[0, y + 0.3, -2.55], [0, y + 0.66, -2.55]]), 0.035, P["steel"], d.sides(10)))
        parts.append(tube(np.array([[-0.12, y + 0.56, -2.55], [0.12, y + 0.56, -2.55]]), 0.018, P["steel"], d.sides(8)))
        if d.full:
            parts.append(coil((0.0, y + 0.39, -1.75), 0.17, 0.011, 7, P["rope"], 10, 4))
        return parts

    def console(self, d):
        y = self.floor
        if d.far:
            return [box((0, y + 0.5, 0.1), (1.0, 1.0, 0.6), P["white"]), box((0, y + 0.4, 1.4), (1.0, 0.7, 1.3), P["cushion"])]
        w, parts = 0.52, []
        side = np.array([(0, -0.30), (0, 0.50), (0.66, 0.44), (0.88, 0.52), (1.06, 0.30), (1.10, 0.02), (0.55, -0.24)])  # height, z
        outline = np.array([[w, y + h, z] for h, z in side])
        outline = outline if np.cross(outline[1] - outline[0], outline[2] - outline[0])[0] > 0 else outline[::-1]
        parts.append(panel(outline, 2 * w, P["white"], bevel=0.03))
        # Dash, screens, windscreen with its rail.
        parts.append(panel(np.array([[-0.46, y + 0.885, 0.525], [0.46, y + 0.885, 0.525], [0.46, y + 1.055, 0.315], [-0.46, y + 1.055, 0.315]]) + [0, 0.012, 0.010], 0.02, P["black"], bevel=0.005))
        for x in (-0.02, 0.30):
            parts.append(panel(np.array([[x - 0.12, y + 0.92, 0.495], [x + 0.12, y + 0.92, 0.495], [x + 0.12, y + 1.04, 0.345], [x - 0.12, y + 1.04, 0.345]]) + [0, 0.024, 0.02], 0.012, P["glass"], bevel=0.004))
        rail = spline([(0.50, y + 1.06, 0.20), (0.49, y + 1.38, 0.02), (0.40, y + 1.47, -0.04), (0, y + 1.49, -0.05)], d.n(10))
        parts.append(tube(np.concatenate([rail, (rail * [-1, 1, 1])[::-1][1:]]), 0.014, P["steel"], d.sides(8)))
        parts.append(tube(np.array([[0.53, y + 0.25, 0.05], [0.60, y + 0.30, 0.05], [0.60, y + 0.85, 0.05], [0.53, y + 0.90, 0.05]]), 0.013, P["steel"], d.sides(7)).both_sides())
        for x, z in ((-0.32, 1.12), (0.32, 1.12), (-0.32, 2.05), (0.32, 2.05)):
            parts += self.jockey(d, x, z)
        return parts

    def jockey(self, d, x, z):
        y = self.floor
        base = np.array([[x + 0.13, y, z - 0.36], [x + 0.13, y, z + 0.32], [x + 0.11, y + 0.60, z + 0.30], [x + 0.11, y + 0.60, z - 0.30]])
        base = base if np.cross(base[1] - base[0], base[2] - base[0])[0] > 0 else base[::-1]
        parts = [panel(base, 0.24, P["white"], bevel=0.03)]
        k = np.linspace(0, 1, d.n(9, 4))
        path = np.stack([np.full(len(k), x), y + 0.66 + 0.03 * np.cos(k * 5), z - 0.36 + 0.70 * k], -1)
        parts.append(sweep(path, rect(0.31, 0.14, 0.05, 2 if d.full else 1), P["cushion"], scale=np.stack([np.interp(k, [0, .12, .9, 1], [.55, .9, 1, .9]), np.interp(k, [0, .1, .9, 1], [.6, 1, 1, .8])], -1)))
        parts.append(bar((x, y + 0.70, z + 0.34), (x, y + 1.02, z + 0.42), 0.30, 0.09, P["cushion"], up=(0, 0, 1), bevel=0.03))
        if d.full:
            hoop = spline([(x - 0.13, y + 0.5, z + 0.34), (x - 0.14, y + 0.95, z + 0.46), (x - 0.08, y + 1.06, z + 0.49), (x, y + 1.07, z + 0.49)], 8)
            parts.append(tube(np.concatenate([hoop, ((hoop - [x, 0, 0]) * [-1, 1, 1] + [x, 0, 0])[::-1][1:]]), 0.012, P["steel"], 6))
        return parts

    def frame(self, d):
        """The A-frame with lights, radar, aerials, a self-righting bag."""
        y, s = self.floor, d.sides(10)
        leg = spline([(0.92, y + 0.30, 2.95), (0.86, y + 1.35, 2.88), (0.70, y + 1.66, 2.85), (0.0, y + 1.70, 2.85)], d.n(14))
        parts = [tube(np.concatenate([leg, (leg * [-1, 1, 1])[::-1][1:]]), 0.032, P["steel"], s)]
        if d.far:
            return parts
        parts.append(tube(np.array([[0.90, y + 0.30, 2.25], [0.85, y + 1.30, 2.86]]), 0.026, P["steel"], s).both_sides())
        parts.append(tube(np.array([[-0.84, y + 1.40, 2.87], [0.84, y + 1.40, 2.87]]), 0.022, P["steel"], s))
        parts.append(lathe(np.array([(0, 0), (0.20, 0.01), (0.23, 0.06), (0.21, 0.15), (0.08, 0.19), (0, 0.19)]), d.sides(20), P["white"]).move(0.0, y + 1.74, 2.85))
        for x, h in ((0.62, 1.9), (-0.62, 1.1)):
            parts.append(tube(np.array([[x, y + 1.6, 2.86], [x, y + 1.7 + h, 2.95]]), 0.009, P["white"], 5))
        if d.full:
            k = np.linspace(0, 1, 9)
            parts.append(sweep(np.stack([-0.62 + 1.24 * k, 0 * k + y + 1.54, 0 * k + 2.98], -1), circle(0.10, 12), P["tube"], scale=0.55 + 0.45 * np.sqrt(np.clip(1 - (2 * k - 1) ** 4, 0, 1))))
            parts += [gear.lamp(d, (0.74, y + 1.66, 2.80), (.05, .7, .3), P["black"], P["lens"], .04), gear.lamp(d, (-0.74, y + 1.66, 2.80), (.8, .06, .05), P["black"], P["lens"], .04),
                      gear.lamp(d, (0.35, y + 1.73, 2.85), (1, 1, .95), P["black"], P["lens"], .045)]
            for x in (-0.4, 0.5):
                parts.append(lathe(np.array([(0.02, 0), (0.06, 0.07), (0.065, 0.09), (0, 0.085)]), 12, P["black"]).turn("x", -80).move(x, y + 1.62, 2.80))
            parts.append(ring((0, self.shift + 0.72, -3.0), (1, 0, 0), 0.045, 0.011, P["steel"], 14, 6))
        return parts

    def hull(self, d):
        return join(self.hull_shell(d) + self.tubes(d) + self.deck(d) + self.console(d) + self.frame(d))

    ENGINE_Z = 3.36

    def engine(self, d):
        """The outboard: cowl, leg, plate, gearcase with skeg, bracket."""
        y, z = self.floor, self.ENGINE_Z
        n = d.n(10, 4)
        k = np.linspace(0, 1, n)
        path = np.stack([0 * k, y + 0.34 + 0.72 * k, z + 0.30 + 0.04 * np.sin(k * 3)], -1)
        profile = rect(0.46, 0.72, 0.16, 3 if d.full else 1)
        sx = np.interp(k, [0, 0.15, 0.7, 0.92, 1], [0.74, 0.95, 1.0, 0.82, 0.45])
        sz = np.interp(k, [0, 0.15, 0.7, 0.92, 1], [0.78, 0.97, 1.0, 0.86, 0.55])
        cowl = sweep(path, profile, P["engine"], up=(0, 0, 1), scale=np.stack([sx, sz], -1))
        parts = [cowl]
        leg_p = np.stack([0.5 * np.cos(np.arange(10) * np.pi / 5), 0.5 * np.sin(np.arange(10) * np.pi / 5)], -1)
        low = -0.42
        path = np.array([[0, y + 0.38, z + 0.24], [0, y + 0.05, z + 0.24], [0, 0.02, z + 0.28], [0, low + 0.10, z + 0.30]])
        parts.append(sweep(path, leg_p, P["engine"].tinted(.09, .095, .1), up=(0, 0, 1), scale=np.array([[0.24, 0.46], [0.20, 0.38], [0.13, 0.36], [0.085, 0.34]])))
        case = np.linspace(0, 1, d.n(10, 4))
        r = 0.085 * np.sqrt(np.maximum(np.sin(np.pi * np.clip(case * 0.86 + 0.03, 0, 1)), 0.02))
        parts.append(sweep(np.stack([0 * case, 0 * case + low, z - 0.06 + 0.66 * case], -1), circle(1, d.sides(14)), P["engine"].tinted(.09, .095, .1), scale=r))
        plate = np.array([[-0.11, low + 0.26, z + 0.05], [0.11, low + 0.26, z + 0.05], [0.13, low + 0.26, z + 0.62], [0, low + 0.26, z + 0.70], [-0.13, low + 0.26, z + 0.62]])
        parts.append(panel(upward(plate), 0.014, P["engine"].tinted(.09, .095, .1)))
        skeg = np.array([[0.007, low - 0.04, z + 0.1], [0.007, low - 0.26, z + 0.32], [0.007, low - 0.27, z + 0.42], [0.007, low - 0.04, z + 0.48]])
        skeg = skeg if np.cross(skeg[1] - skeg[0], skeg[2] - skeg[0])[0] > 0 else skeg[::-1]
        parts.append(panel(skeg, 0.014, P["engine"].tinted(.09, .095, .1)))
        if not d.far:
            parts.append(box((0, y + 0.22, z - 0.02), (0.34, 0.44, 0.12), P["black"], bevel=0.02))
            parts.append(box((0, y + 0.36, z - 0.10), (0.30, 0.08, 0.20), P["black"], bevel=0.02))
            for s in (-1, 1):
                stripe = np.array([[s * 0.233, y + 0.78, z + 0.02], [s * 0.233, y + 0.78, z + 0.56], [s * 0.233, y + 0.84, z + 0.58], [s * 0.233, y + 0.84, z + 0.0]])
                stripe = stripe if np.cross(stripe[1] - stripe[0], stripe[2] - stripe[0])[0] * s > 0 else stripe[::-1]
                parts.append(panel(stripe, 0.006, P["silver"]))
                parts.append(panel(stripe + [0, -0.09, 0], 0.006, P["tube"]))
        return join(parts)


def build():
    boat = Boat()
    model = Model("rib", "hull", [sheet], (18, 70, 3000), 0.045)
    model.part("hull", boat.hull)
    pivot = (0, boat.floor + 0.1, boat.ENGINE_Z)
    model.part("engine", boat.engine, pivot, axis=(0, 1, 0))
    screw = np.array([0, -0.42, boat.ENGINE_Z + 0.66])
    model.part("propeller", lambda d: None if d.far else gear.propeller(d, screw, 0.19, 3, P["steel"], 1.1), screw, parent="engine", axis=(0, 0, 1))
    wheel, lever = boat.wheel_at + [0, 0, 0.10], boat.throttle_at + [0, 0, 0.16]
    model.part("helm", lambda d: join([gear.steering_wheel(d, wheel, 0.19, -30, P["black"], P["steel"], 3, 0.015), tube(np.array([wheel + [0, 0, 0], wheel + [0, -0.07, -0.12]]), 0.022, P["black"], 8)]) if d.full else None, wheel, axis=(0, 0.5, 0.866))
    model.part("throttle", lambda d: gear.lever(d, lever, 0.16, P["steel"], P["black"]) if d.full else None, lever, axis=(1, 0, 0))
    model.body("collision", boat.collision)
    f = boat.floor
    line = boat.tube_line(200)[::-1]
    rows = []
    for z in np.linspace(-3.1, 3.12, 9):
        middle, high = (float(np.interp(z, line[:, 2], line[:, axis])) for axis in (0, 1))
        half, top = middle - R * 0.8, high + 0.15
        low = f + float(np.interp(z, [-2.75, -1.6], [0.34, 0.0]))
        rows.append([(0, low - 0.02, z), (half, low, z), (half + 0.02, top, z), (middle - 0.06, high + 0.235, z)])
    model.body("inside_cockpit", closed_from(np.array(rows)))
    model.body("inside_bilge", closed_from(boat.loft.points(np.linspace(0.12, 0.98, 8), [0.0, 0.25, 0.5, 0.72]) * [0.97, 1, 1]))
    model.floats(MASS, 0.28, physics.hull_inertia(MASS, 7.3, 2.6), 7.3, 2.6)
    r = lambda v: [round(float(x), 3) for x in v]
    top = f + 1.7
    where = r(screw)  # an outboard's leg steers too, like a small rudder
    model.extras.update({
        "seats": [{"at_m": r([-0.32, f + 0.73, 1.12]), "yaw_deg": 0, "role": "helm"}, {"at_m": r([0.32, f + 0.73, 1.12]), "yaw_deg": 0, "role": "passenger"},
                  {"at_m": r([-0.32, f + 0.73, 2.05]), "yaw_deg": 0, "role": "passenger"}, {"at_m": r([0.32, f + 0.73, 2.05]), "yaw_deg": 0, "role": "passenger"}],
        "grips": [{"name": "helm", "at_m": r(wheel), "axis": [0, 0.5, 0.866], "range_deg": [-540, 540], "node": "helm", "radius_m": 0.19},
                  {"name": "throttle", "at_m": r(lever + [0, 0.16, 0]), "axis": [1, 0, 0], "range_deg": [-45, 60], "node": "throttle"}],
        "engine": {"at_m": where, "propeller_m": 0.38, "turns_per_s": 55.0, "power_w": 189000, "range_deg": [-35, 35], "node": "engine"},
        "rudder": {"at_m": where, "area_m2": 0.12, "aspect": 2.0, "range_deg": [-35, 35]},
        "lights": [{"at_m": r([0.74, top, 2.8]), "colour": "green", "sector_deg": [0, 112.5], "range_m": 1900}, {"at_m": r([-0.74, top, 2.8]), "colour": "red", "sector_deg": [-112.5, 0], "range_m": 1900},
                   {"at_m": r([0.35, top + 0.1, 2.85]), "colour": "white", "sector_deg": [0, 360], "range_m": 3700}]})
    return model
