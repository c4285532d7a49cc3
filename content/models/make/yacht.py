"""A sailing yacht of 10 m, 4.5 t: fin keel with bulb, spade rudder, masthead sloop with 54 m2 of sail."""
import numpy as np

import boatparts as gear
import physics
import surfaces as on
from hull import Loft, closed_from
from mesh import join, linear
from model import Model
from shapes import Paint, bar, bare_grid, box, circle, coil, fan, grid, lathe, panel, rect, spline, sweep, tube, upward
from textures import Sheet
from yacht_rig import Rig

STATIONS = [
    [(.01, .55, -4.55), (.01, .75, -4.68), (.01, 1.0, -4.8), (.01, 1.3, -4.92), (.01, 1.62, -5.02)],
    [(.02, .2, -3.2), (.28, .24, -3.2), (.62, .55, -3.22), (.80, 1.05, -3.25), (.92, 1.52, -3.3)],
    [(.02, .02, -1.2), (.85, 0, -1.2), (1.35, .35, -1.2), (1.48, .95, -1.2), (1.55, 1.42, -1.2)],
    [(.02, 0, 1), (1.1, -.04, 1), (1.66, .3, 1), (1.7, .85, 1), (1.735, 1.38, 1)],
    [(.02, .2, 3.2), (1.0, .2, 3.2), (1.55, .42, 3.2), (1.6, .9, 3.2), (1.62, 1.36, 3.2)],
    [(.02, .5, 4.95), (.75, .52, 4.93), (1.3, .66, 4.9), (1.4, 1.0, 4.82), (1.42, 1.38, 4.75)]]
MASS, DRAUGHT = 4500.0, 1.95

sheet = Sheet("sheet", 256, 1024, [("gelcoat", 96, on.gelcoat), ("nonskid", 64, on.nonskid), ("teak", 96, on.teak, 512), ("antifouling", 64, on.antifouling),
                                   ("steel", 32, on.steel), ("canvas", 96, on.canvas, 128), ("rope", 16, on.rope), ("moulding", 48, on.moulding)], 81)
WHITE, NAVY = (0.94, 0.94, 0.92), (0.05, 0.09, 0.20)
P = {"hull": Paint(sheet["gelcoat"], WHITE), "deck": Paint(sheet["nonskid"], (0.93, 0.92, 0.88)), "teak": Paint(sheet["teak"], (0.95, 0.90, 0.82)),
     "bottom": Paint(sheet["antifouling"], (0.10, 0.16, 0.30)), "steel": Paint(sheet["steel"], (0.95, 0.95, 0.95)), "alu": Paint(sheet["steel"], (0.80, 0.81, 0.83)),
     "sail": Paint(sheet["canvas"], (0.95, 0.94, 0.90), whole=True), "hood": Paint(sheet["canvas"], (0.08, 0.13, 0.27)), "rope": Paint(sheet["rope"], (0.92, 0.92, 0.9), whole=True),
     "red_rope": Paint(sheet["rope"], (0.75, 0.16, 0.12), whole=True), "blue_rope": Paint(sheet["rope"], (0.15, 0.3, 0.62), whole=True),
     "black": Paint(sheet["moulding"], (0.07, 0.07, 0.08)), "glass": Paint(sheet["moulding"], (0.03, 0.035, 0.045)), "cushion": Paint(sheet["moulding"], (0.12, 0.17, 0.30)),
     "orange": Paint(sheet["moulding"], (0.95, 0.45, 0.05)), "wood": Paint(sheet["teak"], (0.75, 0.5, 0.33)), "lens": Paint(sheet["moulding"], (1, 1, 1))}
WELL0, WELL1 = 1.35, 4.35  # the cockpit, from its bulkhead aft
ROOF0 = -2.15


