"""Shapes of which models are built: lofted grids, swept rails and ropes, planks, turned things and flat panels."""
import random

import numpy as np

from mesh import Mesh, join, linear


class Detail:
    """How finely a level is built: 0 full, 1 middle, 2 far."""

    def __init__(self, level):
        self.level = level

    def n(self, full, least=3):
        """A number of segments, fewer at lower levels."""
        return max(least, int(round(full * (1.0, 0.4, 0.2)[self.level])))

    def sides(self, full):
        """Sides of a round thing."""
        return max((3, 4, 3)[self.level], int(round(full * (1.0, 0.5, 0.35)[self.level])))

    @property
    def full(self):
        return self.level == 0

    @property
    def far(self):
        return self.level == 2


class Paint:
    """What a surface is made of: a strip of the model's texture sheet and a colour (sRGB) that multiplies it."""

    dice = random.Random(1)  # set anew for each model: where in its strip each part lies

    def __init__(self, skin, colour=(1, 1, 1), whole=False):
        """whole: the surface takes the strip's full height, however wide it is."""
        self.skin, self.colour, self.whole = skin, tuple(colour), whole

    def tinted(self, *colour):
        return Paint(self.skin, colour, self.whole)

    def place(self, u, v):
        """Texture places of distances in metres along (u) and across (v) the strip."""
        s = self.skin
        u0, low = Paint.dice.random(), float(np.min(v))
        width = float(np.max(v)) - low
        if s.tiles:
            return np.stack([np.asarray(u) / s.length_m + u0, np.asarray(v) / s.height_m + Paint.dice.random()], -1)
        room = 0.0 if self.whole else s.height_m - width
        start = Paint.dice.random() * room if room > 0 else 0.0
        stretch = 1.0 if room > 0 else s.height_m / max(width, 1e-9)
        across = (start + (np.asarray(v) - low) * stretch) / s.height_m
        return np.stack([np.asarray(u) / s.length_m + u0, s.v0 + (s.v1 - s.v0) * across], -1)


