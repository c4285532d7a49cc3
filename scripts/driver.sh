#!/bin/bash
# The Vulkan driver: where no hardware GPU answers, Mesa 25's software driver instead of Debian 12's Mesa 22.3, which draws
# multiview wrongly. One package is fetched from bookworm-backports by apt, with its signature checked, into the user's own
# cache; nothing installed changes and no root is needed. Sourced by ./run and ./check (use_driver); run by itself it prints
# the driver's ICD file: `export VK_DRIVER_FILES="$(scripts/driver.sh)"`.

driver_version=25                    # the first major version known to be right
driver_package=mesa-vulkan-drivers

# seascape_cache: the user's cache folder. A relative XDG_CACHE_HOME is ignored (XDG base directory specification 0.8); a
# user without a home of their own gets a folder in the build.
seascape_cache() {
  case "${XDG_CACHE_HOME:-}" in
    /*) printf '%s/seascape' "$XDG_CACHE_HOME"; return ;;
  esac
  if [ -n "${HOME:-}" ] && mkdir -p -- "$HOME/.cache" 2> /dev/null && [ -w "$HOME/.cache" ]; then
    printf '%s/.cache/seascape' "$HOME"
  else
    printf '%s/build/cache' "$root"
  fi
}

# json_string TEXT: as a JSON string. Paths hold any byte but zero; quotes, backslashes and control characters are escaped.
json_string() {
  local text=$1 out= character code i LC_ALL=C
  for ((i = 0; i < ${#text}; i++)); do
    character=${text:i:1}
    case "$character" in
      '"' | '\') out+="\\$character" ;;
      [[:cntrl:]]) printf -v code '\\u%04x' "'$character"; out+=$code ;;
      *) out+=$character ;;
    esac
  done
  printf '"%s"' "$out"
}

# icd_json LIBRARY: the text of an ICD file. The package's own names the library without a folder, and the loader then
# finds the installed 22.3 in silence; so the path here is absolute.
icd_json() {
  printf '{"file_format_version": "1.0.0", "ICD": {"api_version": "1.3.0", "library_path": %s}}\n' "$(json_string "$1")"
}

# mesa_major ICD: the major version of the Mesa software driver that answers through this ICD file; empty if none does.
mesa_major() {
  VK_DRIVER_FILES=$1 VK_ICD_FILENAMES=$1 LC_ALL=C timeout 60 vulkaninfo --summary 2> /dev/null < /dev/null |
    sed -n 's/^[[:space:]]*driverInfo[[:space:]]*= Mesa \([0-9][0-9]*\)\..*/\1/p' | head -n 1
}