class Boat:
    def __init__(self):
        self.loft = Loft(STATIONS)
        girths = np.array([0, .12, .28, .45, .65, 1.0])

        def coarse():
            hull = closed_from(self.loft.points(np.linspace(0, 1, 11), girths))
            fin = self.fin_sections(3, 6, DRAUGHT)
            return join([hull, self.closed_column(fin)])

        for _ in range(8):  # the keel's tip stays at the draught, so the column changes as the hull sinks
            self.loft.shift += physics.sink(coarse(), MASS)
        self.collision = coarse()
        t = np.linspace(0, 1, 80)
        self.edge = self.loft.points(t, [1.0])[:, 0]
        self.floor, self.seat, self.top = self.side_y(3.0) - 0.60, self.side_y(3.0) - 0.20, self.side_y(3.0) + 0.16
        self.wheel_at = np.array([0, self.floor + 0.92, 3.30])
        self.throttle_at = np.array([0.17, self.floor + 0.70, 3.14])

    def side_y(self, z):
        return float(np.interp(z, self.edge[:, 2], self.edge[:, 1]))

    def side_x(self, z):
        return float(np.interp(z, self.edge[:, 2], self.edge[:, 0]))

    def deck_y(self, z, x=0.0):
        return self.side_y(z) + 0.06 * (1 - min(1.0, (x / max(self.side_x(z), 0.01)) ** 2))

    def profile_y(self, z):
        p = self.loft.points(np.linspace(0, 1, 101), [0])[:, 0]
        return float(np.interp(z, p[:, 2], p[:, 1]))

    def fin_sections(self, rows, n, depth):
        """Sections (rows, n, 3) of the keel's fin from the hull down: a foil, thickest at 35 % of its chord."""
        a = np.arange(n) * 2 * np.pi / n
        k = (1 - np.cos(a)) / 2
        foil = np.stack([np.sin(a) * (1 - k) ** 0.5 * 1.0, k], -1)
        foil[:, 0] /= np.abs(foil[:, 0]).max()
        out = []
        for v in np.linspace(0, 1, rows):
            y = (1 - v) * (self.profile_y(0.5) + 0.01) - v * depth
            chord, lead = 1.45 - 0.35 * v, -0.30 + 0.28 * v
            out.append(np.stack([foil[:, 0] * (0.085 - 0.02 * v), np.full(n, y), lead + foil[:, 1] * chord], -1))
        return np.array(out)

    @staticmethod
    def closed_column(sections):
        p = np.concatenate([np.broadcast_to(sections[0].mean(0), sections[:1].shape), sections, np.broadcast_to(sections[-1].mean(0), sections[:1].shape)])
        p = np.round(p * 2 ** 15) / 2 ** 15
        m = bare_grid(np.concatenate([p, p[:, :1]], axis=1))
        return m if np.einsum("ij,ij->", m.p[:, 0], np.cross(m.p[:, 1], m.p[:, 2])) > 0 else m.flipped()

    def shell(self, d):
        t = np.linspace(0, 1, d.n(36))
        s = np.concatenate([np.linspace(0, 0.86, d.n(14, 5)), [0.885, 0.93, 1.0] if not d.far else [1.0]])
        skin = self.loft.shell(t, s, P["hull"])
        c = skin.centres()
        if not d.far:  # a cove stripe under the sheer
            stripe = self.loft.points(t, [0.885, 0.93])
            low, high = np.interp(c[:, 2], stripe[:, 0, 2], stripe[:, 0, 1]), np.interp(c[:, 2], stripe[:, 1, 2], stripe[:, 1, 1])
            skin.c[(c[:, 1] > low) & (c[:, 1] < high) & (c[:, 2] > -4.6)] = linear(NAVY)
        edge = self.loft.points([1.0], np.linspace(0, 1, d.n(20)))[0]
        crown = [(edge[-1][0] * k, edge[-1][1] + 0.06 * (1 - k * k), edge[-1][2]) for k in (.8, .6, .4, .2, 0, -.2, -.4, -.6, -.8)]
        outline = np.concatenate([edge, crown, (edge * [-1, 1, 1])[::-1]])
        stern = fan(outline, P["hull"], centre=outline.mean(0), flip=np.cross(outline[1] - outline[0], outline[-2] - outline[0])[2] < 0)
        skin = join([skin.both_sides(), stern])
        return [gear.painted_bottom(skin, [P["hull"]], P["bottom"], NAVY, 0.05, 0.13)]

    def keel(self, d):
        fin = self.fin_sections(d.n(6, 2), d.sides(18), DRAUGHT - 0.18)
        fin = np.concatenate([fin, fin[:, :1]], axis=1)
        m = grid(fin, P["bottom"], flip=False)
        outward = m if np.mean(np.cross(m.p[:, 1] - m.p[:, 0], m.p[:, 2] - m.p[:, 0])[:, 0] * m.centres()[:, 0]) > 0 else m.flipped()
        k = np.linspace(0, 1, d.n(14, 4))
        r = np.sqrt(np.maximum(1 - (2 * (k ** 0.8) - 1) ** 2, 0.0)) * 0.17 + 0.002
        bulb = sweep(np.stack([0 * k, 0 * k - DRAUGHT + 0.17, -0.35 + 1.75 * k], -1), circle(1, d.sides(16)), P["bottom"], scale=np.stack([r, r * 0.9], -1))
        return [outward, bulb]

    def roof(self, z):
        """Half width and height of the coachroof."""
        k = np.clip((z - ROOF0) / (WELL0 - ROOF0), 0, 1)
        return 0.62 + 0.50 * k ** 0.7, 0.40 * np.clip((z - ROOF0) / 0.75, 0, 1) ** 0.7 * (1 - 0.0 * k)

    def roof_section(self, z):
        w, h = self.roof(z)
        y = self.deck_y(z, w) - 0.01
        return np.array([(w, y, z), (w - 0.05 * h / 0.4, y + h * 0.72, z), (w - 0.10, y + h * 0.93, z), (w - 0.24, y + h * 1.02, z), (w * 0.45, y + h * 1.02 + 0.045, z), (0, y + h * 1.02 + 0.06, z)])

    def roof_top(self, z, x=0.0):
        s = self.roof_section(z)
        return float(np.interp(abs(x), s[::-1, 0], s[::-1, 1]))

    def deck(self, d):
        zs = np.unique(np.concatenate([np.linspace(-4.95, 4.75, d.n(26)), [ROOF0, ROOF0 + 0.001, WELL0, WELL1, WELL1 + 0.001]]))
        edge = np.array([[max(self.side_x(z) - 0.01, 0.005), self.side_y(z), z] for z in zs])
        inner = np.array([self.roof(z)[0] - 0.04 if ROOF0 < z < WELL0 else (1.10 if WELL0 <= z <= WELL1 else 0.0) for z in zs])
        inner = np.minimum(inner, edge[:, 0])
        parts = [gear.deck(edge, P["deck"], 0.24 if not d.far else 2.0, 0.06, inner=inner)]
        rows = np.array([self.roof_section(z) for z in np.linspace(ROOF0, WELL0 + 0.02, d.n(22))])
        top = grid(rows, P["hull"], flip=True)
        parts.append(top.both_sides())
        if d.far:
            return parts
        tread = rows[3:-2, 3:] + [0, 0.004, 0]  # non-skid on top
        parts.append(grid(tread, P["deck"], flip=True).both_sides())
        # Side windows: two smoked panes a side.
        for z0, z1 in ((-1.15, -0.15), (0.0, 1.05)):
            zs = np.linspace(z0, z1, d.n(8))
            pane = []
            for z in zs:
                s = self.roof_section(z)
                slack = 0.10 * (1 - np.clip((z - z0) / 0.25, 0, 1)) if z0 < -1 else 0.0
                a, b = s[0] + (s[1] - s[0]) * (0.30 + slack), s[0] + (s[1] - s[0]) * 0.86
                pane.append([a + [0.006, 0, 0], b + [0.006, 0, 0]])
            parts.append(grid(np.array(pane), P["glass"], flip=True).both_sides())
            if d.full:
                loop = np.concatenate([np.array(pane)[:, 0], np.array(pane)[::-1, 1], np.array(pane)[:1, 0]])
                parts.append(sweep(loop, rect(0.012, 0.03, 0.004), P["black"], up=(0.2, 1, 0)).both_sides())
        for z, w in ((-1.55, 0.48), (-3.1, 0.52), (-0.25, 0.40)):
            y = self.roof_top(z) if z > ROOF0 else self.deck_y(z)
            parts.append(box((0, y + 0.015, z), (w + 0.06, 0.05, w + 0.06), P["alu"], bevel=0.012))
            parts.append(box((0, y + 0.042, z), (w, 0.012, w), P["glass"], bevel=0.004))
        return parts

    def cockpit(self, d):
        f, s, t = self.floor, self.seat, self.top
        if d.far:
            return [box((0, s - 0.1, (WELL0 + WELL1) / 2), (2.1, 0.2, WELL1 - WELL0), P["teak"])]
        z = np.array([WELL0, 2.2, 3.2, WELL1])
        line = lambda pts, paint: grid(np.stack([np.stack([np.full(len(z), x), np.full(len(z), y), z], -1) for x, y in pts], 1), paint, flip=True)
        lanes = [line([(1.22, self.side_y(3) + 0.02), (1.19, t - 0.02), (1.17, t), (1.09, t), (1.06, t - 0.02), (1.00, s)], P["hull"]), line([(0.98, s - 0.001), (0.46, s - 0.001)], P["hull"]),
                 line([(0.46, s), (0.43, s - 0.03), (0.40, f)], P["hull"]), line([(0.40, f), (0.0, f)], P["hull"])]
        for k in range(3):  # teak in lanes of the strip's own width
            lanes.append(line([(0.96 - 0.165 * k, s + 0.006), (0.80 - 0.165 * k, s + 0.006)], P["teak"]))
        for k in range(2):
            lanes.append(line([(0.375 - 0.187 * k, f + 0.006), (0.19 - 0.187 * k, f + 0.006)], P["teak"]))
        parts = [join(lanes).both_sides()]
        # Bulkhead with the companionway, aft wall with a step to the transom.
        w, h = self.roof(WELL0)
        sec = self.roof_section(WELL0)
        half = np.concatenate([[(0.40, f, 0), (0.46, s, 0), (1.00, s, 0), (1.08, t, 0), (1.2, t - 0.02, 0)], sec - [0, 0, WELL0]])
        outline = np.concatenate([half, (half[:-1] * [-1, 1, 1])[::-1]]) + [0, 0, WELL0]
        parts.append(panel(outline, 0.04, P["hull"]))
        door = np.array([(-0.28, s + 0.10, 0), (0.28, s + 0.10, 0), (0.33, self.roof_top(WELL0) - 0.05, 0), (-0.33, self.roof_top(WELL0) - 0.05, 0)]) + [0, 0, WELL0 + 0.02]
        parts.append(panel(door, 0.03, P["wood"]))
        if d.full:
            for a, b in ((0, 3), (1, 2)):
                parts.append(bar(door[a], door[b], 0.05, 0.03, P["wood"].tinted(.55, .36, .22), up=(0, 0, 1)))
        aft = np.array([(-1.2, t - 0.12, 0), (-1.0, s, 0), (-0.46, s, 0), (-0.40, f, 0), (0.40, f, 0), (0.46, s, 0), (1.0, s, 0), (1.2, t - 0.12, 0)])[::-1] + [0, 0, WELL1]
        parts.append(panel(aft, 0.03, P["hull"]))
        end = np.array([(1.00, s, 0), (1.22, self.side_y(3) + 0.02, 0), (1.19, t - 0.02, 0), (1.17, t, 0), (1.09, t, 0), (1.06, t - 0.02, 0)]) + [0, 0, WELL1]
        parts.append(panel(end, 0.02, P["hull"]).both_sides())
        parts.append(box((0, s + 0.09, WELL1 + 0.02), (2.1, 0.22, 0.10), P["hull"], bevel=0.02))
        parts.append(panel(upward(np.array([(-0.46, s + 0.03, 3.85), (0.46, s + 0.03, 3.85), (0.46, s + 0.03, WELL1), (-0.46, s + 0.03, WELL1)])), 0.04, P["teak"], bevel=0.01))  # helm's bench
        # Pedestal with compass and a grab rail.
        parts.append(lathe(np.array([(0.14, 0), (0.11, 0.08), (0.10, 0.75), (0.13, 0.90), (0.13, 0.98), (0.11, 1.0)]), d.sides(18), P["hull"]).move(0, f, 3.15))
        parts.append(lathe(np.array([(0.11, 0), (0.10, 0.05), (0.06, 0.085), (0, 0.095)]), d.sides(16), P["glass"]).move(0, f + 1.0, 3.15))
        rail = spline([(0.24, f, 3.0), (0.24, f + 0.8, 3.0), (0.2, f + 1.12, 3.0), (0, f + 1.16, 3.0)], d.n(12))
        parts.append(tube(np.concatenate([rail, (rail * [-1, 1, 1])[::-1][1:]]), 0.014, P["steel"], d.sides(8)))
        if d.full:
            parts.append(box((0, f + 0.50, 2.62), (0.09, 0.5, 0.62), P["wood"], bevel=0.01))
            parts.append(box((0, f + 0.76, 2.62), (0.16, 0.03, 0.7), P["wood"], bevel=0.008))
        for z, x in ((2.75, 1.13), (2.0, 1.13)) if d.full else ():
            parts.append(gear.winch(d, (x, t, z), P["black"], P["steel"], 0.07 if z > 2.5 else 0.055).both_sides())
        return parts

    def rails(self, d):
        """Toe rail, stanchions and lifelines, pulpit and pushpit."""
        n = d.n(30)
        zs = np.linspace(-4.98, 4.74, n)
        path = np.array([[max(self.side_x(z) - 0.012, 0.0), self.side_y(z) + 0.015, z] for z in zs])
        parts = [sweep(path, rect(0.022, 0.05), P["alu"]).both_sides()]
        parts.append(sweep(np.array([[self.side_x(z) + 0.006, self.side_y(z) - 0.045, z] for z in zs]), rect(0.025, 0.04), P["black"].tinted(.13, .13, .14)).both_sides())
        k = np.linspace(-1, 1, 9)
        aft = np.stack([k * self.side_x(4.75), self.side_y(4.75) + 0.06 * (1 - k * k) + 0.008, np.full(9, 4.745)], -1)
        parts.append(sweep(aft, rect(0.022, 0.03), P["alu"]))
        if d.far:
            return parts
        posts = [-3.2, -1.8, -0.3, 1.2, 2.6]
        at = lambda z: np.array([self.side_x(z) - 0.05, self.side_y(z), z])
        s = d.sides(6)
        for z in posts:
            parts.append(tube(np.array([at(z), at(z) + [0, 0.62, 0]]), 0.0125, P["steel"], s).both_sides())
            if d.full:
                parts.append(lathe(np.array([(0.03, 0), (0.016, 0.05)]), 6, P["steel"]).move(*at(z)).both_sides())
        for h in (0.60, 0.32):
            line = [at(-4.1) + [0, h, 0]] + [at(z) + [0, h, 0] for z in posts] + [at(3.9) + [0, h, 0]]
            parts.append(tube(np.array(line), 0.004, P["steel"], 4 if d.full else 3, caps=False).both_sides())
        tip = np.array([0.0, self.side_y(-4.98), -4.98])
        up = spline([at(-4.0), at(-4.05) + [0, 0.62, 0], tip + [0.28, 0.70, 0.05], tip + [0.10, 0.70, -0.14]], d.n(10))
        parts.append(tube(up, 0.0125, P["steel"], s).both_sides())
        parts.append(tube(np.array([at(-4.55), tip + [0.27, 0.69, 0.10]]), 0.0125, P["steel"], s).both_sides())
        back = spline([at(3.85), at(3.9) + [0, 0.62, 0], at(4.55) + [-0.05, 0.64, 0.1], at(4.65) + [-0.6, 0.64, 0.06]], d.n(10))
        parts.append(tube(back, 0.0125, P["steel"], s).both_sides())
        parts.append(tube(np.array([at(4.6) + [-0.06, 0, 0], at(4.6) + [-0.06, 0.63, 0]]), 0.0125, P["steel"], s).both_sides())
        parts.append(tube(np.array([[0.78, self.side_y(4.6), 4.62], [0.80, self.side_y(4.6) + 0.63, 4.68]]), 0.0125, P["steel"], s).both_sides())
        return parts

    def deck_gear(self, d):
        if d.far:
            return []
        parts = []
        for z in (-4.2, 0.45, 4.5):
            parts.append(gear.horn_cleat(d, (self.side_x(z) - 0.10, self.side_y(z) + 0.005, z), P["steel"], 0.22).both_sides())
        # Sprayhood over the companionway, on its hoop.
        hood = []
        for z, h, w in ((0.55, 0.06, 0.86), (0.72, 0.42, 0.92), (1.05, 0.60, 0.98), (1.62, 0.62, 1.0)):
            y = self.roof_top(min(z, WELL0), 0.7) - 0.02
            a = np.linspace(0, np.pi, d.n(15, 7))
            hood.append(np.stack([w * np.sign(np.cos(a)) * np.abs(np.cos(a)) ** 0.45, y + h * np.sin(a) ** 0.55, np.full(len(a), z)], -1))
        hood = np.array(hood)
        parts.append(grid(hood, P["hood"], flip=True))
        parts.append(grid(hood - [0, 0.012, 0], P["hood"].tinted(.06, .09, .2)))
        if d.full:
            win = hood[1:3, 3:-3] * [1, 1, 1]
            low = win[0] * 0.78 + win[1] * 0.22 + [0, 0.008, -0.008]
            high = win[0] * 0.15 + win[1] * 0.85 + [0, 0.010, -0.006]
            parts.append(grid(np.stack([low, high]), P["glass"].tinted(.22, .25, .27), flip=True))
            parts.append(tube(hood[3] + [0, -0.01, 0], 0.012, P["steel"], 6))
        for x in (0.52,):  # grab rails, genoa tracks, sheets led aft
            rail = []
            for z in np.linspace(-1.1, 0.4, d.n(13, 7)):
                rail.append([x, self.roof_top(z, x) + 0.05 * (1 - (np.cos((z + 1.1) / 1.5 * 6 * np.pi) * .5 + .5) ** 3), z])
            parts.append(sweep(np.array(rail), rect(0.028, 0.022, 0.006), P["wood"]).both_sides())
        track = np.array([[self.side_x(z) - 0.42, self.deck_y(z, self.side_x(z) - .42) + 0.012, z] for z in np.linspace(-0.4, 1.25, 6)])
        parts.append(sweep(track, rect(0.03, 0.022), P["alu"]).both_sides())
        if d.full:
            parts.append(box((self.side_x(0.3) - 0.42, track[2][1] + 0.05, 0.3), (0.05, 0.08, 0.13), P["black"], bevel=0.012).both_sides())
            parts += [gear.winch(d, (x, self.roof_top(0.5, x), 0.45), P["black"], P["steel"], 0.05) for x in (-0.58, 0.58)]
            for k, (x, paint) in enumerate(((0.30, "red_rope"), (0.36, "blue_rope"), (0.42, "rope"), (-0.30, "rope"), (-0.36, "red_rope"))):
                parts.append(tube(np.array([[x * 0.3, self.roof_top(-0.7) + 0.03, -0.70], [x, self.roof_top(-0.3, x) + 0.022, -0.3], [x, self.roof_top(0.42, x) + 0.03, 0.42]]), 0.006, P[paint], 4))
                parts.append(box((x, self.roof_top(0.2, x) + 0.03, 0.2), (0.035, 0.06, 0.13), P["black"]))
            parts.append(gear.round_bow_anchor(d, (0.0, self.side_y(-4.95) + 0.06, -4.95), P["alu"]))
            parts.append(box((0, self.deck_y(-4.1) + 0.01, -4.1), (0.42, 0.02, 0.6), P["hull"], bevel=0.006))
            parts.append(coil((-0.7, self.seat + 0.006, 3.0), 0.13, 0.008, 5, P["blue_rope"], 9, 4))
            # A horseshoe buoy on the pushpit.
            a = np.radians(np.linspace(-60, 240, 15))
            shoe = np.stack([0.22 * np.cos(a), 0.24 * np.sin(a), 0 * a], -1)
            parts.append(sweep(shoe, rect(0.10, 0.09, 0.03), P["orange"], up=(0, 0, 1)).move(-1.05, self.side_y(4.6) + 0.38, 4.80))
            parts.append(gear.lamp(d, (-0.20, self.side_y(-4.98) + 0.62, -4.9), (.8, .06, .05), P["black"], P["lens"], .035))
            parts.append(gear.lamp(d, (0.20, self.side_y(-4.98) + 0.62, -4.9), (.05, .7, .3), P["black"], P["lens"], .035))
            parts.append(gear.lamp(d, (0.5, self.side_y(4.6) + 0.66, 4.7), (1, 1, .95), P["black"], P["lens"], .035))
        return parts

    def hull(self, d):
        return join(self.shell(d) + self.keel(d) + self.deck(d) + self.cockpit(d) + self.rails(d) + self.deck_gear(d) + self.rig.standing(d))

    def rudder(self, d):
        k = np.linspace(0, 1, d.n(5, 2))
        a = np.arange(d.sides(14)) * 2 * np.pi / d.sides(14)
        foil = np.stack([0.045 * np.sin(a), 0.5 * np.cos(a)], -1)
        top, low = self.profile_y(4.15) - 0.02, -1.45
        path = np.stack([0 * k, top + (low - top) * k, 4.22 + 0.04 * k], -1)
        return sweep(path, foil, P["bottom"], up=(0, 0, 1), scale=np.stack([1 - 0.4 * k, 0.60 - 0.2 * k], -1))


