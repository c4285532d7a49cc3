#!/bin/bash
# Proves the headset against a real runtime of OpenXR: runs tests_headset in a root of Debian 13 with Monado, whose simulated
# headset needs no screen. Debian 12 has no runtime. ./check --all runs this. Needs root, mmdebstrap and, once, the network.
# Usage: scripts/headset_proof.sh [--build FOLDER] [--root FOLDER] [--only FILTER] [--fresh]
set -u
root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
. "$root/scripts/setup.sh"
. "$root/scripts/driver.sh"
usage() {
  cat << 'EOT'
Usage: scripts/headset_proof.sh [--build FOLDER] [--root FOLDER] [--only FILTER] [--fresh]
  --build FOLDER  where tests_headset and seascape were built (build/release if not given)
  --root FOLDER   where the root of Debian 13 is (headset_root in the user's cache if not given); made when it is not there
  --only FILTER   only these tests (--gtest_filter)
  --fresh         make the root anew
Status 0 where all tests passed, 77 where they cannot run here, for a reason that one line says.
EOT
}
# What the root is made of: the runtime, its tools, the loader and its validation layer; a driver and Vulkan's own layers; a
# screen for the program's windows.
packages=(libopenxr1-monado monado-service monado-cli libopenxr-loader1 openxr-layer-corevalidation
  mesa-vulkan-drivers libvulkan1 vulkan-validationlayers xvfb xdotool)
skip() { say "notice: headset proof skipped: $*"; exit 77; }

build="$root/build/release" bare='' only='*' fresh=''
while [ $# -gt 0 ]; do
  case "$1" in
    --build | --root | --only)
      if [ -z "${2:-}" ]; then say "headset_proof: $1 wants a value"; exit 2; fi
      case "$1" in --build) build=$2 ;; --root) bare=$2 ;; --only) only=$2 ;; esac
      shift
      ;;
    --fresh) fresh=yes ;;
    --help | -h) usage; exit 0 ;;
    *) say "headset_proof: '$1' is not an option; scripts/headset_proof.sh --help lists them"; exit 2 ;;
  esac
  shift