# hardware_answers: does a GPU that is not a software one answer Vulkan? Without a device node none can, and that is known at
# once. With one, Vulkan is asked, and the answer kept until the nodes or the installed drivers change.
hardware_answers() {
  local nodes
  nodes=$(LC_ALL=C ls -d /dev/dri/renderD* /dev/nvidia[0-9]* /dev/dxg /dev/kgsl-3d0 /dev/mali0 2> /dev/null)
  if [ -z "$nodes" ]; then return 1; fi
  local key known="$1/hardware" answer
  key=$(LC_ALL=C ls -ln --time-style=+%s.%N $nodes /usr/share/vulkan/icd.d/* /etc/vulkan/icd.d/* 2> /dev/null; id -G)
  if [ -r "$known" ] && { read -r answer && [ "$(cat)" = "$key" ]; } < "$known"; then [ "$answer" = yes ]; return; fi
  command -v vulkaninfo > /dev/null || return 1
  answer=no
  if LC_ALL=C timeout 60 vulkaninfo --summary 2> /dev/null < /dev/null |
    grep -q 'deviceType[[:space:]]*= PHYSICAL_DEVICE_TYPE_\(DISCRETE\|INTEGRATED\|VIRTUAL\)_GPU'; then answer=yes; fi
  { mkdir -p -- "$1" && printf '%s\n%s\n' "$answer" "$key" > "$known.$$.tmp" && mv -f -- "$known.$$.tmp" "$known"; } 2> /dev/null
  [ "$answer" = yes ]
}

# driver_is_whole FOLDER: is the library there, and as long as when it was verified? Leaves its path in driver_library.
driver_is_whole() {
  local name size
  [ -r "$1/verified" ] && read -r size name < "$1/verified" || return 1
  driver_library="$1/$name"
  [ -n "$name" ] && [ "$(stat -c %s -- "$driver_library" 2> /dev/null)" = "$size" ]
}

# debian_mirrors: where this system gets Debian 12 from, then Debian's own address.
debian_mirrors() {
  local standard=http://deb.debian.org/debian uri
  uri=$(LC_ALL=C apt-get indextargets --no-release-info --format '$(REPO_URI)' 'Created-By: Packages' 'Release: bookworm' \
    2> /dev/null < /dev/null | grep -m 1 -E '^(https?|file|copy|mirror\+https?)://?')
  uri=${uri%/}
  if [ -n "$uri" ] && [ "$uri" != "$standard" ]; then printf '%s\n' "$uri"; fi
  printf '%s\n' "$standard"
}

# fetch_driver FOLDER: downloads, unpacks and verifies the driver in a folder of its own beside FOLDER, then renames it to
# FOLDER. Status 1 where that could not be done; FOLDER is then as before.
fetch_driver() {
  local folder=$1 work mirror architecture
  architecture=$(dpkg --print-architecture) || return 1
  work=$(mktemp -d -- "$folder.XXXXXX.tmp") || return 1
  mkdir -p -- "$work/parts" "$work/lists/partial" "$work/cache/archives/partial" "$work/unpacked" "$work/new" || return 1
  local got=
  while read -r mirror; do
    printf 'Types: deb\nURIs: %s\nSuites: bookworm-backports\nComponents: main\nArchitectures: %s\nSigned-By: %s\n' \
      "$mirror" "$architecture" /usr/share/keyrings/debian-archive-keyring.gpg > "$work/parts/backports.sources"
    if (cd -- "$work" && driver_apt update && driver_apt download "$driver_package/bookworm-backports"); then
      got=yes
      break
    fi
  done < <(debian_mirrors)
  local library=
  if [ -n "$got" ] && dpkg-deb -x "$work/$driver_package"_*.deb "$work/unpacked"; then
    library=$(find "$work/unpacked/usr/lib" -name libvulkan_lvp.so -print -quit)
  fi
  local ok=
  if [ -n "$library" ] && mv -- "$library" "$work/new/" && cp -- "$work/unpacked/usr/share/doc/$driver_package/copyright" "$work/new/"; then
    icd_json "$work/new/libvulkan_lvp.so" > "$work/new/lvp_icd.json"
    local major
    major=$(mesa_major "$work/new/lvp_icd.json")
    if [ "${major:-0}" -ge "$driver_version" ]; then
      rm -f -- "$work/new/lvp_icd.json"
      printf '%s libvulkan_lvp.so\n' "$(stat -c %s -- "$work/new/libvulkan_lvp.so")" > "$work/new/verified"
      rm -rf -- "$folder" && mv -T -- "$work/new" "$folder" && ok=yes
    else
      say "notice: the driver from bookworm-backports reports Mesa '${major:-none}', not $driver_version"
    fi
  fi
  rm -rf -- "$work"
  [ -n "$ok" ]
}

# driver_apt ARGS: apt-get with lists and cache of its own in the current folder; only signed packages. The folders are given
# as options, which take any character. Hooks of other programs are cleared; the system's own proxy settings hold.
driver_apt() {
  local -a options=(-o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$PWD/parts"
    -o "Dir::State::Lists=$PWD/lists" -o "Dir::Cache=$PWD/cache" -o Acquire::Languages=none
    -o Acquire::AllowInsecureRepositories=false -o APT::Get::AllowUnauthenticated=false -o APT::Update::Error-Mode=any
    -o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20)
  # As root apt would hand the download to a user who may not write here.
  if [ "$(id -u)" -eq 0 ]; then options+=(-o APT::Sandbox::User=root); fi
  printf '#clear APT::Update::%s;\n' Pre-Invoke Post-Invoke Post-Invoke-Success > apt.conf
  timeout 300 env LC_ALL=C.UTF-8 apt-get -q -c apt.conf "${options[@]}" "$@" < /dev/null >&2
}

# prepare_driver: leaves in driver_icd the ICD file of a right software driver, fetching it the first time; empty, with a
# notice, where there is none. Needs no network once the driver is there.
prepare_driver() {
  driver_icd=
  local cache folder
  cache=$(seascape_cache)
  folder="$cache/driver"
  if hardware_answers "$cache"; then return 0; fi
  if ! driver_is_whole "$folder"; then
    # Later releases of Debian bring a right driver themselves.
    local installed
    installed=$(LC_ALL=C dpkg-query -W -f='${Version}\n' "$driver_package" 2> /dev/null | head -n 1)
    if [ "${installed%%.*}" -ge "$driver_version" ] 2> /dev/null; then return 0; fi
    local without="the installed driver draws each eye by itself, which is slower"
    case "$folder" in
      *:*) say "notice: $cache: the Vulkan loader takes the colon for a separator; set XDG_CACHE_HOME to another folder; $without"; return 0 ;;
    esac
    if ! mkdir -p -- "$cache" 2> /dev/null || ! { exec 8>> "$cache/.lock"; } 2> /dev/null; then
      say "notice: $cache: cannot be written, so Mesa $driver_version is not fetched; set XDG_CACHE_HOME; $without"
      return 0
    fi
    flock 8
    if ! driver_is_whole "$folder"; then
      rm -rf -- "$folder".*.tmp  # what an interrupted run left
      local free
      free=$(free_mib "$cache")
      if [ "${free:-200}" -lt 200 ]; then
        say "notice: $cache: $free MiB are free and Mesa $driver_version needs 200 MiB; $without"
        exec 8>&-
        return 0
      fi
      say "no hardware GPU answers; fetching Mesa $driver_version's software driver from bookworm-backports (11 MB, once)"
      if ! fetch_driver "$folder"; then
        say "notice: Mesa $driver_version could not be fetched from bookworm-backports (see above); $without"
        exec 8>&-
        return 0
      fi
    fi
    exec 8>&-
    driver_is_whole "$folder" || return 0
  fi
  local text
  text=$(icd_json "$driver_library")
  driver_icd="$folder/lvp_icd.json"
  if [ "$(cat -- "$driver_icd" 2> /dev/null)" != "$text" ]; then  # new, or the cache was moved
    printf '%s\n' "$text" > "$driver_icd.$$.tmp" && mv -f -- "$driver_icd.$$.tmp" "$driver_icd" || driver_icd=
  fi
}

# use_driver: exports the driver to the programs started from here. What the user chose stands.
use_driver() {
  if [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]; then return 0; fi
  prepare_driver
  if [ -n "$driver_icd" ]; then export VK_DRIVER_FILES=$driver_icd VK_ICD_FILENAMES=$driver_icd; fi
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
  set -u
  root=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
  . "$root/scripts/setup.sh"
  prepare_driver
  [ -n "$driver_icd" ] && printf '%s\n' "$driver_icd"
fi
