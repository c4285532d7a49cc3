"""Wigley's hull (1942) as a towing tank has it: parabolas along and down, wall-sided above the waterline, a lid."""
import numpy as np

import physics
import surfaces as on
from hull import closed_from
from mesh import join
from model import Model
from shapes import Paint, grid
from textures import Sheet

LENGTH, BEAM, DRAUGHT, FREEBOARD = 10.0, 1.0, 0.625, 0.375
MASS = physics.WATER * 4 / 9 * LENGTH * BEAM * DRAUGHT


def half_breadth(z, y):
    """Of the hull at a place along it and a height above the waterline."""
    return 0.5 * BEAM * (1 - (2 * z / LENGTH) ** 2) * (1 - (np.minimum(y, 0) / DRAUGHT) ** 2)


def sections(along, heights):
    """Starboard points (nt, ns, 3), bow first, from the keel up."""
    z, y = np.meshgrid(LENGTH / 2 * np.asarray(along), heights, indexing="ij")
    return np.stack([half_breadth(z, y), y, z], -1)


def hull(d, p):
    n, m = (64, 14) if d.full else (28, 6) if not d.far else (14, 3)
    along = -np.cos(np.linspace(0, np.pi, n))
    low = sections(along, np.linspace(-DRAUGHT, 0, m))
    top = sections(along, np.linspace(0, FREEBOARD, 3))
    lid = np.stack([top[:, -1] * [-1, 1, 1], top[:, -1]], 1)
    side = [grid(low, p["bottom"], flip=True), grid(top, p["side"], flip=True)]
    port = [grid(q * [-1, 1, 1], p[name]) for q, name in ((low, "bottom"), (top, "side"))]
    return join(side + port + [grid(lid, p["lid"])])


def build():
    sheet = Sheet("sheet", 512, 512, [("paint", 192, on.gelcoat), ("lid", 32, on.varnished), ("spare", 32, on.steel)], 47)
    p = {"bottom": Paint(sheet["paint"], (0.95, 0.72, 0.10)), "side": Paint(sheet["paint"], (0.96, 0.94, 0.90)), "lid": Paint(sheet["lid"], (1, 1, 1))}
    model = Model("wigley", "hull", [sheet], (20, 80, 3000), 0.05)
    model.part("hull", lambda d: hull(d, p))
    along = np.linspace(-1, 1, 13)
    model.body("collision", closed_from(sections(along, [-DRAUGHT, -0.55, -0.42, -0.24, 0.0, FREEBOARD])))
    volume, _ = physics.displaced(model.bodies["collision"])
    mass = round(physics.WATER * volume, 1)  # of the coarse hull, which is what floats
    model.floats(mass, -DRAUGHT + 0.40, physics.hull_inertia(mass, LENGTH, BEAM), LENGTH, BEAM)
    model.extras.update({"seats": [], "grips": [], "lights": []})
    return model