done
if [ -z "$bare" ]; then bare="$(seascape_cache)/headset_root"; fi
case "$bare" in /*/*) ;; *) say "headset_proof: --root $bare: give an absolute path below a folder"; exit 2 ;; esac

# can_run: whether this machine lets us make and enter a root.
can_run() {
  if [ "$(id -u)" -ne 0 ]; then skip "only root can make and enter a root; start it with sudo"; fi
  if ! command -v unshare > /dev/null || ! unshare --mount --pid --fork --propagation private true 2> /dev/null; then
    skip "this machine does not let root have a mount namespace (a container without CAP_SYS_ADMIN?)"
  fi
}

# mirror_of_debian_13: the first mirror that has it; empty, with status 1, where none answers.
mirror_of_debian_13() {
  local mirror
  while read -r mirror; do
    if timeout 60 env LC_ALL=C.UTF-8 /usr/lib/apt/apt-helper -q -o Acquire::Retries=1 -o Acquire::http::Timeout=20 \
      -o Acquire::https::Timeout=20 download-file "$mirror/dists/trixie/InRelease" "$work/InRelease" > /dev/null 2>&1; then
      printf '%s' "$mirror"
      return 0
    fi
  done < <(debian_mirrors)
  return 1
}

# make_root: in a folder of its own beside $bare, then renamed, so that one that was interrupted is never taken for whole.
make_root() {
  local free mirror new="$bare.new" begin
  command -v mmdebstrap > /dev/null || skip "mmdebstrap is missing; run: apt-get install mmdebstrap"
  mkdir -p -- "$(dirname -- "$bare")" || skip "$bare: cannot be written; set XDG_CACHE_HOME to another folder"
  free=$(free_mib "$bare")
  if [ "${free:-2000}" -lt 2000 ]; then skip "$bare: $free MiB are free and a root needs 2000 MiB"; fi
  mirror=$(mirror_of_debian_13) || skip "no mirror of Debian answers, and there is no root in $bare yet"
  say "making a root of Debian 13 with Monado in $bare (700 MB, once)"
  begin=$(date +%s)
  # A mirror that is a copy of some day needs this system's settings for dates.
  local -a options=()
  local line
  while read -r line; do options+=("--aptopt=$line"); done < <(apt-config dump |
    grep -E '^Acquire::(Check-Valid-Until|Check-Date|http::Proxy|https::Proxy) ')
  rm -rf --one-file-system -- "$new" "$bare"
  if ! mmdebstrap --quiet --variant=minbase --format=directory "${options[@]}" \
    --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/locale/*' \
    --include="$(IFS=,; printf '%s' "${packages[*]}")" trixie "$new" "deb $mirror trixie main" < /dev/null > "$work/log" 2>&1; then
    tail -n 20 "$work/log" >&2
    rm -rf --one-file-system -- "$new"
    die "mmdebstrap could not make $bare; see its message above"
  fi
  printf '%s\n' "${packages[@]}" > "$new/.made" && mv -T -- "$new" "$bare" || die "$bare: cannot be written"
  say "made in $(($(date +%s) - begin)) s"
}

# copy_libraries: those of this system that the programs need and the root does not have. What it has is newer and its own.
copy_libraries() {
  local name arrow file rest have
  mkdir -p -- "$bare/tmp/lib" || return 1
  while read -r name arrow file rest; do
    if [ "$arrow" != '=>' ] || [ ! -e "$file" ]; then continue; fi
    have=("$bare"/usr/lib/*/"$name")
    if [ ! -e "${have[0]}" ]; then cp -L -- "$file" "$bare/tmp/lib/$name" || return 1; fi
  done < <(ldd "$build/tests_headset" "$build/seascape")
}

# run_inside: in a mount and process namespace of its own, so that no mount and no process outlives it.
run_inside() {
  mount -t tmpfs tmpfs "$bare/tmp" && mount --rbind /dev "$bare/dev" && mount -t proc proc "$bare/proc" || return 1
  mkdir -p -- "$bare$root" "$bare/tmp/home" && mount --bind "$root" "$bare$root" &&
    mount -o remount,bind,ro "$bare$root" || return 1
  copy_libraries || return 1
  # The driver is the root's own, whatever this system draws with.
  chroot "$bare" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/tmp/home LC_ALL=C.UTF-8 \
    LD_LIBRARY_PATH=/tmp/lib "$build/tests_headset" --gtest_brief=0 --gtest_filter="$only" < /dev/null
}

if [ -n "${SEASCAPE_PROOF_INSIDE:-}" ]; then run_inside; exit; fi

can_run
for program in tests_headset seascape; do
  if [ ! -x "$build/$program" ]; then die "$build/$program is not there; build it first (./check does)"; fi
done
build=$(readlink -f -- "$build")
if [ "$("$build/tests_headset" --gtest_list_tests --gtest_filter="$only" | wc -l)" -lt 2 ]; then die "headset_proof: no test is called $only"; fi
work=$(mktemp -d) || die "no temporary folder can be written; set TMPDIR to one"
trap 'rm -rf -- "$work"' EXIT
mkdir -p -- "$(dirname -- "$bare")" 2> /dev/null && { exec 8>> "$bare.lock"; } 2> /dev/null ||
  skip "$bare: cannot be written; set XDG_CACHE_HOME to another folder"
flock 8
if [ -n "$fresh" ] || [ "$(cat -- "$bare/.made" 2> /dev/null)" != "$(printf '%s\n' "${packages[@]}")" ]; then make_root; fi
exec 8>&-
SEASCAPE_PROOF_INSIDE=yes unshare --mount --pid --fork --kill-child --propagation private -- \
  "$0" --build "$build" --root "$bare" --only "$only"
