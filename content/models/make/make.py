#!/usr/bin/python3
"""Makes content/models/*.glb: make.py [NAME...] [--out DIR] [--check] [--same]. Needs Debian's python3-numpy, nothing else.

The same bytes each run. --check examines the files after they are made; --same compares what would be made with the files that
are there, writes nothing and exits 1 where they differ.
"""
import argparse
import importlib
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

# Model name: the module and the function that build it.
MODELS = {"rowing_boat": ("rowing_boat", "build"), "buoy_lateral_port": ("buoys", "port"),
          "buoy_lateral_starboard": ("buoys", "starboard"), "buoy_mooring": ("buoys", "mooring"), "crate": ("cargo", "crate"),
          "barrel": ("cargo", "barrel"), "pier": ("pier", "build"), "lighthouse": ("shore", "lighthouse"),
          "breakwater": ("shore", "breakwater"),
          "fishing_boat": ("fishing_boat", "build"), "yacht": ("yacht", "build"),
          "rib": ("rib", "build"), "wreck": ("wreck", "build"), "wigley": ("wigley", "build"),
          "diving_bell": ("dry_rooms", "diving_bell"), "undersea_room": ("dry_rooms", "undersea_room"),
          "porthole_barge": ("dry_rooms", "porthole_barge"), "aquarium_hall": ("dry_rooms", "aquarium_hall"),
          "harbour_lines": ("moorings", "build")}


def make(name, folder):
    module, function = MODELS[name]
    model = getattr(importlib.import_module(module), function)()
    path = folder / f"{name}.glb"
    return path, model.save(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="models to make; all if none is named")
    parser.add_argument("--out", type=pathlib.Path, default=HERE.parent, metavar="DIR")
    parser.add_argument("--check", action="store_true", help="examine the files that were made")
    parser.add_argument("--same", action="store_true", help="compare with the files in DIR instead of writing them")
    options = parser.parse_args()
    for name in options.names:
        if name not in MODELS:
            parser.error(f"{name}: no such model; there are {', '.join(MODELS)}")
    faults = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) if options.same else options.out
        folder.mkdir(parents=True, exist_ok=True)
        for name in options.names or MODELS:
            path, triangles = make(name, folder)
            print(f"{name}: triangles {triangles}, {path.stat().st_size} bytes", flush=True)
            if options.check:
                from check_models import examine
                for fault in examine(path):
                    print(f"{path}: {fault}", file=sys.stderr)
                    faults += 1
            if options.same:
                there = options.out / path.name
                if not there.exists() or there.read_bytes() != path.read_bytes():
                    print(f"{there}: is not what {pathlib.Path(__file__).name} makes; make it anew and commit it", file=sys.stderr)
                    faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
