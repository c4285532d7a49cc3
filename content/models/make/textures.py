"""Texture sheets: procedural surfaces in horizontal strips that repeat along their length, written as palette PNGs.

A strip's colour, its roughness and its height come from painted fields of 0..1. Colours and roughness are quantised to a
palette, so that a sheet of 1024 x 512 stays below 300 kB an image. Base colours are light: the vertex colour tints them.
"""
import struct
import zlib

import numpy as np


class Skin:
    """Where a strip lies in its sheet: metres a repeat along u, v0..v1, height in metres. tiles: repeats across too."""

    def __init__(self, length_m, height_m, v0, v1, tiles=False):
        self.length_m, self.height_m, self.v0, self.v1, self.tiles = length_m, height_m, v0, v1, tiles


class Field:
    """Random fields of one strip, repeating in both directions."""

    def __init__(self, seed, h, w):
        self.state, self.h, self.w = np.random.RandomState(seed), h, w
        self.y, self.x = np.mgrid[0:h, 0:w].astype(float)
        self.v = (self.y + 0.5) / h  # across the strip, 0..1

    def noise(self, along, across, power=1.0):
        """Smooth noise, mean 0 and deviation 1, with features of about along x across pixels."""
        white = self.state.standard_normal((self.h, self.w))
        ky = np.fft.fftfreq(self.h)[:, None] * across * power
        kx = np.fft.rfftfreq(self.w)[None, :] * along * power
        soft = np.fft.irfft2(np.fft.rfft2(white) * np.exp(-4.0 * (kx * kx + ky * ky)), s=(self.h, self.w))
        return (soft - soft.mean()) / (soft.std() + 1e-9)

    def cloud(self, along, across, octaves=4):
        """Noise of several sizes, each half as large and 0.6 times as strong."""
        out = sum(0.6 ** k * self.noise(along / 2 ** k, across / 2 ** k) for k in range(octaves))
        return (out - out.mean()) / out.std()

    def cells(self, count, stretch=1.0):
        """Distances (pixels) to the nearest and second nearest of `count` random points, and the nearest's number."""
        px, py = self.state.uniform(0, self.w, count), self.state.uniform(0, self.h, count)
        best = np.full((2, self.h, self.w), 1e9)
        number = np.zeros((self.h, self.w), int)
        for k in range(count):
            dx = np.abs(self.x - px[k])
            dy = np.abs(self.y - py[k])
            d = np.hypot(np.minimum(dx, self.w - dx), np.minimum(dy, self.h - dy) * stretch)
            nearer = d < best[0]
            best[1] = np.where(nearer, best[0], np.minimum(best[1], d))
            number = np.where(nearer, k, number)
            best[0] = np.where(nearer, d, best[0])
        return best[0], best[1], number


def step(edge0, edge1, x):
    t = np.clip((x - edge0) / (edge1 - edge0), 0, 1)
    return t * t * (3 - 2 * t)


class Sheet:
    """A set of textures as high as its strips together. Strips: (name, height in pixels, painter[, pixels a metre])."""

    def __init__(self, name, usual, width, strips, seed=1):
        self.name, self.width = name, width
        self.height = sum(strip[1] for strip in strips)
        self.skins = {}
        colour, rough, normal = [], [], []
        self.palettes = [], []
        levels = min(48, 256 // len(strips))
        top = 0
        for k, (strip, h, painter, *own) in enumerate(strips):
            density = own[0] if own else usual
            tiles = len(strips) == 1
            margin = 0 if tiles else min(3, h // 8)
            field = Field(seed * 100 + k, h, width)
            p = painter(field)
            self.skins[strip] = Skin(width / density, (h - 2 * margin) / density, (top + margin) / self.height,
                                     (top + h - margin) / self.height, tiles)
            for images, palette, value, stops in ((colour, self.palettes[0], p["value"], p["colours"]),
                                                  (rough, self.palettes[1], p["rough"], p["orm"])):
                n = levels if images is colour else levels // 2
                q = np.clip(np.floor(np.clip(value, 0, 1) * n), 0, n - 1).astype(int)
                images.append(q + k * n)
                palette.append(ramp(stops, n))
            normal.append(slopes(p["height"] * density, tiles))
            top += h
        self.colour, self.rough = np.concatenate(colour), np.concatenate(rough)
        self.normal = np.concatenate(normal)

    def __getitem__(self, strip):
        return self.skins[strip]

    def images(self):
        """Base colour, occlusion-roughness-metallic and normal as PNG bytes."""
        colour = np.concatenate(self.palettes[0])
        orm = np.concatenate(self.palettes[1])
        index, table = normal_palette(self.normal)
        return palette_png(self.colour, colour), palette_png(self.rough, orm), palette_png(index, table)


def ramp(stops, levels):
    """Colours (levels, 3) 0..255 between evenly spread stops of 0..1."""
    stops = np.asarray(stops, float)
    t = np.linspace(0, len(stops) - 1, levels)
    return np.stack([np.interp(t, np.arange(len(stops)), stops[:, k]) for k in range(3)], -1) * 255


def slopes(height_px, tiles):
    """Slopes of a height in pixels: along u and, with glTF's v downwards, up the image."""
    du = (np.roll(height_px, -1, 1) - np.roll(height_px, 1, 1)) / 2
    pad = np.pad(height_px, ((1, 1), (0, 0)), mode="wrap" if tiles else "edge")
    return np.stack([-du, (pad[2:] - pad[:-2]) / 2], -1)


# Steps of the normal's x and y, finer near level: 15 x 15 of them fill a palette.
STEPS = np.array([-0.7, -0.5, -0.34, -0.22, -0.13, -0.07, -0.03, 0, 0.03, 0.07, 0.13, 0.22, 0.34, 0.5, 0.7])


def normal_palette(slope):
    n = slope / np.sqrt(1 + (slope ** 2).sum(-1, keepdims=True))
    middle = (STEPS[1:] + STEPS[:-1]) / 2
    ix, iy = np.searchsorted(middle, n[..., 0]), np.searchsorted(middle, n[..., 1])
    x, y = np.meshgrid(STEPS, STEPS, indexing="ij")
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0.02))
    table = np.stack([x, y, z], -1).reshape(-1, 3)
    table /= np.linalg.norm(table, axis=1, keepdims=True)
    return ix * len(STEPS) + iy, np.round((table * 0.5 + 0.5) * 255)


def palette_png(index, palette):
    h, w = index.shape
    palette = np.clip(np.round(palette), 0, 255).astype(np.uint8)
    used, fresh = np.unique(index, return_inverse=True)
    rows = np.concatenate([np.zeros((h, 1), np.uint8), fresh.reshape(h, w).astype(np.uint8)], axis=1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 3, 0, 0, 0)) +
            chunk(b"PLTE", palette[used].tobytes()) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))
