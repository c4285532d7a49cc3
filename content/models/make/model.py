"""A model: its parts at three levels of detail, its bodies for the physics, and the file they become."""
import random

import numpy as np

import occlusion
import physics
from glb import Glb
from mesh import GRID, Mesh, finish, join
from shapes import Detail, Paint, ears


class Model:
    """parts: what is drawn; each hangs on a pivot and may be turned by the program. bodies: meshes outside the scene."""

    def __init__(self, name, kind, sheets, distances, cell, crease=42.0):
        """distances (m): where the middle and the far level take over, and where nothing is drawn. cell: of occlusion, m."""
        self.name, self.kind, self.sheets, self.distances, self.cell, self.crease = name, kind, sheets, distances, cell, crease
        self.parts, self.materials, self.bodies, self.extras = [], {}, {}, {"kind": kind}
        for sheet in sheets:
            self.materials[sheet.name] = {"sheet": sheet.name}

    def material(self, name, sheet, **options):
        self.materials[name] = {"sheet": sheet, **options}

    def part(self, name, build, pivot=(0, 0, 0), parent=None, axis=None, extras=None):
        """build(detail) gives a Mesh or {material: Mesh} in the model's frame. axis: about which the program turns it."""
        note = dict(extras or {})
        if axis is not None:
            note["axis"] = list(axis)
        self.parts.append({"name": name, "build": build, "pivot": np.asarray(pivot, float), "parent": parent, "note": note})

    def body(self, role, mesh):
        """role: collision, inside_NAME; a closed mesh in the model's frame."""
        p = np.round(mesh.p / GRID) * GRID
        self.bodies[role] = Mesh(p)

    def floats(self, mass_kg, centre_y, inertia, length_m, beam_m):
        """Fills in what the collision hull implies. The mass must be what it displaces; the centre lies over buoyancy's."""
        hull = self.bodies["collision"]
        volume, buoyancy = physics.displaced(hull)
        area, _, _ = physics.waterplane(hull)
        centre = [0.0, centre_y, round(float(buoyancy[2]), 4)]
        across, along = physics.metacentric(hull, centre)
        self.extras.update({
            "mass_kg": mass_kg, "centre_of_mass_m": centre, "inertia_kgm2": [[round(float(x), 2) for x in row] for row in inertia],
            "length_m": length_m, "beam_m": beam_m, "draught_m": round(float(-hull.p[:, :, 1].min()), 3),
            "waterplane_m2": round(area, 4), "displacement_m3": round(volume, 4),
            "gm_m": round(across, 3), "gm_along_m": round(along, 3)})
        outline = physics.loops(hull)
        flat = []
        for ring in outline:
            ring = ring if np.sum(np.cross(ring, np.roll(ring, -1, axis=0))) > 0 else ring[::-1]
            t = ears(ring)
            p = np.stack([ring[:, 0], np.zeros(len(ring)), ring[:, 1]], -1)
            flat.append(Mesh(p[t][:, ::-1]))  # faces up
        self.bodies["waterplane"] = join(flat)

    def levels(self):
        """For each level a list, one entry a part: {material: finished mesh}."""
        out = []
        for level in range(3):
            random_of = random.Random(self.name)
            Paint.dice = random_of
            built = []
            for part in self.parts:
                meshes = part["build"](Detail(level))
                if meshes is None:
                    meshes = {}
                if isinstance(meshes, Mesh):
                    meshes = {self.sheets[0].name: meshes}
                built.append({k: finish(m, self.crease) for k, m in meshes.items() if m is not None and len(m)})
            everything = [m for b in built for m in b.values()]
            if everything and self.cell:
                occlusion.bake(everything, self.cell * (1, 1.5, 2.5)[level])
            out.append(built)
        return out

    def save(self, path):
        """Writes the file and answers the triangles of each level."""
        glb = Glb(self.name)
        textures = {s.name: glb.sheet(s) for s in self.sheets}
        numbers = {}
        for name, m in self.materials.items():
            options = {k: v for k, v in m.items() if k != "sheet"}
            numbers[name] = glb.material(name, textures[m["sheet"]], **options)
        levels = self.levels()
        children, by_name = {None: []}, {}
        for k, part in enumerate(self.parts):
            drawn = [levels[n][k] for n in range(3) if levels[n][k]]
            ids = []
            for n, meshes in enumerate(drawn):
                moved = [(numbers[name], {**m, "p": m["p"] - part["pivot"]}) for name, m in meshes.items()]
                label = part["name"] + ("_mesh" if n == 0 else f"_lod{n}")
                ids.append(glb.node(label, mesh=glb.mesh(label, moved)))
            radius = max(self.radius(m, part["pivot"]) for m in drawn[0].values())
            limits = list(self.distances[:len(drawn)])
            if len(drawn) == 3:
                limits[2] = self.distances[2]
            # Coverage: diameter of the bounding sphere over the height of a picture with a field of view of 90 degrees.
            coverage = [round(float(min(1.0, radius / d)), 5) for d in limits]
            node = glb.nodes[ids[0]]
            node["extras"] = {"MSFT_screencoverage": coverage}
            if len(ids) > 1:
                node["extensions"] = {"MSFT_lod": {"ids": ids[1:]}}
            parent = part["parent"]
            at = part["pivot"] - (self.pivot_of(parent) if parent else 0)
            pivot = glb.node(part["name"], children=[ids[0]], extras=part["note"] or None,
                             translation=[float(x) for x in at] if np.any(at) else None)
            by_name[part["name"]] = pivot
            children.setdefault(parent, []).append(pivot)
        for parent, ids in children.items():
            if parent is not None:
                glb.nodes[by_name[parent]]["children"] += ids
        self.write_bodies(glb)
        root = glb.node(self.name, children=children[None], extras={"seascape": self.extras})
        glb.save(path, root)
        return [sum(len(m["i"]) for part in level for m in part.values()) for level in levels]

    def pivot_of(self, name):
        return next(p["pivot"] for p in self.parts if p["name"] == name)

    @staticmethod
    def radius(m, pivot):
        return float(np.linalg.norm(m["p"] - (m["p"].max(0) + m["p"].min(0)) / 2, axis=1).max())

    def write_bodies(self, glb):
        nodes = {"inside": []}
        for role in sorted(self.bodies):
            mesh = self.bodies[role]
            p, inverse = np.unique(mesh.p.reshape(-1, 3), axis=0, return_inverse=True)
            m = {"p": p, "i": inverse.reshape(-1, 3)}
            glb.node(role, mesh=glb.mesh(role, [(None, m)]))
            if role.startswith("inside"):
                nodes["inside"].append(role)
            else:
                nodes[role] = role
        self.extras["nodes"] = nodes