def lengths(path):
    """Distance along a path of points (n, 3) from its first."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])


def spline(points, n):
    """n points on the natural cubic spline through the given ones (k, dim), evenly by chord length."""
    points = np.asarray(points, float)
    if len(points) == 2:
        t = np.linspace(0, 1, n)[:, None]
        return points[0] + (points[1] - points[0]) * t
    knots = lengths(points)
    return spline_at(knots, points, np.linspace(0, knots[-1], n))


def spline_at(knots, values, at):
    """Natural cubic spline through values (k, ...) at increasing knots, evaluated at `at`."""
    knots, values, at = np.asarray(knots, float), np.asarray(values, float), np.asarray(at, float)
    shape = values.shape[1:]
    y = values.reshape(len(values), -1)
    h = np.diff(knots)
    n = len(knots)
    a, b = np.eye(n), np.zeros_like(y)
    for i in range(1, n - 1):
        a[i, i - 1:i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
        b[i] = 6 * ((y[i + 1] - y[i]) / h[i] - (y[i] - y[i - 1]) / h[i - 1])
    m = np.linalg.solve(a, b)
    i = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, n - 2)
    hi, left, right = h[i][:, None], (at - knots[i])[:, None], (knots[i + 1] - at)[:, None]
    out = (m[i] * right ** 3 + m[i + 1] * left ** 3) / (6 * hi) + (y[i] / hi - m[i] * hi / 6) * right
    return (out + (y[i + 1] / hi - m[i + 1] * hi / 6) * left).reshape((len(at),) + shape)


def grid(points, paint, wrap=False, flip=False, u=None, v=None, across=False):
    """A surface through points (ni, nj, 3); the strip runs along i, or along j with `across`. Faces point to di x dj."""
    points = np.asarray(points, float)
    if wrap:
        points = np.concatenate([points, points[:, :1]], axis=1)
    ni, nj = points.shape[:2]
    if u is None:
        u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=2).mean(1))])
    if v is None:
        v = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=1), axis=2).mean(0))])
    uu, vv = np.meshgrid(u, v, indexing="ij")
    uv = paint.place(vv, uu) if across else paint.place(uu, vv)
    i, j = np.meshgrid(np.arange(ni - 1), np.arange(nj - 1), indexing="ij")
    i, j = i.ravel(), j.ravel()
    ids = np.stack([np.stack([i, j], -1), np.stack([i + 1, j], -1), np.stack([i + 1, j + 1], -1), np.stack([i, j + 1], -1)], 1)
    # Each quad is split along its shorter diagonal: fewer creases on curved surfaces.
    q = points[ids[..., 0], ids[..., 1]]
    other = np.linalg.norm(q[:, 1] - q[:, 3], axis=1) < np.linalg.norm(q[:, 0] - q[:, 2], axis=1) - 1e-6
    pick = np.where(other[:, None], [[0, 1, 3, 1, 2, 3]], [[0, 1, 2, 0, 2, 3]])
    ids = ids[np.arange(len(ids))[:, None], pick].reshape(-1, 3, 2)
    p, t = points[ids[..., 0], ids[..., 1]], uv[ids[..., 0], ids[..., 1]]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    mesh = Mesh(p[area > 1e-10], t[area > 1e-10])
    mesh.c *= linear(paint.colour)
    return mesh.flipped() if flip else mesh


def fan(ring, paint, flip=False, centre=None):
    """A flat cap over a ring of points (n, 3), convex as seen from its middle."""
    ring = np.asarray(ring, float)
    centre = ring.mean(0) if centre is None else np.asarray(centre, float)
    p = np.stack([np.broadcast_to(centre, ring.shape), ring, np.roll(ring, -1, axis=0)], 1)
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]).sum(0)
    a, b = plane_axes(normal)
    flat = np.stack([p @ a, p @ b], -1)
    mesh = Mesh(p, paint.place(flat[..., 0], flat[..., 1]))
    mesh.c *= linear(paint.colour)
    return mesh.flipped() if flip else mesh


def plane_axes(normal):
    """Two unit vectors in the plane across a normal; the first as level as may be, along the boat where it can."""
    n = np.asarray(normal, float) / (np.linalg.norm(normal) + 1e-30)
    seed = np.array([0.0, 0, 1]) if abs(n[2]) < 0.9 else np.array([1.0, 0, 0])
    a = seed - n * (seed @ n)
    a /= np.linalg.norm(a)
    return a, np.cross(n, a)


def rect(w, h, bevel=0.0, round_steps=1):
    """Outline (counter-clockwise) of a rectangle with bevelled or rounded edges."""
    x, y = w / 2, h / 2
    if bevel <= 0:
        return np.array([[x, -y], [x, y], [-x, y], [-x, -y]])
    angles = np.linspace(0, 90, round_steps + 1)
    out = []
    for cx, cy, start in ((x, -y, -90), (x, y, 0), (-x, y, 90), (-x, -y, 180)):
        mx, my = cx - np.sign(cx) * bevel, cy - np.sign(cy) * bevel
        for a in np.radians(angles + start):
            out.append([mx + bevel * np.cos(a), my + bevel * np.sin(a)])
    return np.array(out)


def circle(r, n, squash=1.0):
    a = np.arange(n) * 2 * np.pi / n
    return np.stack([r * np.cos(a), r * squash * np.sin(a)], -1)


def frames(path, up):
    """Across and up directions (n, 3) along a path; `up` None carries the first frame along without twist."""
    path = np.asarray(path, float)
    t = np.gradient(path, axis=0)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    if up is None:
        ups = [plane_axes(t[0])[1]]
        for k in range(1, len(t)):
            y = ups[-1] - t[k] * (ups[-1] @ t[k])
            ups.append(y / np.linalg.norm(y))
        y = np.array(ups)
    else:
        y = np.broadcast_to(np.asarray(up, float), t.shape)
        y = y - t * (y * t).sum(1, keepdims=True)
        y = y / np.linalg.norm(y, axis=1, keepdims=True)
    return np.cross(t, y), y


def sweep(path, profile, paint, up=(0, 1, 0), caps=True, scale=None, closed=False):
    """A profile (m, 2: right and up, counter-clockwise) along a path. scale: a factor, or right and up factors, a point."""
    path = np.asarray(path, float)
    x, y = frames(np.concatenate([path[-1:], path, path[:1]]) if closed else path, up)
    if closed:
        x, y = x[1:-1], y[1:-1]
    s = np.ones((len(path), 2)) if scale is None else np.asarray(scale, float)
    if s.ndim == 1:
        s = np.stack([s, s], -1)
    points = path[:, None] + x[:, None] * (profile[None, :, :1] * s[:, None, :1]) + y[:, None] * (profile[None, :, 1:] * s[:, None, 1:])
    if closed:
        points = np.concatenate([points, points[:1]])
    parts = [grid(points, paint, wrap=True)]
    if caps and not closed:
        if s[0].min() > 1e-4:
            parts.append(fan(points[0], paint))
        if s[-1].min() > 1e-4:
            parts.append(fan(points[-1], paint, flip=True))
    out = join(parts)
    out.g[:] = 0
    return out


def tube(path, r, paint, sides=8, caps=True, scale=None, closed=False):
    return sweep(path, circle(r, sides), paint, up=None, caps=caps, scale=scale, closed=closed)


def bar(a, b, w, h, paint, up=(0, 1, 0), bevel=0.0, ends=True):
    """A straight plank or post from a to b, w across and h along `up`, its edges bevelled."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    t = (b - a) / np.linalg.norm(b - a)
    if abs(np.dot(t, np.asarray(up, float) / np.linalg.norm(up))) > 0.99:
        up = (0, 0, 1) if abs(t[2]) < 0.9 else (1, 0, 0)
    if bevel > 0 and ends:
        path = np.array([a, a + t * bevel, b - t * bevel, b])
        k = np.array([[1 - 2 * bevel / w, 1 - 2 * bevel / h], [1, 1], [1, 1], [1 - 2 * bevel / w, 1 - 2 * bevel / h]])
        return sweep(path, rect(w, h, bevel), paint, up, scale=k)
    return sweep(np.array([a, b]), rect(w, h, bevel), paint, up)


