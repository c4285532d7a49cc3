"""Triangle meshes while they are built: a soup of triangles whose corners carry position, texture place and colour.

Corners are shared only when a mesh is finished: finish() welds them, computes smooth normals and drops slivers. Until then parts
are simply joined, cut by planes and coloured. Units are metres in the model's frame: +y up, -z forward.
"""
import numpy as np

GRID = 2.0 ** -15  # positions are rounded to 0.03 mm, so that the last bit of a sine never changes a file


class Mesh:
    """p: corners (n, 3, 3); uv: (n, 3, 2); c: linear colours (n, 3, 3), 0..1; g: smoothing group of each triangle (n,)."""

    def __init__(self, p=None, uv=None, c=None, g=None):
        self.p = np.zeros((0, 3, 3)) if p is None else np.asarray(p, float)
        n = len(self.p)
        self.uv = np.zeros((n, 3, 2)) if uv is None else np.asarray(uv, float)
        self.c = np.ones((n, 3, 3)) if c is None else np.asarray(c, float)
        self.g = np.zeros(n, int) if g is None else np.asarray(g, int)

    def __len__(self):
        return len(self.p)

    def copy(self):
        return Mesh(self.p.copy(), self.uv.copy(), self.c.copy(), self.g.copy())

    def move(self, x=0.0, y=0.0, z=0.0):
        out = self.copy()
        out.p += np.array([x, y, z], float)
        return out

    def scale(self, x, y=None, z=None):
        out = self.copy()
        out.p *= np.array([x, x if y is None else y, x if z is None else z], float)
        return out

    def turn(self, axis, degrees, about=(0, 0, 0)):
        out = self.copy()
        out.p = (out.p - about) @ rotation(axis, degrees).T + about
        return out

    def mirror(self):
        """The same on the other side of the boat (x -> -x), still facing outwards."""
        p = self.p * np.array([-1.0, 1, 1])
        return Mesh(p[:, ::-1], self.uv[:, ::-1], self.c[:, ::-1], self.g.copy())

    def flipped(self):
        return Mesh(self.p[:, ::-1], self.uv[:, ::-1], self.c[:, ::-1], self.g.copy())

    def both_sides(self):
        return join([self, self.mirror()])

    def centres(self):
        return self.p.mean(axis=1)

    def where(self, mask):
        return Mesh(self.p[mask], self.uv[mask], self.c[mask], self.g[mask])

    def tint(self, colour, mask=None):
        """Multiplies the colour, an sRGB triple or a factor a corner, of all triangles or those of the mask."""
        out = self.copy()
        factor = linear(colour) if np.ndim(colour) == 1 else np.asarray(colour)
        if mask is None:
            out.c *= factor
        else:
            out.c[mask] *= factor
        return out

    def wear(self, shade):
        """Multiplies the colour of each corner by shade(positions), a factor or a linear colour a corner."""
        out = self.copy()
        factor = np.asarray(shade(out.p.reshape(-1, 3)))
        if factor.ndim == 1:
            factor = factor[:, None]
        out.c *= factor.reshape(len(out.p), 3, -1)
        return out


def linear(srgb):
    s = np.asarray(srgb, float)
    return np.where(s <= 0.04045, s / 12.92, ((np.maximum(s, 0.04045) + 0.055) / 1.055) ** 2.4)


def rotation(axis, degrees):
    a = np.zeros(3)
    if isinstance(axis, str):
        a["xyz".index(axis)] = 1.0
    else:
        a = np.asarray(axis, float) / np.linalg.norm(axis)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def join(meshes):
    """One mesh of many; their smoothing groups stay apart."""
    meshes = [m for m in meshes if m is not None and len(m)]
    if not meshes:
        return Mesh()
    groups, base = [], 0
    for m in meshes:
        groups.append(m.g + base)
        base += int(m.g.max()) + 1
    return Mesh(np.concatenate([m.p for m in meshes]), np.concatenate([m.uv for m in meshes]),
                np.concatenate([m.c for m in meshes]), np.concatenate(groups))


def overgrow(mesh, paints, weed, tide, wander=0.045):
    """Weed in place of what lies below `tide` (m) on surfaces of the given paints, a wet and grimy band above it. Its edge
    goes up and down by `wander` (m) and more: until the weed is laid, each corner is moved by that, kept beside its colour."""
    at = mesh.p
    lift = wander * np.sin(7.3 * at[:, :, 0] + 5.1 * at[:, :, 2]) + 0.6 * wander * np.sin(19 * at[:, :, 0] - 23 * at[:, :, 2] + 1)
    mesh = mesh.copy()
    mesh.c = np.concatenate([mesh.c, lift[:, :, None]], axis=2)
    mesh.p[:, :, 1] -= lift
    for y in (tide - 0.25, tide, tide + 0.25):
        mesh = cut(mesh, "y", y)
    middle = mesh.uv[:, :, 1].mean(1)
    height = mesh.p[:, :, 1].reshape(-1).copy()
    mesh.p[:, :, 1] += mesh.c[:, :, 3]
    mesh.c = mesh.c[:, :, :3].copy()
    for paint in paints:
        s, w = paint.skin, weed.skin
        low = (height.reshape(-1, 3).mean(1) < tide) & (np.abs(middle - (s.v0 + s.v1) / 2) < (s.v1 - s.v0) / 2)
        mesh.uv[low, :, 1] = w.v0 + (mesh.uv[low, :, 1] - s.v0) / (s.v1 - s.v0) * (w.v1 - w.v0)
        mesh.c[low] = linear(weed.colour)
    return mesh.wear(lambda q: np.where(height < tide, 1.0, 1 - 0.4 * np.clip(1 - (height - tide) / 0.4, 0, 1)))