def build():
    boat = Boat()
    boat.rig = Rig(boat, P)
    rig = boat.rig
    model = Model("yacht", "hull", [sheet], (25, 100, 6000), 0.06)
    model.material("sail", "sheet", double_sided=True)
    model.part("hull", boat.hull)
    model.part("rudder", boat.rudder, (0, 0, 4.15), axis=(0, 1, 0))
    screw = np.array([0, boat.profile_y(2.4) - 0.34, 2.72])
    leg = lambda d: join([tube(np.array([[0, boat.profile_y(2.4) + 0.02, 2.4], [0, screw[1] + 0.06, 2.46]]), 0.05, P["bottom"], d.sides(10)), lathe(np.array([(0, -.2), (.05, -.16), (.06, .1), (.05, .18)]), d.sides(12), P["bottom"]).turn("x", 90).move(0, screw[1], 2.54),
                              gear.propeller(d, screw, 0.21, 2, P["steel"].tinted(.8, .65, .35))])
    model.part("propeller", lambda d: None if d.far else leg(d), screw, axis=(0, 0, 1))
    wheel, lever = boat.wheel_at, boat.throttle_at
    model.part("helm", lambda d: None if d.far else gear.steering_wheel(d, wheel, 0.45, -8, P["black"], P["steel"], 5, 0.015), wheel, axis=(0, 0.139, 0.99))
    model.part("throttle", lambda d: gear.lever(d, lever, 0.18, P["steel"], P["black"]) if d.full else None, lever, axis=(1, 0, 0))
    model.part("boom", lambda d: rig.boom(d), rig.gooseneck, axis=(0, 1, 0))
    model.part("mainsail", lambda d: {"sail": rig.mainsail(d)}, rig.gooseneck, parent="boom", extras={"camber": "to starboard; scale x by -1 on the other tack"})
    model.part("jib", lambda d: {"sail": rig.jib(d)}, rig.tack, axis=tuple(round(float(x), 4) for x in rig.stay), extras={"camber": "to starboard; scale x by -1 on the other tack"})
    model.body("collision", boat.collision)
    f, s, t = boat.floor, boat.seat, boat.top
    p = np.zeros((2, 5, 3))
    for k, z in enumerate((WELL0, WELL1)):
        p[k] = [(0, f - 0.02, z), (0.40, f, z), (0.46, s, z), (1.0, s + 0.02, z), (1.09, t, z)]
    model.body("inside_cockpit", closed_from(p))
    model.body("inside_cabin", closed_from(boat.loft.offset(np.linspace(0.08, boat.loft.t_at(WELL0), 9), np.array([0, .15, .35, .6, 1.0]), np.full((1, 1), -0.04))))
    model.floats(MASS, -0.05, physics.hull_inertia(MASS, 10.0, 3.47), 10.0, 3.47)
    r = lambda v: [round(float(x), 3) for x in v]
    mast = rig.head_y
    model.extras.update({
        "sails": [{"name": "main", "node": "boom", "area_m2": round(rig.main_area, 1), "centre_m": r(rig.main_centre)}, {"name": "jib", "node": "jib", "area_m2": round(rig.jib_area, 1), "centre_m": r(rig.jib_centre)}],
        "engine": {"at_m": r(screw), "propeller_m": 0.42, "turns_per_s": 22.0, "power_w": 21600},
        "rudder": {"at_m": [0.0, -0.85, 4.22], "area_m2": 0.55, "aspect": 2.2, "range_deg": [-35, 35]},
        "seats": [{"at_m": r([0, s + 0.05, 4.05]), "yaw_deg": 0, "role": "helm"}, {"at_m": r([0.75, s, 2.4]), "yaw_deg": 90, "role": "crew"}, {"at_m": r([-0.75, s, 2.4]), "yaw_deg": -90, "role": "crew"}],
        "grips": [{"name": "helm", "at_m": r(wheel), "axis": [0, 0.139, 0.99], "range_deg": [-400, 400], "node": "helm", "radius_m": 0.45},
                  {"name": "throttle", "at_m": r(lever + [0, 0.18, 0]), "axis": [1, 0, 0], "range_deg": [-40, 40], "node": "throttle"},
                  {"name": "sheet", "at_m": r([0, f + 0.80, 2.55]), "axis": [0, 0, 1], "range_m": [0, 3.0], "node": "boom"}],
        "lights": [{"at_m": r([-0.2, boat.side_y(-4.98) + .66, -4.9]), "colour": "red", "sector_deg": [-112.5, 0], "range_m": 3700},
                   {"at_m": r([0.2, boat.side_y(-4.98) + .66, -4.9]), "colour": "green", "sector_deg": [0, 112.5], "range_m": 3700},
                   {"at_m": r([0.5, boat.side_y(4.6) + .7, 4.7]), "colour": "white", "sector_deg": [112.5, 247.5], "range_m": 3700},
                   {"at_m": r([0, mast * 0.62, -0.85]), "colour": "white", "sector_deg": [-112.5, 112.5], "range_m": 5500},
                   {"at_m": r([0, mast + 0.1, -0.75]), "colour": "white", "sector_deg": [0, 360], "range_m": 3700}]})
    return model
