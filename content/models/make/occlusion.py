"""Ambient occlusion of vertices: the model is drawn into a grid of cells and short rays are marched through it."""
import numpy as np


def directions(n):
    """n directions spread evenly over the sphere (Fibonacci)."""
    k = np.arange(n) + 0.5
    y = 1 - 2 * k / n
    a = np.pi * (1 + 5 ** 0.5) * k
    r = np.sqrt(1 - y * y)
    return np.stack([r * np.cos(a), y, r * np.sin(a)], -1)


def cells_of(parts, cell):
    """Grid of occupied cells over the triangles of parts (dicts with p and i), its corner."""
    corners = np.concatenate([m["p"][m["i"]] for m in parts])
    low = corners.min((0, 1)) - 2 * cell
    size = np.ceil((corners.max((0, 1)) + 2 * cell - low) / cell).astype(int) + 1
    full = np.zeros(size, bool)
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(1)
    steps = np.clip(np.ceil(edges / cell * 1.6).astype(int), 1, 80)
    for n in np.unique(steps):
        group = corners[steps == n]
        u, v = np.meshgrid((np.arange(n + 1)) / n, (np.arange(n + 1)) / n, indexing="ij")
        inside = u + v <= 1 + 1e-9
        u, v = u[inside], v[inside]
        for k in range(0, len(group), 4000):
            g = group[k:k + 4000]
            p = g[:, None, 0] + (g[:, None, 1] - g[:, None, 0]) * u[None, :, None] + (g[:, None, 2] - g[:, None, 0]) * v[None, :, None]
            i = np.floor((p.reshape(-1, 3) - low) / cell).astype(int)
            full[i[:, 0], i[:, 1], i[:, 2]] = True
    return full, low


def bake(parts, cell, strength=0.75, rays=48, reach=12):
    """Darkens the colours of parts in place, by the share of the sky over each vertex that near parts hide."""
    full, low = cells_of(parts, cell)
    limit = np.array(full.shape) - 1
    for m in parts:
        p, n = m["p"], m["n"]
        hit, weight = np.zeros(len(p)), np.zeros(len(p))
        for d in directions(rays):
            cosine = np.maximum(n @ d, 0)
            use = np.flatnonzero(cosine > 0.08)
            if not len(use):
                continue
            start = p[use] + n[use] * cell * 1.6
            blocked = np.zeros(len(use))
            for k in range(reach):
                i = np.floor((start + d * (cell * k) - low) / cell).astype(int)
                outside = ((i < 0) | (i > limit)).any(1)
                i = np.clip(i, 0, limit)
                there = full[i[:, 0], i[:, 1], i[:, 2]] & ~outside
                blocked = np.maximum(blocked, np.where(there, 1 - (k / reach) ** 2, 0))
            hit[use] += blocked * cosine[use]
            weight[use] += cosine[use]
        shade = 1 - strength * hit / np.maximum(weight, 1e-9)
        m["c"] = np.round(np.clip(m["c"] * shade[:, None], 0, 1) * 255) / 255.0
