"""Hulls lofted from stations: a spline along the boat through the control points of Bezier sections."""
import numpy as np

from mesh import Mesh, join
from shapes import grid, lengths, spline_at


def bezier(points, s):
    """Bezier curve of points (..., k, 3) at s (n): (..., n, 3)."""
    p = [points[..., k, None, :] for k in range(points.shape[-2])]
    s = np.asarray(s)[:, None]
    while len(p) > 1:
        p = [a * (1 - s) + b * s for a, b in zip(p[:-1], p[1:])]
    return p[0]


class Loft:
    """The starboard side of a hull. t runs from bow (0) to stern (1), s from keel (0) to sheer (1)."""

    def __init__(self, stations, pieces=None, knots=None):
        """stations: (n, k, 3) control points, bow first. pieces: the control points of each Bezier of a section, in order."""
        self.control = np.asarray(stations, float)
        n, k, _ = self.control.shape
        self.pieces = pieces or [tuple(range(k))]
        self.knots = np.asarray(knots, float) if knots is not None else lengths(self.control.mean(1))
        self.knots = self.knots / self.knots[-1]
        self.shift = 0.0

    def points(self, t, s):
        """Points (nt, ns, 3); s at whole parts of 1 / pieces lies on the knuckles between them."""
        control = spline_at(self.knots, self.control, np.atleast_1d(t))
        s = np.atleast_1d(np.asarray(s, float)) * len(self.pieces)
        out = np.zeros((len(control), len(s), 3))
        which = np.clip(s.astype(int), 0, len(self.pieces) - 1)
        for k, piece in enumerate(self.pieces):
            use = which == k
            if use.any():
                out[:, use] = bezier(control[:, list(piece)], s[use] - k)
        out[..., 0] = np.maximum(out[..., 0], 0.0)
        out[..., 1] += self.shift
        return out

    def normals(self, t, s):
        """Outward normals (nt, ns, 3)."""
        t, s = np.atleast_1d(np.asarray(t, float)), np.atleast_1d(np.asarray(s, float))
        e = 1e-4
        dt = self.points(np.minimum(t + e, 1), s) - self.points(np.maximum(t - e, 0), s)
        ds = self.points(t, np.minimum(s + e, 1)) - self.points(t, np.maximum(s - e, 0))
        n = np.cross(ds, dt)
        length = np.linalg.norm(n, axis=2, keepdims=True)
        n = np.where(length > 1e-14, n / np.maximum(length, 1e-14), [1.0, 0, 0])
        return n

    def offset(self, t, s, distance):
        """Points moved outwards; never across the middle."""
        p = self.points(t, s) + self.normals(t, s) * np.asarray(distance)[..., None]
        p[..., 0] = np.maximum(p[..., 0], 0.0)
        return p

    def t_at(self, z, s=1.0):
        """t where the curve of s passes z."""
        t = np.linspace(0, 1, 401)
        return np.interp(z, self.points(t, [s])[:, 0, 2], t)

    def section(self, z, n=33, inset=0.0):
        """The section (n, 3) in the plane of z, from keel to sheer."""
        s = np.linspace(0, 1, n)
        t = np.linspace(0, 1, 201)
        grid_points = self.offset(t, s, np.full((1, 1), -inset)) if inset else self.points(t, s)
        out = np.zeros((n, 3))
        for j in range(n):
            zs = np.maximum.accumulate(grid_points[:, j, 2])
            out[j] = [np.interp(z, zs, grid_points[:, j, 0]), np.interp(z, zs, grid_points[:, j, 1]), z]
        return out

    def half_width(self, z, y, inset=0.0):
        """Half breadth inside the planking at a height."""
        sec = self.section(z, 41, inset)
        return float(np.interp(y, np.maximum.accumulate(sec[:, 1]), sec[:, 0]))

    def shell(self, t, s, paint, distance=0.0, inward=False, **options):
        """The starboard surface over a grid of t and s, its strip along the boat."""
        p = self.offset(t, s, np.full((1, 1), distance)) if distance else self.points(t, s)
        return grid(p, paint, flip=not inward, **options)

    def closed_hull(self, stations, girths, deck_s=1.0):
        """A coarse closed hull with a flat deck from sheer to sheer, for physics: both sides, transom and stem."""
        t, s = np.linspace(0, 1, stations), np.asarray(girths) * deck_s
        return closed_from(self.points(t, s))


def closed_from(p):
    """A closed mesh over starboard sections (nt, ns, 3) from keel to edge, mirrored, with lid, transom and, if open, stem."""
    right = p.copy()
    right[:, 0, 0] = 0.0
    left = right * np.array([-1.0, 1, 1])
    around = np.concatenate([right, left[:, :0:-1]], axis=1)  # keel, starboard to its edge, port edge down to the keel
    around = np.round(around * 2 ** 15) / 2 ** 15
    nt, m = around.shape[:2]
    tris = []
    for i in range(nt - 1):
        for j in range(m):
            a, b, c, d = around[i, j], around[i + 1, j], around[i + 1, (j + 1) % m], around[i, (j + 1) % m]
            # Each side cut as the other mirrored: else a hull under way would heel and turn by how it is cut.
            tris += [[a, c, b], [a, d, c]] if 2 * j < m else [[a, d, b], [b, d, c]]
    for ringed, turn in ((around[0], True), (around[-1], False)):
        half = (m + 1) // 2
        for j in range(half - 1):
            quad = [ringed[j], ringed[j + 1], ringed[(m - j - 1) % m], ringed[(m - j) % m]]
            for tri in ([quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]):
                tris.append(tri[::-1] if turn else tri)
    return without_folds(np.array(tris))


def without_folds(p):
    """Drops triangles without area after points have met; what remains is still closed."""
    ids = np.unique(np.round(p.reshape(-1, 3) * 2 ** 15).astype(np.int64), axis=0, return_inverse=True)[1].reshape(-1, 3)
    whole = (ids[:, 0] != ids[:, 1]) & (ids[:, 1] != ids[:, 2]) & (ids[:, 2] != ids[:, 0])
    p, ids = p[whole], ids[whole]
    # Two triangles over the same three points, facing apart, enclose nothing.
    keys = {}
    for n, tri in enumerate(ids):
        keys.setdefault(tuple(sorted(tri)), []).append(n)
    good = np.ones(len(p), bool)
    for group in keys.values():
        if len(group) == 2:
            good[group] = False
    return Mesh(p[good])
