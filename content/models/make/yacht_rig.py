"""Mast, rigging and sails of the yacht. Sails are cambered: 11 % of the chord deep at 45 % of it, with twist."""
import numpy as np

import boatparts as gear
from mesh import join
from shapes import bar, box, grid, lathe, panel, rect, ring, sweep, tube


def camber(u):
    """The arch of a sail along its chord, 1 at its deepest point, 45 % from the luff."""
    u = np.clip(u, 0, 1)
    return u ** 0.9 * (1 - u) ** 1.1 / (0.45 ** 0.9 * 0.55 ** 1.1)


class Rig:
    MAST_Z = -0.75

    def __init__(self, boat, paints):
        self.boat, self.p = boat, paints
        self.foot_y = boat.roof_top(self.MAST_Z)
        self.head_y = 14.0
        self.gooseneck = np.array([0.0, self.foot_y + 0.95, self.MAST_Z + 0.12])
        self.tack = np.array([0.0, boat.side_y(-4.9) + 0.28, -4.88])
        self.hounds = np.array([0.0, self.head_y - 0.25, self.MAST_Z - 0.10])
        self.stay = (self.hounds - self.tack) / np.linalg.norm(self.hounds - self.tack)
        self.measure()

    def surface(self, luff0, luff1, clew, head_chord, roach, depth, twist, nu, nv, hollow=0.0):
        """Points (nv, nu, 3) of a sail from foot to head: u from luff to leech."""
        v = np.linspace(0, 1, nv)
        u = np.linspace(0, 1, nu)
        luff = luff0 + (luff1 - luff0) * v[:, None]
        head = luff1 + head_chord
        leech = clew + (head - clew) * v[:, None]
        chord = leech - luff
        length = np.linalg.norm(chord, axis=1)
        chord = chord * (1 + (roach * np.sin(np.pi * v ** 0.85) / np.maximum(length, 0.05)))[:, None]
        a = np.radians(twist) * v
        chord = np.stack([chord[:, 0] * np.cos(a) + chord[:, 2] * np.sin(a), chord[:, 1], -chord[:, 0] * np.sin(a) + chord[:, 2] * np.cos(a)], -1)
        side = np.cross([0, 1.0, 0], chord)
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        deep = depth * (0.75 + 0.25 * np.sin(np.pi * np.clip(v * 1.05, 0, 1))) * np.linalg.norm(chord, axis=1) * np.clip(v * 9 + 0.15, 0, 1)
        return luff[:, None] + chord[:, None] * u[None, :, None] + side[:, None] * (deep[:, None] * camber(u)[None])[..., None]

    def panels(self, points, count):
        """The surface as horizontal cloths, each the canvas strip's full height; its edges doubled."""
        nv = len(points)
        rows = np.unique(np.round(np.linspace(0, nv - 1, count + 1)).astype(int))
        parts = []
        for a, b in zip(rows[:-1], rows[1:]):
            m = grid(np.swapaxes(points[a:b + 1], 0, 1), self.p["sail"])
            parts.append(m)
        out = join(parts)
        out.g[:] = 0
        return out

    def measure(self):
        area = lambda q: (np.linalg.norm(np.cross(q[1:, :-1] - q[:-1, :-1], q[:-1, 1:] - q[:-1, :-1]), axis=2) + np.linalg.norm(np.cross(q[1:, 1:] - q[:-1, 1:], q[1:, 1:] - q[1:, :-1]), axis=2)) / 2
        for name, q in (("main", self.main_points(17, 25)), ("jib", self.jib_points(17, 25))):
            a = area(q)
            centre = (q[1:, 1:] + q[1:, :-1] + q[:-1, 1:] + q[:-1, :-1]) / 4
            setattr(self, f"{name}_area", float(a.sum()))
            c = (centre * a[..., None]).sum((0, 1)) / a.sum()
            setattr(self, f"{name}_centre", c * [0, 1, 1])

    def main_points(self, nu, nv):
        g = self.gooseneck
        return self.surface(g + [0, 0.16, 0.02], np.array([0, self.head_y - 0.15, self.MAST_Z + 0.11]), g + [0, 0.14, 4.05], np.array([0, 0, 0.16]), 0.36, 0.11, 9.0, nu, nv)

    def jib_points(self, nu, nv):
        low, high = self.tack + self.stay * 0.35, self.tack + self.stay * (np.linalg.norm(self.hounds - self.tack) - 0.5)
        return self.surface(low, high, np.array([0.62, self.foot_y + 0.42, 0.25]), np.array([0.0, -0.05, 0.06]), -0.12, 0.115, 7.0, nu, nv)

    def mainsail(self, d):
        nv = {0: 29, 1: 13, 2: 7}[d.level]
        q = self.main_points(d.n(15, 5), nv)
        sail = self.panels(q, 14 if d.full else (5 if not d.far else 2))
        parts = [sail]
        if d.full:
            for k, v in enumerate((6, 12, 17, 23)):  # batten pockets on both sides
                u0 = 0 if k > 1 else 6
                strip = np.stack([q[v, u0:], q[v, u0:] * 0.92 + q[v + 1, u0:] * 0.08], 1)
                for off in (0.006, -0.006):
                    parts.append(grid(strip + [off, 0, 0], self.p["sail"].tinted(.72, .72, .7), v=np.array([0, .06])))
            for v in range(1, 28, 2):
                parts.append(box(q[v, 0] + [0, 0, 0.0], (0.03, 0.05, 0.05), self.p["black"]))
            for v in (7, 13):  # reefing cringles
                for u in (0, -1):
                    parts.append(ring(q[v, u] + [0, 0, 0.06 if u == 0 else -0.06], (1, 0, 0), 0.03, 0.009, self.p["steel"], 10, 5))
            head = q[-1]
            parts.append(panel(np.array([head[0] + [.012, -.25, 0], head[0] + [.012, .02, 0], head[-1] + [.012, .02, 0], q[-2][-1] + [.012, 0, 0]])[::-1], 0.024, self.p["alu"]))
        return join(parts)

    def jib(self, d):
        nv = {0: 29, 1: 13, 2: 7}[d.level]
        q = self.jib_points(d.n(14, 5), nv)
        parts = [self.panels(q, 14 if d.full else (5 if not d.far else 2))]
        # The strip of sun cloth along leech and foot.
        if not d.far:
            for off in (0.006, -0.006):
                parts.append(grid(q[:, -3:] + [off, 0, 0], self.p["hood"]))
                parts.append(grid(np.swapaxes(q[:3], 0, 1) + [off, 0, 0], self.p["hood"]))
        if d.full:
            clew = q[0, -1]
            parts.append(ring(clew + [0, 0.06, -0.06], (1, 0, 0), 0.035, 0.01, self.p["steel"], 12, 5))
            deck = self.boat
            track = np.array([deck.side_x(0.3) - 0.42, deck.deck_y(0.3, 1.2) + 0.10, 0.36])
            winch = np.array([1.13 - 0.02, deck.top + 0.08, 2.72])
            parts.append(tube(np.array([clew + [0, 0.06, -0.04], track]), 0.006, self.p["blue_rope"], 4))
            parts.append(tube(np.array([track, [1.36, deck.top - 0.02, 1.6], winch + [0.06, 0, 0]]), 0.006, self.p["blue_rope"], 4))
            for v, u in ((8, 2), (14, 2), (20, 2)):
                parts.append(bar(q[v, u] + [0.012, 0, 0], q[v, u] + [0.02, -0.02, 0.22], 0.006, 0.003, self.p["red_rope"]))
        drum = lathe(np.array([(0.04, -0.08), (0.10, -0.07), (0.10, -0.06), (0.045, -0.05), (0.045, 0.03), (0.10, 0.04), (0.10, 0.05), (0.03, 0.07), (0.025, 0.3)]), d.sides(16), self.p["black"])
        tilt = np.degrees(np.arctan2(self.stay[2], self.stay[1]))
        parts.append(drum.turn("x", tilt).move(*(self.tack + self.stay * 0.1)))
        end = self.tack + self.stay * (np.linalg.norm(self.hounds - self.tack) - 0.1)
        parts.append(tube(np.array([self.tack + self.stay * 0.1, end]), 0.016, self.p["alu"], d.sides(8), caps=False))
        return join(parts)

    def boom(self, d):
        g = self.gooseneck
        parts = [sweep(np.array([g + [0, 0, 0.05], g + [0, 0, 4.15]]), rect(0.085, 0.14, 0.03, 2 if d.full else 1), self.p["alu"])]
        if d.far:
            return join(parts)
        parts += [box(g + [0, 0, 0.03], (0.05, 0.10, 0.10), self.p["black"], bevel=0.01), box(g + [0, 0, 4.17], (0.09, 0.145, 0.05), self.p["black"], bevel=0.01)]
        # Sail cover bag's stack: folds along the boom; mainsheet to its traveller; vang.
        if d.full:
            parts.append(tube(np.array([g + [0, 0.07, 4.02], g + [0, 0.16, 4.06]]), 0.008, self.p["rope"], 5))
            b = self.boat
            for k in (-0.03, 0.0, 0.03):
                parts.append(tube(np.array([g + [k, -0.1, 3.25], [k * 2.4, b.floor + 0.84, 2.55]]), 0.006, self.p["rope"], 5))
            parts.append(box(g + [0, -0.10, 3.25], (0.05, 0.09, 0.05), self.p["black"], bevel=0.01))
            parts.append(box((0, b.floor + 0.82, 2.55), (0.14, 0.07, 0.06), self.p["black"], bevel=0.01))
        parts.append(tube(np.array([g + [0, -0.08, 1.15], [0, self.foot_y + 0.14, self.MAST_Z + 0.14]]), 0.02, self.p["alu"], d.sides(8)))
        return join(parts)

    def standing(self, d):
        """Mast, spreaders, shrouds, stays, masthead."""
        b, z = self.boat, self.MAST_Z
        oval = np.stack([0.062 * np.cos(np.arange(12) * np.pi / 6), 0.095 * np.sin(np.arange(12) * np.pi / 6)], -1) if d.full else np.stack([0.062 * np.cos(np.arange(6) * np.pi / 3), 0.095 * np.sin(np.arange(6) * np.pi / 3)], -1)
        y = np.array([self.foot_y - 0.02, self.foot_y + 1, 9.5, self.head_y])
        mast = sweep(np.stack([0 * y, y, np.full(4, z)], -1), oval, self.p["alu"], up=(0, 0, 1), scale=np.array([1, 1, 1, 0.72]))
        parts = [mast]
        chain = np.array([b.side_x(z + 0.25) - 0.10, b.side_y(z + 0.25), z + 0.25])
        levels = (self.foot_y + (self.head_y - self.foot_y) * 0.36, self.foot_y + (self.head_y - self.foot_y) * 0.67)
        tips = [np.array([0.98, levels[0] + 0.05, z + 0.22]), np.array([0.76, levels[1] + 0.05, z + 0.20])]
        if d.far:
            parts.append(tube(np.array([chain, tips[0], tips[1], [0.04, self.head_y - .1, z]]), 0.012, self.p["steel"], 3, caps=False).both_sides())
            return parts
        wire = lambda pts, r=0.005: tube(np.array(pts), r, self.p["steel"], 4 if d.full else 3, caps=False)
        for tip in tips:
            parts.append(sweep(np.array([[0.04, tip[1] - 0.05, z + 0.02], tip]), np.stack([0.018 * np.cos(np.arange(8) * np.pi / 4), 0.05 * np.sin(np.arange(8) * np.pi / 4)], -1), self.p["alu"], up=(0, 0, 1), scale=np.array([1, 0.6])).both_sides())
        shrouds = [wire([chain, tips[0], tips[1], [0.03, self.head_y - 0.08, z]]), wire([tips[0], [0.03, levels[1] - 0.03, z]]), wire([chain + [-0.04, 0, 0.12], [0.04, levels[0] - 0.05, z]]), wire([chain + [-0.04, 0, -0.35], [0.04, levels[0] - 0.05, z]])]
        split = np.array([0, 4.2, 3.95])
        shrouds.append(wire([split, [b.side_x(4.7) - 0.25, b.side_y(4.7), 4.70]]))
        parts.append(join(shrouds).both_sides())
        parts.append(wire([split, [0, self.head_y, z + 0.12]]))
        if d.full:
            for at in (chain, chain + [-0.04, 0, 0.12], chain + [-0.04, 0, -0.35]):
                parts.append(tube(np.array([at, at + [-0.003, 0.26, 0]]), 0.011, self.p["steel"], 7).both_sides())
                parts.append(box(at + [0, 0.02, 0], (0.02, 0.06, 0.05), self.p["steel"]).both_sides())
            parts.append(wire([[0.05, self.foot_y + 0.05, z + 0.11], [0.05, self.head_y - 0.1, z + 0.07]], 0.004))
            parts.append(wire([[-0.05, self.foot_y + 0.05, z - 0.02], [-0.07, self.head_y - 0.1, z - 0.02]], 0.004))
            parts.append(box((0, self.head_y + 0.02, z), (0.07, 0.05, 0.28), self.p["alu"], bevel=0.01))
            parts.append(gear.lamp(d, (0, self.head_y + 0.04, z - 0.02), (1, 1, .95), self.p["black"], self.p["lens"], 0.04))
            parts.append(tube(np.array([[0.03, self.head_y, z + 0.1], [0.03, self.head_y + 0.9, z + 0.1]]), 0.004, self.p["black"], 5))
            parts.append(panel(np.array([[0, self.head_y + 0.30, z - 0.42], [0, self.head_y + 0.30, z - 0.12], [0, self.head_y + 0.33, z - 0.12]])[::-1], 0.004, self.p["black"]))
            parts.append(tube(np.array([[0, self.head_y + .05, z - .12], [0, self.head_y + .34, z - .14]]), 0.004, self.p["black"], 5))
            parts.append(gear.lamp(d, (0, self.head_y * 0.62, z - 0.11), (1, 1, .95), self.p["black"], self.p["lens"], 0.035))
            parts.append(gear.winch(d, (0.0, 0, 0), self.p["black"], self.p["steel"], 0.04).turn("z", -90).move(0.065, self.foot_y + 0.75, z + 0.03).both_sides())
            parts.append(lathe(np.array([(0.15, 0), (0.14, 0.02), (0.10, 0.03)]), 16, self.p["alu"]).move(0, self.foot_y - 0.01, z))
        return parts
