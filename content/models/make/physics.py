"""How a closed hull floats: displaced volume, centres, waterplane, metacentric heights. Water 1025 kg/m3, surface at y = 0."""
import numpy as np

from mesh import Mesh, cut

WATER = 1025.0


def closed(mesh):
    """Is every edge used exactly once in each direction?"""
    ids = np.unique(np.round(mesh.p.reshape(-1, 3) * 4096).astype(np.int64), axis=0, return_inverse=True)[1].reshape(-1, 3)
    edges = np.concatenate([ids[:, [0, 1]], ids[:, [1, 2]], ids[:, [2, 0]]])
    there, count = np.unique(edges, axis=0, return_counts=True)
    back = set(map(tuple, there[:, ::-1]))
    return bool((count == 1).all() and all(tuple(e) in back for e in there))


def below(mesh):
    """The triangles under water of a mesh, cut at the surface."""
    part = cut(mesh, "y", 0.0)
    return part.where(part.centres()[:, 1] < 0)


def displaced(mesh):
    """Volume (m3) and its centre, by the divergence theorem; the lid at y = 0 adds nothing. Exact for flat triangles."""
    p = below(mesh).p
    if not len(p):
        return 0.0, np.zeros(3)
    ny = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])[:, 1] / 2
    mid = (p + np.roll(p, -1, axis=1)) / 2  # edge midpoints: exact for quadratic integrands
    volume = (mid[:, :, 1].mean(1) * ny).sum()
    moment = [(mid[:, :, k] * mid[:, :, 1] * (0.5 if k == 1 else 1)).mean(1) @ ny for k in range(3)]
    return float(volume), np.array(moment) / volume


def waterline(mesh):
    """Directed segments (n, 2, 2: x, z) where a closed mesh meets the surface."""
    p = below(mesh).p
    on = np.abs(p[:, :, 1]) < 1e-9
    out = []
    for k in range(3):
        mask = on[:, k] & on[:, (k + 1) % 3] & ~on[:, (k + 2) % 3]
        out.append(np.stack([p[mask, k][:, [0, 2]], p[mask, (k + 1) % 3][:, [0, 2]]], 1))
    return np.concatenate(out)


def waterplane(mesh):
    """Area (m2), centre (x, z) and second moments about it: across (integral of x2) and along (of z2)."""
    s = waterline(mesh)
    a, b = s[:, 0], s[:, 1]
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    area = cross.sum() / 2
    centre = ((a + b) * cross[:, None]).sum(0) / (6 * area)
    second = ((a * a + a * b + b * b) * cross[:, None]).sum(0) / 12
    sign = np.sign(area)
    area, second = abs(area), second * sign
    return float(area), centre, second - area * centre ** 2


def loops(mesh):
    """The waterline as closed outlines (n, 2: x, z), the longest first."""
    s = waterline(mesh)
    key = [tuple(k) for k in np.round(s.reshape(-1, 2) * 8192).astype(int)]
    after = {key[2 * i]: (key[2 * i + 1], s[i, 0]) for i in range(len(s))}
    out = []
    while after:
        start = k = min(after)
        ring = []
        while k in after:
            k, point = after.pop(k)
            ring.append(point)
            if k == start:
                break
        if len(ring) > 2:
            out.append(np.array(ring))
    return sorted(out, key=lambda r: -len(r))


def metacentric(mesh, centre_of_mass):
    """Transverse and longitudinal GM (m)."""
    volume, buoyancy = displaced(mesh)
    _, _, second = waterplane(mesh)
    lever = buoyancy[1] - centre_of_mass[1]
    return float(second[0] / volume + lever), float(second[1] / volume + lever)


def sink(mesh, mass_kg):
    """How far (m, up) to move a closed hull so that it displaces a mass."""
    low, high = -float(mesh.p[:, :, 1].max()), -float(mesh.p[:, :, 1].min())
    for _ in range(60):
        middle = (low + high) / 2
        if displaced(mesh.move(y=middle))[0] * WATER > mass_kg:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def box_inertia(mass, size):
    """Inertia of an even box about its centre: diagonal, kg m2."""
    x, y, z = size
    return np.diag([mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12])


def hull_inertia(mass, length, beam):
    """Radii of gyration of boats: 0.4 of the beam in roll, 0.25 of the length in pitch and yaw (shared/facts/boats.md)."""
    return np.diag([mass * (0.25 * length) ** 2, mass * (0.25 * length) ** 2, mass * (0.4 * beam) ** 2])
