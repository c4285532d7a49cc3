#!/bin/bash
# The models of content/ are what their script makes, to the byte, and float as their extras say. A minute: only with
# SEASCAPE_LONG=1, and where there is numpy.
set -u
source_root=$(dirname -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")")
work=$(mktemp -d) || exit 1
trap 'rm -rf -- "$work"' EXIT
fail() { printf 'FAILED: %s\n' "$*" >&2; cat "$work/err" >&2; exit 1; }
says() { grep -qF -- "$1" "$work/err"; }

[ -n "${SEASCAPE_LONG:-}" ] || { printf 'notice: the models are made anew only with SEASCAPE_LONG=1\n' >&2; exit 77; }
python=/usr/bin/python3
"$python" -c 'import numpy' 2> /dev/null || { printf 'notice: no numpy (Debian: python3-numpy); the models are not made anew\n' >&2; exit 77; }
models="$source_root/content/models"
"$python" "$models/make/make.py" --same > "$work/out" 2> "$work/err" || fail "the models are not what make.py makes"
[ "$(wc -l < "$work/out")" -eq "$(ls "$models"/*.glb | wc -l)" ] || fail "a model that no script makes"
"$python" "$models/make/check_models.py" "$models"/*.glb 2> "$work/err" || fail "a faulty model"
# Controls: a crate made 1 cm longer is not the committed one; one that is too heavy for the water that it displaces.
mkdir -p "$work/models" && cp -r "$models/make" "$models/crate.glb" "$work/models/"
sed 's/"mass_kg":70.0/"mass_kg":73.0/' "$models/crate.glb" > "$work/heavy.glb"
"$python" "$work/models/make/check_models.py" "$work/heavy.glb" 2> "$work/err" && fail "control: a heavy crate"
says 'mass 73.0 kg, displaced 70' || fail "control: what is said of the heavy crate"
sed -i 's/size, mass = (0.60, 0.46, 0.84)/size, mass = (0.60, 0.46, 0.85)/' "$work/models/make/cargo.py"
"$python" "$work/models/make/make.py" crate --same > "$work/out" 2> "$work/err" && fail "control: a longer crate"
says 'is not what make.py makes' || fail "control: what is said of the longer crate"
exit 0
