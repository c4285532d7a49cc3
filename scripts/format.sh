#!/bin/bash
# Formats the tracked C++ and GLSL sources by .clang-format. Usage: scripts/format.sh [--check]
# With --check it changes nothing, names each file whose format differs, and fails if there is one.
set -u
cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." || exit 1

# The order of GLSL's includes matters, and clang-format knows GLSL's files by no name of their own.
glsl() { clang-format --assume-filename=shader.cpp --sort-includes=0; }

case "${1:-}" in
  '')
    git ls-files -z -- '*.cpp' '*.h' | xargs -0 clang-format -i || exit 1
    git ls-files -z -- '*.glsl' '*.vert' '*.frag' '*.comp' | while IFS= read -r -d '' file; do
      glsl < "$file" > "$file.new" && cat "$file.new" > "$file"
      rm -f -- "$file.new"
    done
    ;;
  --check)
    faults=$(
      git ls-files -z -- '*.cpp' '*.h' | xargs -0 clang-format --dry-run 2>&1 | sed -n 's/: warning: code should be clang-formatted.*//p'
      git ls-files -z -- '*.glsl' '*.vert' '*.frag' '*.comp' | while IFS= read -r -d '' file; do
        glsl < "$file" | cmp -s - "$file" || printf '%s\n' "$file"
      done
    )
    if [ -n "$faults" ]; then
      printf '%s\n' "$faults" | sort -u
      printf 'These are not formatted by .clang-format; run scripts/format.sh\n'
      exit 1
    fi
    ;;
  *) printf 'format.sh: %s is not an option; it takes --check or nothing\n' "$1" >&2; exit 2 ;;
esac
