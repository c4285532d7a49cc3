#!/usr/bin/python3
"""Examines models: check_models.py FILE... Names each fault and exits 1 if there is one.

Closed bodies (every edge once each way), mass equal to the water displaced within 2 %, centre of mass over that of buoyancy
within 1 cm, positive metacentric heights, unit normals, no slivers, indices in range, finite texture places, the budget of
triangles and bytes, textures of a power of two, names of nodes that the extras mention.
"""
import json
import pathlib
import struct
import sys

import numpy as np

import physics
from mesh import Mesh

MOST_BYTES = 1_500_000
COMPONENTS = {5121: "u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
SIZES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
# Most triangles of a level; a body's share of the physics' time.
BUDGET, BODY_BUDGET = (40_000, 8_500, 2_000), 300


class File:
    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        self.size = len(data)
        magic, version, length = struct.unpack_from("<III", data)
        assert magic == 0x46546C67 and version == 2 and length == len(data), "not a GLB of glTF 2.0"
        size, kind = struct.unpack_from("<II", data, 12)
        assert kind == 0x4E4F534A
        self.json = json.loads(data[20:20 + size])
        size_of_binary, kind = struct.unpack_from("<II", data, 20 + size)
        assert kind == 0x004E4942
        self.binary = data[28 + size:28 + size + size_of_binary]

    def array(self, accessor):
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        kind = np.dtype(COMPONENTS[a["componentType"]])
        n = SIZES[a["type"]]
        start = view["byteOffset"]
        assert a["count"] * n * kind.itemsize <= view["byteLength"] and start % 4 == 0
        return np.frombuffer(self.binary, kind, a["count"] * n, start).reshape(a["count"], n)

    def node(self, name):
        return next((n for n in self.json["nodes"] if n["name"] == name), None)

    def body(self, name):
        """A body's triangles as a Mesh."""
        primitive = self.json["meshes"][self.node(name)["mesh"]]["primitives"][0]
        p = self.array(primitive["attributes"]["POSITION"]).astype(float)
        return Mesh(p[self.array(primitive["indices"]).reshape(-1, 3)])


def examine_drawn(file):
    faults = []
    for mesh in file.json["meshes"]:
        for primitive in mesh["primitives"]:
            where = mesh["name"]
            p = file.array(primitive["attributes"]["POSITION"]).astype(float)
            i = file.array(primitive["indices"]).reshape(-1)
            if i.max() >= len(p):
                faults.append(f"{where}: index {i.max()} of {len(p)} vertices")
                continue
            t = p[i.reshape(-1, 3)]
            area = np.linalg.norm(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1) / 2
            if not np.isfinite(p).all() or area.min() < 1e-9:
                faults.append(f"{where}: {int((area < 1e-9).sum())} triangles without area")
            if "material" not in primitive:
                continue
            n = file.array(primitive["attributes"]["NORMAL"]).astype(float)
            if np.abs(np.linalg.norm(n, axis=1) - 1).max() > 1e-4:
                faults.append(f"{where}: normals that are not of unit length")
            uv = file.array(primitive["attributes"]["TEXCOORD_0"])
            if not np.isfinite(uv).all() or np.abs(uv).max() > 200:
                faults.append(f"{where}: texture places of {np.abs(uv).max()}")
    return faults


def triangles(file):
    """Triangles of the three levels, all parts together; a part without a level stands with none."""
    count = [0, 0, 0]
    of = lambda node: sum(file.json["accessors"][p["indices"]]["count"] // 3 for p in file.json["meshes"][node["mesh"]]["primitives"])
    for node in file.json["nodes"]:
        if "MSFT_screencoverage" in node.get("extras", {}):
            ids = node.get("extensions", {}).get("MSFT_lod", {}).get("ids", [])
            coverage = node["extras"]["MSFT_screencoverage"]
            assert len(coverage) == len(ids) + 1 and coverage == sorted(coverage, reverse=True)
            for level, one in enumerate([node] + [file.json["nodes"][k] for k in ids]):
                count[level] += of(one)
    return count


def examine_bodies(file, facts):
    faults = []
    bodies = [facts["nodes"].get("collision")] + facts["nodes"]["inside"]
    for name in bodies + [facts["nodes"].get("waterplane")]:
        if name is None:
            continue
        if file.node(name) is None:
            faults.append(f"no node {name}")
            return faults
    for name in filter(None, bodies):
        mesh = file.body(name)
        if not physics.closed(mesh):
            faults.append(f"{name}: is not closed")
        if len(mesh) >= BODY_BUDGET and name == "collision":
            faults.append(f"{name}: {len(mesh)} triangles, {BODY_BUDGET} are too many")
    if facts["kind"] == "fixed":
        return faults
    hull = file.body("collision")
    volume, buoyancy = physics.displaced(hull)
    if abs(volume * physics.WATER / facts["mass_kg"] - 1) > 0.02:
        faults.append(f"mass {facts['mass_kg']} kg, displaced {volume * physics.WATER:.1f} kg")
    centre = np.array(facts["centre_of_mass_m"])
    if np.abs((buoyancy - centre)[[0, 2]]).max() > 0.01:
        faults.append(f"centre of mass {centre}, of buoyancy {buoyancy}: it would not float level")
    across, along = physics.metacentric(hull, centre)
    if across < 0.01 or along < 0.01:
        faults.append(f"metacentric heights {across:.3f} and {along:.3f} m: it would capsize")
    if np.linalg.eigvalsh(np.array(facts["inertia_kgm2"])).min() <= 0:
        faults.append("inertia is not positive")
    area = physics.waterplane(hull)[0]
    plane = file.body("waterplane")
    drawn = np.linalg.norm(np.cross(plane.p[:, 1] - plane.p[:, 0], plane.p[:, 2] - plane.p[:, 0]), axis=1).sum() / 2
    if abs(area / facts["waterplane_m2"] - 1) > 0.02 or abs(drawn / area - 1) > 0.02:
        faults.append(f"waterplane {facts['waterplane_m2']} m2 stated, {area:.3f} of the hull, {drawn:.3f} of the outline")
    return faults


def examine(path):
    """All faults of a file, as texts."""
    try:
        file = File(path)
        root = file.json["nodes"][file.json["scenes"][0]["nodes"][0]]
        facts = root["extras"]["seascape"]
        faults = examine_drawn(file)
        count = triangles(file)
    except (AssertionError, KeyError, ValueError, struct.error) as error:
        return [f"cannot be read: {type(error).__name__} {error}"]
    if file.size >= MOST_BYTES:
        faults.append(f"{file.size} bytes, {MOST_BYTES} are too many")
    for level, (have, most) in enumerate(zip(count, BUDGET)):
        if have > most:
            faults.append(f"level {level}: {have} triangles, at most {most}")
    for image in file.json["images"]:
        start = file.json["bufferViews"][image["bufferView"]]["byteOffset"]
        w, h = struct.unpack_from(">II", file.binary, start + 16)
        if w & (w - 1) or h & (h - 1) or not 64 <= max(w, h) <= 1024:
            faults.append(f"{image['name']}: {w} x {h}")
    for grip in facts.get("grips", []):
        if grip.get("node") and file.node(grip["node"]) is None:
            faults.append(f"grip {grip['name']}: no node {grip['node']}")
    return faults + examine_bodies(file, facts)


if __name__ == "__main__":
    found = [(path, fault) for path in sys.argv[1:] for fault in examine(path)]
    for path, fault in found:
        print(f"{path}: {fault}", file=sys.stderr)
    sys.exit(1 if found or len(sys.argv) < 2 else 0)
