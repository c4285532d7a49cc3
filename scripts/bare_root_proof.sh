#!/bin/bash
# Proves ./run and ./check in a bare Debian 12 root: nothing is in it but what mmdebstrap's smallest variant brings, so a
# package missing from scripts/packages.txt shows. Needs root, mmdebstrap, git and the network.
# Usage: scripts/bare_root_proof.sh [--user root|sudo] [--offline] [--only run|check] [--root FOLDER] [--keep] [--fresh]
set -u
project=$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")
usage() {
  cat << 'EOF'
Usage: scripts/bare_root_proof.sh [--user root|sudo] [--offline] [--only run|check] [--root FOLDER] [--keep] [--fresh]
  --user WHO     root, or a user with passwordless sudo (root if not given)
  --offline      no network: a second run in a root that an earlier proof kept
  --only WHAT    just ./run or just ./check
  --root FOLDER  where the root is (if not given /var/tmp/seascape_bare_root_WHO); made when it is not there
  --keep         leave the root for --offline
  --fresh        remove a root left there and begin from nothing
The committed state of this project (HEAD) is cloned into the root, into a folder with a space in its name.
EOF
}
stop() { printf 'bare_root_proof: %s\n' "$*" >&2; exit "${2:-1}"; }

who=root offline='' only='run check' bare='' keep='' fresh=''
while [ $# -gt 0 ]; do
  case "$1" in
    --user) shift; case "${1:-}" in root | sudo) who=$1 ;; *) usage >&2; exit 2 ;; esac ;;
    --only) shift; case "${1:-}" in run | check) only=$1 ;; *) usage >&2; exit 2 ;; esac ;;
    --root) shift; bare=${1:-} ;;
    --offline) offline=yes keep=yes ;;
    --keep) keep=yes ;;
    --fresh) fresh=yes ;;
    --help | -h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
[ "$(id -u)" -eq 0 ] || stop "only root can make and enter a root; start it with sudo"
command -v mmdebstrap > /dev/null || stop "mmdebstrap is missing; run: apt-get install mmdebstrap"
bare=${bare:-/var/tmp/seascape_bare_root_$who}
case "$bare" in /*/*) ;; *) stop "--root $bare: give an absolute path below a folder" ;; esac

# Everything below runs in a mount namespace of its own, so that no mount outlives it and removing the root is safe.
if [ -z "${SEASCAPE_PROOF_INSIDE:-}" ]; then
  arguments=(--user "$who" --root "$bare")
  if [ "$only" = run ] || [ "$only" = check ]; then arguments+=(--only "$only"); fi
  if [ -n "$offline" ]; then arguments+=(--offline); fi
  if [ -n "$fresh" ]; then rm -rf --one-file-system -- "$bare"; fi
  SEASCAPE_PROOF_INSIDE=yes unshare --mount --propagation private ${offline:+--net} -- "$0" "${arguments[@]}"
  status=$?
  if [ -z "$keep" ]; then rm -rf --one-file-system -- "$bare"; fi
  exit "$status"
fi

user=root home=/root
if [ "$who" = sudo ]; then user=sailor home=/home/sailor; fi
place="$home/a sea/seascape"

if [ ! -e "$bare/.made" ]; then
  [ -z "$offline" ] || stop "$bare is not there; first: scripts/bare_root_proof.sh --user $who --keep"
  mkdir -p -- "$bare" || exit 1
  # The smallest Debian 12, plus what the case itself is about: sudo.
  include=()
  if [ "$who" = sudo ]; then include=(--include=sudo); fi
  mmdebstrap --variant=minbase --format=directory "${include[@]}" bookworm "$bare" || stop "mmdebstrap failed"
  # A mirror that is a copy of some day needs the host's settings for dates; the keys are Debian's own.
  apt-config dump | grep -E '^Acquire::(Check-Valid-Until|Check-Date|http::Proxy|https::Proxy) ' > "$bare/etc/apt/apt.conf.d/99proof"
  if [ "$who" = sudo ]; then
    chroot "$bare" useradd -m -s /bin/bash "$user" && printf '%s ALL=(ALL) NOPASSWD: ALL\n' "$user" > "$bare/etc/sudoers.d/$user" || exit 1
  fi
  git -c advice.detachedHead=false clone -q --no-hardlinks "$project" "$bare$place" || exit 1
  chroot "$bare" chown -R "$user:" "$home" || exit 1
  : > "$bare/.made"
fi
cp -L /etc/resolv.conf "$bare/etc/resolv.conf"
mount --rbind /dev "$bare/dev" && mount -t proc proc "$bare/proc" && mount -t tmpfs tmpfs "$bare/dev/shm" || exit 1
if [ -n "$offline" ]; then ip link set lo up 2> /dev/null; fi

# inside COMMAND: in the root, as the user, without a terminal, a display or a runtime folder.
inside() {
  chroot --userspec="$user" "$bare" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    HOME="$home" USER="$user" CI=true bash -c "cd \"\$1\" && $1" bash "$place" < /dev/null
}
failed=0
export LC_ALL=C
TIMEFORMAT="proof: %U s user and %S s system time"  # of all cores: what the wall clock would be on idle ones
for what in $only; do
  begin=$(date +%s)
  command=./check
  if [ "$what" = run ]; then
    command='rm -rf out && ./run && for f in out/left.png out/right.png out/report.html; do [ -s "$f" ] || { echo "$f is not there"; exit 1; }; done'
  fi
  time inside "$command"
  status=$?
  printf 'proof: ./%s as %s%s: status %s, %s s\n' "$what" "$who" "${offline:+, offline}" "$status" "$(($(date +%s) - begin))"
  if [ "$status" -ne 0 ]; then failed=1; fi
done
exit "$failed"
