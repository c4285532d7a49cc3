"""Writes glTF 2.0 binary files (.glb): the same bytes for the same content."""
import json
import struct

import numpy as np


class Glb:
    def __init__(self, name):
        self.name = name
        self.bytes = bytearray()
        self.views, self.accessors, self.meshes, self.nodes = [], [], [], []
        self.materials, self.textures, self.images = [], [], []

    def view(self, data, target=None):
        while len(self.bytes) % 4:
            self.bytes.append(0)
        entry = {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)}
        if target:
            entry["target"] = target
        self.bytes += data
        self.views.append(entry)
        return len(self.views) - 1

    def accessor(self, array, kind, component, target, bounds=False, normalized=False):
        entry = {"bufferView": self.view(array.tobytes(), target), "componentType": component, "count": len(array), "type": kind}
        if normalized:
            entry["normalized"] = True
        if bounds:
            entry["min"] = [float(x) for x in array.min(0)]
            entry["max"] = [float(x) for x in array.max(0)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def sheet(self, sheet):
        """The sheet's textures: their numbers for base colour, occlusion-roughness-metallic and normal."""
        first = len(self.textures)
        for kind, png in zip(("colour", "orm", "normal"), sheet.images()):
            self.images.append({"bufferView": self.view(png), "mimeType": "image/png", "name": f"{sheet.name}_{kind}"})
            self.textures.append({"sampler": 0, "source": len(self.images) - 1})
        return first, first + 1, first + 2

    def material(self, name, textures, double_sided=False, emissive=None, alpha=None):
        colour, orm, normal = textures
        entry = {"name": name,
                 "pbrMetallicRoughness": {"baseColorTexture": {"index": colour}, "metallicRoughnessTexture": {"index": orm}},
                 "normalTexture": {"index": normal}, "occlusionTexture": {"index": orm}}
        if emissive:
            entry["emissiveFactor"] = list(emissive)
        if alpha is not None:
            entry["alphaMode"] = "BLEND"
            entry["pbrMetallicRoughness"]["baseColorFactor"] = [1, 1, 1, alpha]
        if double_sided:
            entry["doubleSided"] = True
        self.materials.append(entry)
        return len(self.materials) - 1

    def mesh(self, name, parts):
        """A mesh of (material or None, finished mesh) pairs. Without a material only positions are written."""
        primitives = []
        for material, m in parts:
            place = m["p"].astype("<f4")
            attributes = {"POSITION": self.accessor(place, "VEC3", 5126, 34962, bounds=True)}
            if material is not None:
                attributes["NORMAL"] = self.accessor(m["n"].astype("<f4"), "VEC3", 5126, 34962)
                attributes["TEXCOORD_0"] = self.accessor(m["uv"].astype("<f4"), "VEC2", 5126, 34962)
                colour = np.concatenate([np.round(m["c"] * 255), np.full((len(place), 1), 255)], 1).astype(np.uint8)
                attributes["COLOR_0"] = self.accessor(colour, "VEC4", 5121, 34962, normalized=True)
            small = len(place) < 65535
            index = m["i"].reshape(-1).astype("<u2" if small else "<u4")
            entry = {"attributes": attributes, "indices": self.accessor(index, "SCALAR", 5123 if small else 5125, 34963)}
            if material is not None:
                entry["material"] = material
            primitives.append(entry)
        self.meshes.append({"name": name, "primitives": primitives})
        return len(self.meshes) - 1

    def node(self, name, **entries):
        self.nodes.append({"name": name, **{k: v for k, v in entries.items() if v is not None}})
        return len(self.nodes) - 1

    def save(self, path, root):
        while len(self.bytes) % 4:
            self.bytes.append(0)
        document = {"asset": {"version": "2.0", "generator": "Seascape content/models/make/make.py"},
                    "extensionsUsed": ["MSFT_lod"], "scene": 0, "scenes": [{"name": self.name, "nodes": [root]}],
                    "nodes": self.nodes, "meshes": self.meshes, "materials": self.materials, "textures": self.textures,
                    "images": self.images, "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
                    "accessors": self.accessors, "bufferViews": self.views, "buffers": [{"byteLength": len(self.bytes)}]}
        if not any("MSFT_lod" in n.get("extensions", {}) for n in self.nodes):
            del document["extensionsUsed"]
        text = json.dumps(document, separators=(",", ":"), ensure_ascii=True).encode()
        text += b" " * (-len(text) % 4)
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.bytes), 0x004E4942) + bytes(self.bytes)
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body)
