#!/bin/bash
# What ./run and ./check share: packages, disk, lock and build. Sourced by bash; the caller has set `root` (the project's
# folder). Nothing here writes to standard output or reads standard input. Faults end the process with one line and status 1.

say() { printf 'seascape: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

# Debian's own tools first: another cmake further ahead in PATH may be a wrapper or another version.
debian_tool() { if [ -x "/usr/bin/$1" ]; then printf '/usr/bin/%s' "$1"; else printf '%s' "$1"; fi; }

# wanted_packages run|check: the packages of that group; check includes run.
wanted_packages() {
  local group name
  while read -r group name; do
    case "$group" in
      run) printf '%s\n' "$name" ;;
      check) if [ "$1" = check ]; then printf '%s\n' "$name"; fi ;;
    esac
  done < "$root/scripts/packages.txt"
}

# missing_packages run|check: those of the group that dpkg does not report as installed.
missing_packages() {
  local -a wanted
  mapfile -t wanted < <(wanted_packages "$1")
  local installed status name
  installed=$(LC_ALL=C dpkg-query -W -f='${db:Status-Abbrev} ${Package}\n' "${wanted[@]}" 2>/dev/null)
  local have=" "
  while read -r status name; do
    case "$status" in ?i) have+="$name " ;; esac
  done <<< "$installed"
  for name in "${wanted[@]}"; do
    case "$have" in *" $name "*) ;; *) printf '%s\n' "$name" ;; esac
  done
}

# free_mib FOLDER: free space on its file system; empty where that does not say.
free_mib() {
  local folder=$1
  while [ ! -d "$folder" ]; do folder=$(dirname -- "$folder"); done
  LC_ALL=C df -Pm -- "$folder" 2> /dev/null | awk 'NR == 2 && $4 ~ /^[0-9]+$/ { print $4 }'
}

# need_disk FOLDER MIB WHY: ends the process where the folder's file system has less free space than that.
need_disk() {
  local free
  free=$(free_mib "$1")
  if [ -n "$free" ] && [ "$free" -lt "$2" ]; then
    die "$1: $free MiB are free and $3 needs $2 MiB; free some space on that disk and start again"
  fi
}

# apt_get ARGS: apt-get without questions, waiting at most 300 s for dpkg's lock, with no standard input, as root.
apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 apt-get -q -o DPkg::Lock::Timeout=300 \
    -o Dpkg::Use-Pty=0 -o Acquire::Retries=2 "$@" < /dev/null >&2
}

# apt-get update does not wait for the lock of its own lists (the option above is for dpkg's): wait here, as long.
apt_update() {
  local tries=0 log
  log=$(mktemp) || die "no temporary folder can be written; set TMPDIR to one"
  while ! apt_get update 2> >(tee "$log" >&2); do
    if ! grep -q 'Could not get lock' "$log" || [ $((tries += 1)) -ge 60 ]; then
      say "notice: apt-get update had a fault; going on with the package lists that are there"
      break
    fi
    sleep 5
  done
  rm -f -- "$log"
}

