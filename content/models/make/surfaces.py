"""Painters of texture strips: each takes a Field and gives colour, roughness and height of one kind of surface.

value picks from `colours` (sRGB), rough from `orm` (occlusion, roughness, metallic); height is in metres.
"""
import numpy as np

from textures import step


def plain(value, colours, rough, orm, height):
    return {"value": value, "colours": colours, "rough": rough, "orm": orm, "height": height}


def matte(low, high, metal=0.0):
    """Roughness from low to high."""
    return [(1, low, metal), (1, high, metal)]


def grain(f):
    """Wood grain along u, 0..1: bands that wander, fine pores."""
    bend = f.noise(f.w / 4, f.h / 2) * f.h / 10 + f.noise(f.w / 12, f.h / 3) * f.h / 30
    bands = np.sin((f.y + bend) * 2 * np.pi * max(3, f.h // 12) / f.h + f.noise(f.w / 6, f.h / 4) * 1.2)
    return np.clip(0.5 + 0.2 * bands + 0.13 * f.noise(70, 1.6) + 0.1 * f.noise(180, 5), 0, 1)


def varnished(f):
    """Pine or larch under worn varnish."""
    g = grain(f)
    worn = step(1.0, 2.2, f.cloud(120, 30))
    value = np.clip(0.12 + 0.75 * g - 0.12 * worn, 0, 1)
    return plain(value, [(0.30, 0.17, 0.08), (0.52, 0.32, 0.15), (0.66, 0.44, 0.22), (0.76, 0.55, 0.31)],
                 np.clip(0.35 + 0.5 * worn + 0.15 * (1 - g), 0, 1), matte(0.28, 0.8), 0.0006 * g)


def weathered(f):
    """Bare wood gone grey: cracks along the grain."""
    g = grain(f)
    crack = step(1.5, 2.1, f.noise(90, 1.8) + 0.4 * f.noise(200, 4))
    value = np.clip(0.25 + 0.55 * g + 0.1 * f.cloud(100, 30) - 0.6 * crack, 0, 1)
    return plain(value, [(0.16, 0.13, 0.11), (0.36, 0.31, 0.27), (0.52, 0.47, 0.41), (0.66, 0.61, 0.54)],
                 np.clip(0.6 + 0.3 * g, 0, 1), matte(0.7, 0.95), 0.0016 * g - 0.003 * crack)


def old_oak(f):
    """Dark wet wood with green on it."""
    g = grain(f)
    green = step(0.3, 1.6, f.cloud(60, 24))
    value = np.clip(0.1 + 0.45 * g + 0.45 * green, 0, 1)
    return plain(value, [(0.10, 0.08, 0.06), (0.24, 0.18, 0.12), (0.35, 0.29, 0.19), (0.32, 0.36, 0.18)],
                 np.clip(0.7 - 0.4 * green + 0.3 * g, 0, 1), matte(0.35, 0.9), 0.0016 * g + 0.001 * green)


def painted(f):
    """Brushed paint on wood, nearly white for tinting: faint grain, scuffs and a few chips down to the wood."""
    g = grain(f)
    scuff = f.cloud(70, 10)
    chip = step(2.3, 2.5, f.cloud(30, 9) + 0.5 * f.noise(200, 4))
    value = np.clip(0.86 + 0.08 * (g - 0.5) - 0.035 * np.maximum(scuff, 0) - 0.75 * chip, 0, 1)
    return plain(value, [(0.34, 0.24, 0.16), (0.55, 0.46, 0.36), (0.80, 0.78, 0.74), (0.92, 0.92, 0.90), (1.0, 1.0, 0.99)],
                 np.clip(0.25 + 0.12 * np.maximum(scuff, 0) + 0.6 * chip + 0.1 * g, 0, 1), matte(0.33, 0.85),
                 0.0004 * g - 0.0008 * chip)


def strakes(f):
    """A painted plank of a clinker boat with a row of rivets along its upper edge."""
    p = painted(f)
    spacing = f.w / round(f.w / 64.0)
    x = (f.x % spacing) - spacing / 2
    for row in (f.h * 0.13,):
        rivet = step(4.2, 2.6, np.hypot(x, f.y - row))
        p["height"] = p["height"] + 0.0012 * rivet
        p["value"] = p["value"] - 0.10 * step(6.0, 3.5, np.hypot(x, f.y - row)) + 0.08 * rivet
    streak = np.clip(f.noise(6, f.h * 2), 0, 3) * f.v
    p["value"] = p["value"] - 0.025 * streak
    return p


def gelcoat(f):
    """Polished plastic hull: almost even, with faint streaks and fine scratches."""
    streak = f.noise(14, f.h * 1.5)
    scratch = step(2.2, 2.8, f.noise(90, 1.2))
    value = np.clip(0.85 + 0.035 * f.cloud(160, 60) + 0.03 * streak - 0.2 * scratch, 0, 1)
    return plain(value, [(0.72, 0.71, 0.67), (0.90, 0.90, 0.88), (1, 1, 1)],
                 np.clip(0.3 + 0.12 * f.cloud(60, 40) + 0.4 * scratch, 0, 1), matte(0.16, 0.45), 0.00008 * f.noise(40, 30))


def nonskid(f):
    """Moulded deck pattern: small diamonds."""
    period = f.w / round(f.w / 8.0)
    rows = f.h / max(1, round(f.h / 8.0))
    d = np.abs(((f.x / period + f.y / rows) % 1) - 0.5) + np.abs(((f.x / period - f.y / rows) % 1) - 0.5)
    bump = step(0.35, 0.6, d)
    value = np.clip(0.72 + 0.12 * bump + 0.06 * f.cloud(90, 50), 0, 1)
    return plain(value, [(0.66, 0.66, 0.63), (0.86, 0.86, 0.84), (1, 1, 0.99)],
                 np.clip(0.6 - 0.2 * bump, 0, 1), matte(0.45, 0.8), 0.0012 * bump)


def antifouling(f):
    """Matt underwater paint with slime and worn patches."""
    slime = step(0.2, 1.8, f.cloud(50, 40))
    value = np.clip(0.7 + 0.1 * f.cloud(20, 14) - 0.5 * slime * np.clip(0.4 + 0.4 * f.noise(8, 8), 0, 1), 0, 1)
    return plain(value, [(0.34, 0.38, 0.26), (0.62, 0.62, 0.54), (0.86, 0.85, 0.83), (1, 1, 1)],
                 np.clip(0.6 + 0.2 * f.noise(12, 12), 0, 1), matte(0.65, 0.95), 0.0006 * slime)


def weed(f):
    """Algae and weed at a waterline: strands and mats, lighter where short."""
    strand = f.noise(4, f.h / 2) + 0.6 * f.noise(10, 12)
    mat = f.cloud(40, 30)
    value = np.clip(0.5 + 0.16 * strand + 0.12 * mat, 0, 1)
    return plain(value, [(0.05, 0.06, 0.03), (0.11, 0.13, 0.05), (0.19, 0.21, 0.09), (0.29, 0.28, 0.15)],
                 np.clip(0.5 + 0.2 * mat, 0, 1), matte(0.35, 0.9), 0.004 * np.clip(strand, -1, 2))


def teak(f):
    """Laid deck: planks 45 mm wide with dark caulking between."""
    g = grain(f)
    planks = max(1, round(f.h / 24.0))
    at = (f.v * planks) % 1
    seam = step(0.10, 0.04, np.minimum(at, 1 - at))
    tone = np.array(f.state.uniform(-0.12, 0.12, planks))[np.minimum((f.v * planks).astype(int), planks - 1)]
    value = np.clip(0.45 + 0.35 * g + tone, 0.22, 1) * (1 - seam)
    return plain(value, [(0.05, 0.05, 0.05), (0.30, 0.23, 0.16), (0.58, 0.46, 0.33), (0.72, 0.60, 0.45)],
                 np.clip(0.6 + 0.25 * g - 0.4 * seam, 0, 1), matte(0.45, 0.85), 0.0008 * g - 0.0015 * seam)


def steel(f):
    """Stainless or galvanised steel, brushed and stained."""
    brush = f.noise(120, 1.2)
    stain = step(0.8, 2.2, f.cloud(40, 20))
    value = np.clip(0.75 + 0.05 * brush + 0.05 * f.cloud(40, 30) - 0.35 * stain, 0, 1)
    return plain(value, [(0.36, 0.31, 0.27), (0.62, 0.61, 0.59), (0.84, 0.84, 0.84)],
                 np.clip(0.3 + 0.12 * brush + 0.5 * stain, 0, 1), [(1, 0.22, 1), (1, 0.4, 1), (1, 0.7, 0.8)],
                 0.00012 * brush)


def painted_steel(f):
    """Ship's paint on steel, light for tinting: rust at scratches, running down from them."""
    spot = f.cloud(26, 20)
    rust = step(1.75, 2.3, spot)
    run = np.zeros_like(rust)
    for k in range(1, 18):
        run = np.maximum(run, np.pad(rust, ((k, 0), (0, 0)))[:f.h] * (1 - k / 18.0))
    run *= np.clip(0.6 + 0.4 * f.noise(3, f.h), 0, 1)
    value = np.clip(0.88 + 0.05 * f.cloud(80, 40) - 0.38 * run - 0.45 * rust, 0, 1)
    return plain(value, [(0.17, 0.09, 0.05), (0.33, 0.17, 0.08), (0.52, 0.32, 0.19), (0.84, 0.80, 0.75), (0.95, 0.95, 0.93), (1, 1, 1)],
                 np.clip(0.2 + 0.1 * f.cloud(50, 30) + 0.7 * rust + 0.2 * run, 0, 1), matte(0.35, 0.95),
                 0.0008 * rust + 0.0002 * f.noise(30, 24))


def rusty(f):
    """Steel given up to rust: scales and pits."""
    scale = f.cloud(24, 20)
    pit = step(1.0, 2.0, f.cloud(9, 9))
    value = np.clip(0.5 + 0.2 * scale - 0.3 * pit, 0, 1)
    return plain(value, [(0.10, 0.06, 0.05), (0.26, 0.13, 0.07), (0.42, 0.22, 0.10), (0.54, 0.33, 0.18)],
                 np.clip(0.8 + 0.1 * scale, 0, 1), [(0.7, 0.75, 0.1), (1, 0.95, 0)], 0.002 * scale - 0.003 * pit)


def rope(f):
    """Three-strand rope, the strip once around it."""
    period = f.w / round(f.w / 26.0)
    lay = ((f.x / period + f.v * 3) % 1)
    strand = np.sqrt(np.clip(1 - (2 * lay - 1) ** 2, 0, 1))
    fibre = f.noise(3, 9)
    value = np.clip(0.15 + 0.7 * strand + 0.07 * fibre, 0, 1)
    return plain(value, [(0.35, 0.31, 0.25), (0.68, 0.63, 0.53), (0.86, 0.82, 0.74), (0.95, 0.93, 0.88)],
                 np.clip(1 - strand, 0, 1), [(1, 0.8, 0), (0.45, 0.95, 0)], 0.006 * strand + 0.0005 * fibre)


def rubber(f):
    """Coated fabric of an inflatable tube, or a fender: fine grain, dust, scuffs. Light for tinting."""
    dust = step(0.5, 2.0, f.cloud(90, 60))
    value = np.clip(0.75 + 0.05 * f.noise(2.5, 2.5) + 0.12 * dust - 0.1 * step(1.6, 2.4, f.noise(60, 3)), 0, 1)
    return plain(value, [(0.6, 0.6, 0.6), (0.85, 0.85, 0.84), (1, 1, 0.98)],
                 np.clip(0.4 + 0.3 * dust + 0.1 * f.noise(3, 3), 0, 1), matte(0.5, 0.85), 0.0002 * f.noise(2.5, 2.5))


def canvas(f):
    """Sailcloth: weave, a doubled seam with zigzag stitches along the strip's edges, creases."""
    weave = np.sin(f.x * np.pi / 1.5) * np.sin(f.y * np.pi / 1.5)
    seam = step(0.07, 0.05, np.minimum(f.v, 1 - f.v))
    stitch = step(1.6, 0.8, np.abs(np.abs((f.x % 12) - 6) - 3 - (np.minimum(f.y, f.h - f.y) - f.h * 0.035)))
    crease = f.cloud(110, 40)
    value = np.clip(0.8 + 0.02 * weave + 0.05 * crease - 0.16 * seam - 0.16 * stitch * seam, 0, 1)
    return plain(value, [(0.62, 0.60, 0.55), (0.85, 0.84, 0.80), (1, 1, 0.98)],
                 np.clip(0.6 + 0.1 * crease, 0, 1), matte(0.6, 0.85), 0.0012 * crease + 0.0006 * seam)


def glass(f):
    """Dark glazing or lenses: even, with a little salt."""
    salt = step(1.2, 3.0, f.cloud(30, 30))
    return plain(np.clip(0.4 + 0.2 * salt, 0, 1), [(0.75, 0.8, 0.85), (1, 1, 1)], np.clip(0.1 + 0.6 * salt, 0, 1),
                 matte(0.04, 0.35), 0.0 * f.x)


def moulding(f):
    """Plastic, leather, engine covers: light for tinting, a fine leathery grain."""
    g = f.noise(4, 4)
    value = np.clip(0.8 + 0.04 * g + 0.06 * f.cloud(80, 50), 0, 1)
    return plain(value, [(0.7, 0.7, 0.7), (0.9, 0.9, 0.9), (1, 1, 1)], np.clip(0.45 + 0.12 * g, 0, 1), matte(0.3, 0.7), 0.0002 * g)


def rock(f):
    """Broken granite for both directions: grains, cracks, lichen."""
    big = f.cloud(90, 90, 6)
    near, second, _ = f.cells(46)
    crack = step(5.0, 0.5, second - near + 3 * f.noise(6, 6)) * step(-0.4, 0.9, f.noise(60, 60))
    speck = f.noise(2.2, 2.2)
    value = np.clip(0.5 + 0.14 * big + 0.07 * speck - 0.3 * crack, 0, 1)
    return plain(value, [(0.22, 0.21, 0.20), (0.40, 0.38, 0.36), (0.55, 0.53, 0.50), (0.72, 0.70, 0.67)],
                 np.clip(0.6 + 0.15 * big, 0, 1), [(0.75, 0.7, 0), (1, 0.95, 0)], 0.010 * big - 0.02 * crack + 0.0008 * speck)


def masonry(f):
    """Whitewashed ashlar for both directions: courses 0.5 m high of blocks twice as long, joints weathered open."""
    rows, per = 8, 4
    course = np.floor(f.y / f.h * rows)
    along = f.x / f.w * per + 0.5 * (course % 2) + 0.06 * np.sin(course * 5)
    edge = np.minimum(np.minimum(along % 1, 1 - along % 1) * f.w / per,
                      np.minimum(f.y / f.h * rows % 1, 1 - f.y / f.h * rows % 1) * f.h / rows)
    joint = step(2.6, 0.8, edge + 0.6 * f.noise(5, 5))
    block = (np.sin(np.floor(along) * 12.9898 + course * 78.233) * 43758.5453) % 1
    run = np.clip(f.noise(5, f.h), 0, 3)
    peel = step(2.0, 2.5, f.cloud(36, 36))  # few and faint: the wall repeats them all around
    value = np.clip(0.86 + 0.05 * (block - 0.5) + 0.03 * f.cloud(50, 50) - 0.04 * run - 0.22 * joint - 0.3 * peel, 0, 1)
    return plain(value, [(0.34, 0.32, 0.29), (0.52, 0.50, 0.46), (0.74, 0.72, 0.68), (0.92, 0.91, 0.88), (1, 1, 0.98)],
                 np.clip(0.6 + 0.1 * f.noise(6, 6) + 0.3 * peel, 0, 1), matte(0.6, 0.95),
                 -0.012 * joint - 0.004 * peel + 0.0015 * f.cloud(20, 20))


def concrete(f):
    """Cast concrete: pores, board marks, stains."""
    board = step(2.0, 0.6, np.abs((f.y % max(8, f.h / 3.0)) - 4))
    pore = step(2.2, 2.6, f.noise(3, 3))
    run = np.clip(f.noise(8, f.h * 1.2), 0, 3)
    value = np.clip(0.62 + 0.08 * f.cloud(70, 50) - 0.06 * run - 0.1 * board - 0.3 * pore, 0, 1)
    return plain(value, [(0.30, 0.29, 0.27), (0.50, 0.49, 0.46), (0.66, 0.65, 0.61), (0.78, 0.77, 0.73)],
                 np.clip(0.7 + 0.1 * f.noise(9, 9), 0, 1), matte(0.75, 0.95), 0.001 * f.cloud(20, 20) - 0.002 * board - 0.003 * pore)


def carvel(f):
    """One painted plank of a smooth hull: seams at its edges, a butt joint now and then, rust weeping from a fastening."""
    p = painted(f)
    edge = np.minimum(f.y, f.h - 1 - f.y)
    seam = step(5.0, 2.5, edge)
    butt = step(2.0, 0.8, np.abs(f.x - f.w * 0.37))
    rust = np.zeros_like(f.x)
    for k in range(6):
        x = f.state.uniform(0, f.w)
        run = step(5, 0.5, np.abs(f.x - x) + f.noise(8, 8)) * step(f.h * 0.95, f.h * 0.3, f.y) * (f.y > f.h * 0.3)
        rust = np.maximum(rust, run * f.state.uniform(0.3, 1))
    p["value"] = p["value"] - 0.12 * np.maximum(seam, butt) - 0.16 * rust - 0.02 * np.clip(f.noise(5, f.h * 2), 0, 3)
    p["height"] = p["height"] - 0.0025 * np.maximum(seam, butt)
    return p


def deck_planks(f):
    """Three scrubbed pine planks with tarred seams."""
    g = grain(f)
    at = (f.v * 3) % 1
    seam = step(0.055, 0.03, np.minimum(at, 1 - at))
    tone = np.array([-0.07, 0.06, 0.0])[np.minimum((f.v * 3).astype(int), 2)]
    stain = step(0.8, 2.0, f.cloud(60, 40))
    value = np.clip(0.5 + 0.3 * g + tone - 0.18 * stain, 0.25, 1) * (1 - 0.9 * seam)
    return plain(value, [(0.07, 0.06, 0.06), (0.30, 0.26, 0.22), (0.52, 0.46, 0.38), (0.70, 0.63, 0.53)],
                 np.clip(0.6 + 0.25 * g - 0.2 * stain, 0, 1), matte(0.5, 0.95), 0.001 * g - 0.003 * seam)


def net(f):
    """Netting wound on a drum: crossing meshes over layers of twine."""
    a, b = (f.x / 8 + f.y / 8) % 1, (f.x / 8 - f.y / 8) % 1
    twine = np.maximum(step(0.22, 0.05, np.abs(a - 0.5)), step(0.22, 0.05, np.abs(b - 0.5)))
    value = np.clip(0.25 + 0.5 * twine + 0.12 * f.cloud(40, 12), 0, 1)
    return plain(value, [(0.12, 0.14, 0.12), (0.5, 0.52, 0.48), (0.9, 0.92, 0.86)], np.clip(1 - twine, 0, 1), [(1, 0.8, 0), (0.5, 0.95, 0)], 0.006 * twine)