def box(centre, size, paint, bevel=0.0):
    """A block with its sides along the axes; the strip runs along its longest side."""
    c, s = np.asarray(centre, float), np.asarray(size, float)
    k = int(np.argmax(s))
    d = np.zeros(3)
    d[k] = s[k] / 2
    if k == 1:
        return bar(c - d, c + d, s[0], s[2], paint, (0, 0, 1), bevel)
    return bar(c - d, c + d, s[2] if k == 0 else s[0], s[1], paint, (0, 1, 0), bevel)


def lathe(profile, n, paint, across=True, start=0.0):
    """A turned thing about the y axis. profile: (r, y) from bottom to top. The strip runs around, or up with across False."""
    profile = np.asarray(profile, float)
    a = start + np.arange(n + 1) * 2 * np.pi / n
    r, y = profile[:, 0], profile[:, 1]
    p = np.stack([r[:, None] * np.cos(a), np.broadcast_to(y[:, None], (len(r), n + 1)), r[:, None] * np.sin(a)], -1)
    v = lengths(profile)
    length = 2 * np.pi * r.max()
    repeat = paint.skin.length_m if across else paint.skin.height_m
    if length > 0.7 * repeat and (across or paint.skin.tiles):
        length = round(length / repeat) * repeat  # no seam
    around = np.linspace(0, length, n + 1)
    return grid(p, paint, u=v, v=around, across=across, flip=False)


def ring(centre, axis, radius, r, paint, sides=16, round_sides=6):
    """A torus about an axis through its centre."""
    a, b = plane_axes(axis)
    t = np.arange(sides) * 2 * np.pi / sides
    path = np.asarray(centre, float) + radius * (np.cos(t)[:, None] * a + np.sin(t)[:, None] * b)
    return sweep(path, circle(r, round_sides), paint, up=np.asarray(axis, float), closed=True)


def ears(flat):
    """Triangles of a simple polygon (n, 2), counter-clockwise, by cutting ears."""
    ids, out = list(range(len(flat))), []

    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    while len(ids) > 3:
        best, best_score = None, -1.0
        for k in range(len(ids)):
            ia, ib, ic = ids[k - 1], ids[k], ids[(k + 1) % len(ids)]
            a, b, c = flat[ia], flat[ib], flat[ic]
            size = area(a, b, c)
            if size <= 1e-12:
                continue
            if any(area(a, b, flat[q]) > -1e-12 and area(b, c, flat[q]) > -1e-12 and area(c, a, flat[q]) > -1e-12
                   for q in ids if q not in (ia, ib, ic)):
                continue
            score = size / (np.sum((a - b) ** 2) + np.sum((b - c) ** 2) + np.sum((c - a) ** 2))
            if score > best_score:
                best, best_score = k, score
        if best is None:
            ids.pop(0)  # what is left is a line
            continue
        out.append([ids[best - 1], ids[best], ids[(best + 1) % len(ids)]])
        ids.pop(best)
    return np.array(out + [ids])


def box_mapped(mesh, paint, aslant=False):
    """The mesh with a repeating texture laid on from the nearest of the three axes, or aslant from above without seams."""
    out = mesh.copy()
    if aslant:
        x, y, z = np.moveaxis(out.p, 2, 0)
        out.uv = paint.place(x + 0.6 * y, z - 0.6 * y)
        out.c = np.ones_like(out.c) * linear(paint.colour)
        return out
    n = np.abs(np.cross(out.p[:, 1] - out.p[:, 0], out.p[:, 2] - out.p[:, 0]))
    k = n.argmax(1)
    a, b = np.array([[2, 1], [0, 2], [0, 1]])[k].T
    rows = np.arange(len(out))[:, None]
    uv = paint.place(out.p[rows, np.arange(3), a[:, None]], out.p[rows, np.arange(3), b[:, None]])
    out.uv = uv
    out.c = np.ones_like(out.c) * linear(paint.colour)
    return out