def cut(mesh, axis, value):
    """Splits the triangles that cross a plane, so that an edge runs along it; nothing is removed."""
    k = "xyz".index(axis)
    out = mesh.copy()
    near = np.abs(out.p[:, :, k] - value) < 2e-4
    out.p[:, :, k] = np.where(near, value, out.p[:, :, k])
    d = out.p[:, :, k] - value
    above = d > 0
    below = d < 0
    crosses = above.any(1) & below.any(1)
    if not crosses.any():
        return out
    keep = out.where(~crosses)
    part = out.where(crosses)
    up = d[crosses] > 0
    alone = up.sum(1) == 1
    first = np.argmax(up == alone[:, None], axis=1)
    order = (first[:, None] + np.arange(3)) % 3
    rows = np.arange(len(part))[:, None]
    p, uv, c = part.p[rows, order], part.uv[rows, order], part.c[rows, order]
    dd = d[crosses][rows, order]

    def between(values, j):
        t = (dd[:, 0] / (dd[:, 0] - dd[:, j]))[:, None]
        return values[:, 0] + (values[:, j] - values[:, 0]) * t

    def three(values):
        ab, ac = between(values, 1), between(values, 2)
        return np.concatenate([np.stack([values[:, 0], ab, ac], 1), np.stack([ab, values[:, 1], values[:, 2]], 1),
                               np.stack([ab, values[:, 2], ac], 1)])

    p3 = three(p)
    on = np.abs(p3[:, :, k] - value) < 1e-9
    p3[:, :, k] = np.where(on, value, p3[:, :, k])
    fresh = Mesh(p3, three(uv), three(c), np.tile(part.g, 3))
    area = np.linalg.norm(np.cross(p3[:, 1] - p3[:, 0], p3[:, 2] - p3[:, 0]), axis=1)
    return Mesh(np.concatenate([keep.p, fresh.where(area > 1e-9).p]), np.concatenate([keep.uv, fresh.uv[area > 1e-9]]),
                np.concatenate([keep.c, fresh.c[area > 1e-9]]), np.concatenate([keep.g, fresh.g[area > 1e-9]]))


def corner_normals(p, g, crease_degrees):
    """Unit normals (n, 3, 3): the mean of the faces that meet there in one group and within the crease angle."""
    face = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    unit = face / np.linalg.norm(face, axis=1, keepdims=True)
    corners = p.reshape(-1, 3)
    key = np.concatenate([np.round(corners / GRID).astype(np.int64), np.repeat(g, 3)[:, None]], axis=1)
    order = np.lexsort(key.T)
    sorted_key = key[order]
    starts = np.flatnonzero(np.concatenate([[True], (sorted_key[1:] != sorted_key[:-1]).any(1)]))
    ends = np.append(starts[1:], len(order))
    result = np.repeat(unit, 3, axis=0)
    limit = np.cos(np.radians(crease_degrees))
    for a, b in zip(starts, ends):
        if b - a < 2:
            continue
        ids = order[a:b]
        u, w = unit[ids // 3], face[ids // 3]
        total = ((u @ u.T) > limit).astype(float) @ w
        length = np.linalg.norm(total, axis=1)
        good = length > 1e-12
        result[ids[good]] = total[good] / length[good, None]
    return result.reshape(-1, 3, 3)


def finish(mesh, crease_degrees=42.0):
    """The mesh as vertices: dict of p, n, uv, c (0..1 linear) and triangles i. Slivers are dropped."""
    p = np.round(mesh.p / GRID) * GRID
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2
    edge = np.sqrt(np.stack([((p[:, i] - p[:, i - 1]) ** 2).sum(1) for i in range(3)])).max(0)
    good = (area > 2e-8) & (area > edge * 4e-5)
    p, uv, c, g = p[good], mesh.uv[good], mesh.c[good], mesh.g[good]
    n = corner_normals(p, g, crease_degrees)
    rows = np.concatenate([np.round(p.reshape(-1, 3) / GRID), np.round(n.reshape(-1, 3) * 4096),
                           np.round(uv.reshape(-1, 2) * 32768), np.round(np.clip(c, 0, 1).reshape(-1, 3) * 255)],
                          axis=1).astype(np.int64)
    unique, first, inverse = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    inverse = inverse.reshape(-1)
    # Vertices in the order of their first use: neighbours stay close in memory.
    order = np.argsort(first)
    rank = np.empty(len(order), int)
    rank[order] = np.arange(len(order))
    v = unique[order]
    normal = v[:, 3:6] / 4096.0
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return {"p": v[:, :3] * GRID, "n": normal, "uv": v[:, 6:8] / 32768.0, "c": v[:, 8:11] / 255.0,
            "i": rank[inverse].reshape(-1, 3)}