# install_packages run|check: installs what is missing of the group, or says exactly how to and ends the process.
install_packages() {
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    say "notice: no apt on this system; scripts/packages.txt names what is needed, in Debian 12's names"
    return 0
  fi
  local -a missing
  mapfile -t missing < <(missing_packages "$1")
  if [ ${#missing[@]} -eq 0 ]; then return 0; fi

  local line="apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
  local -a as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo)
    if ! command -v sudo > /dev/null; then
      die "${#missing[@]} packages are missing and there is no sudo; as root, run: $line"
    fi
    if ! sudo -n true < /dev/null 2> /dev/null; then
      # sudo asks at the terminal itself, so a person can answer; without one nobody can.
      if [ -n "${CI:-}" ] || ! [ -t 2 ] || ! { : < /dev/tty; } 2> /dev/null; then
        die "${#missing[@]} packages are missing and sudo is not allowed here; as root, run: $line"
      fi
      say "${#missing[@]} packages are missing; sudo may ask for your password to install them"
      sudo -v || die "sudo was refused; as root, run: $line"
    fi
  fi
  need_disk /usr $([ "$1" = check ] && echo 2000 || echo 1200) "installing packages"
  say "installing ${#missing[@]} packages: ${missing[*]}"
  apt_update
  apt_get install -y --no-install-recommends --no-remove "${missing[@]}" ||
    die "apt-get could not install the packages; see its message above, then run as root: $line"
  mapfile -t missing < <(missing_packages "$1")
  if [ ${#missing[@]} -ne 0 ]; then die "still missing after apt-get: ${missing[*]}"; fi
}

# newer_than STAMP PATH...: is any file or folder newer than the stamp? A folder's own time shows what was removed.
newer_than() {
  local stamp=$1
  shift
  [ ! -e "$stamp" ] || [ -n "$(find "$@" -newer "$stamp" -print -quit 2> /dev/null)" ]
}

# The sources of the program, and dpkg's record, which changes with every package.
program_sources() {
  local name
  for name in engine platform ocean app shaders cmake CMakeLists.txt CMakePresets.json scripts/packages.txt; do
    if [ -e "$root/$name" ]; then printf '%s\0' "$root/$name"; fi
  done
  if [ -e /var/lib/dpkg/status ]; then printf '/var/lib/dpkg/status\0'; fi
}

# program_is_current: true where the program was built from the sources as they are, in this place.
program_is_current() {
  local stamp="$root/build/release/.seascape_built" place=
  [ -x "$root/build/release/seascape" ] && [ -e "$stamp" ] || return 1
  read -r -d '' place < "$stamp"  # ends at end of file; the path may hold anything but a zero
  [ "$place" = "$root" ] || return 1
  local -a sources
  mapfile -d '' -t sources < <(program_sources)
  ! newer_than "$stamp" "${sources[@]}"
}

# lock_build: one set-up at a time in this project folder; unlock_build gives the lock back (the program must not hold it).
lock_build() {
  mkdir -p -- "$root/build" 2> /dev/null && { exec 9>> "$root/build/.lock"; } 2> /dev/null ||
    die "$root/build: cannot be written; make it yours, or clone the project to a folder that is"
  if ! flock -n 9; then
    say "another ./run or ./check builds here; waiting for it"
    flock 9
  fi
}
unlock_build() { exec 9>&-; }

# configure PRESET: a build folder that was moved or copied is configured afresh, since cmake refuses it otherwise.
configure() {
  local cmake cache="$root/build/$1/CMakeCache.txt" fresh=()
  cmake=$(debian_tool cmake)
  if [ -e "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then fresh=(--fresh); fi
  # Ninja configures again by itself when a CMake file changed, but does not know the presets.
  if [ -e "$cache" ] && [ ${#fresh[@]} -eq 0 ] && [ -e "$root/build/$1/build.ninja" ] &&
    ! newer_than "$cache" "$root/CMakePresets.json"; then return 0; fi

  (cd -- "$root" && "$cmake" --preset "$1" "${fresh[@]}") < /dev/null >&2
}

# build PRESET [TARGET]
build() {
  (cd -- "$root" && "$(debian_tool cmake)" --build --preset "$1" --parallel "$(build_jobs)" ${2:+--target "$2"}) \
    < /dev/null >&2
}

# As many compilers as cores, but no more than memory allows at 1.5 GiB each.
build_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1572864) }' /proc/meminfo 2> /dev/null)
  if [ "${memory:-$cores}" -lt "$cores" ]; then cores=$memory; fi
  if [ "$cores" -lt 1 ]; then cores=1; fi
  printf '%s' "$cores"
}

# build_program [TARGET]: configures and builds with the release preset and notes that the program is current. The note's
# time is from before the build, so that an edit made meanwhile is seen.
build_program() {
  local folder="$root/build/release"
  mkdir -p -- "$folder" || die "$folder: cannot be written; make it yours, or clone the project to a folder that is"
  printf '%s' "$root" > "$folder/.seascape_built.new" || die "$folder: cannot be written; see the message above"
  configure release || die "cmake could not configure the build; see its message above"
  build release "${1:-}" || die "the build failed; see the compiler's message above"
  mv -f -- "$folder/.seascape_built.new" "$folder/.seascape_built"
}