def sheet_of(outline, paint):
    """One flat face over a planar outline (n, 3), counter-clockwise from the side that it faces."""
    p = np.asarray(outline, float)
    q = np.roll(p, -1, axis=0)
    normal = np.cross(p - p[0], q - p[0]).sum(0)
    a, b = plane_axes(normal)
    flat = np.stack([(p - p[0]) @ a, (p - p[0]) @ b], -1)
    t = ears(flat)
    if np.ptp(flat[:, 1]) > np.ptp(flat[:, 0]):
        flat = np.stack([flat[:, 1], -flat[:, 0]], -1)  # the grain runs along the longer side
    uv = paint.place(flat[:, 0], flat[:, 1])
    mesh = Mesh(p[t], uv[t])
    mesh.c *= linear(paint.colour)
    return mesh, normal / np.linalg.norm(normal)


def inset(outline, distance):
    """A planar outline (n, 3), counter-clockwise, drawn in by a distance."""
    p = np.asarray(outline, float)
    normal = np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(0)
    normal /= np.linalg.norm(normal)
    e = np.roll(p, -1, axis=0) - p
    inward = np.cross(normal, e / np.linalg.norm(e, axis=1, keepdims=True))
    before = np.roll(inward, 1, axis=0)
    return p + distance * (inward + before) / np.maximum(1 + (inward * before).sum(1, keepdims=True), 0.3)


def panel(outline, thickness, paint, edge=None, bevel=0.0):
    """A board: the outline (n, 3), counter-clockwise, is its front, the back lies `thickness` behind."""
    p = np.asarray(outline, float)
    front, normal = sheet_of(inset(p, bevel) if bevel else p, paint)
    back = front.flipped()
    back.p = back.p - normal * thickness
    rows = [p, p - normal * thickness]
    if bevel:
        small = inset(p, bevel)
        rows = [small, p - normal * bevel, p - normal * (thickness - bevel), small - normal * thickness]
    rows = np.stack(rows, 1)
    rim = grid(np.concatenate([rows, rows[:1]]), edge or paint, flip=True)
    out = join([front, back, rim])
    out.g[:] = 0
    return out


def upward(outline):
    """The outline turned so that its face looks up."""
    p = np.asarray(outline, float)
    return p if np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(0)[1] > 0 else p[::-1]


def closed_lathe(profile, n):
    """A closed turned body for physics: the profile starts and ends on the axis."""
    a = np.arange(n + 1) * 2 * np.pi / n
    profile = np.asarray(profile, float)
    r, y = profile[:, 0], profile[:, 1]
    p = np.stack([r[:, None] * np.cos(a), np.broadcast_to(y[:, None], (len(r), n + 1)), r[:, None] * np.sin(a)], -1)
    p[:, -1] = p[:, 0]
    return bare_grid(p)


def bare_grid(p):
    """The triangles of a grid of points without texture, folds left out."""
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    t = np.concatenate([np.stack(q, 2).reshape(-1, 3, 3) for q in ((a, b, c), (a, c, d))])
    area = np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1)
    return Mesh(t[area > 1e-9])


def closed_box(low, high):
    """A closed box for physics."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    c = [np.array([x, y, z], float) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Mesh(np.array([[c[q[0]], c[q[i]], c[q[i + 1]]] for q in faces for i in (1, 2)]))


def rope_path(a, b, sag, n=12):
    """A hanging line from a to b, its middle `sag` below the chord."""
    t = np.linspace(0, 1, n)[:, None]
    return np.asarray(a) + (np.asarray(b, float) - a) * t - np.array([0, 4 * sag, 0]) * t * (1 - t)


def coil(centre, r, rope_r, turns, paint, per_turn=12, sides=5):
    """A flat coil of rope lying on a deck, three layers high at most."""
    a = np.linspace(0, turns * 2 * np.pi, turns * per_turn)
    turn = a / (2 * np.pi)
    radius = r - rope_r * 1.9 * np.abs((turn % 4) - 2) + 0.1 * rope_r * np.sin(5.3 * a)
    y = rope_r + np.floor(turn / 4) * rope_r * 1.5 + 0.1 * rope_r * np.sin(3.1 * a)
    path = np.asarray(centre, float) + np.stack([radius * np.cos(a), y, radius * np.sin(a)], -1)
    return tube(path, rope_r, paint, sides)


def ball(centre, r, paint, n=12, squash=1.0):
    a = np.linspace(-np.pi / 2, np.pi / 2, max(3, n // 2) + 1)
    m = lathe(np.stack([r * np.cos(a), r * squash * np.sin(a)], -1), n, paint)
    return m.move(*centre)
