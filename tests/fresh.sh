#!/bin/sh
# fresh.sh SUITE [readme | tests]... - what a newcomer types, on an empty Debian of its own: debootstrap makes SUITE
# (such as bookworm, trixie) in a folder of its own. There all lines of README.md run (tests/readme.sh), the tests, or
# both, on the sources of the last commit. At the end: the packages, the megabytes and the seconds that each took.
# It needs root, debootstrap (which it installs) and a network. Where it cannot have them, it says so and ends with 3.
# MIRROR is an address for debootstrap, if its own is not wanted.
set -eu
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || { echo "usage: sh tests/fresh.sh SUITE [readme | tests]..." >&2; exit 2; }
suite=$1
shift
[ $# -gt 0 ] || set -- readme tests
# impossible REASON: nothing can be tried here
impossible() {
    echo "SKIP fresh: README's commands in an empty $suite: $1" >&2
    exit 3
}
[ "$(id -u)" -eq 0 ] || impossible "only root can make one"
git rev-parse -q --verify HEAD >/dev/null 2>&1 || impossible "these sources are no commit of git"
command -v debootstrap >/dev/null || { apt-get update -qq && apt-get install -y -qq debootstrap; } >/dev/null 2>&1 ||
    impossible "debootstrap cannot be installed"
[ -z "$(git status --porcelain)" ] || echo "changes that are not committed are not tried"

root=$(mktemp -d -p "${TMPDIR:-/var/tmp}") # on a disk: 3 GB
chmod 755 "$root" # apt's own user enters it
mounts="proc sys dev/pts dev/shm"
# leave: nothing stays mounted, and only what is of this file system is removed
leave() {
    for place in $mounts; do umount "$root/$place" 2>/dev/null || umount -l "$root/$place" 2>/dev/null || true; done
    rm -rf --one-file-system "$root" "$root.log"
}
trap leave EXIT
trap 'exit 1' HUP INT TERM
start=$(date +%s)
echo "=== an empty $suite"
debootstrap --variant=minbase "$suite" "$root" ${MIRROR+"$MIRROR"} >"$root.log" 2>&1 ||
    impossible "debootstrap fails: $(tail -n 1 "$root.log")"
mount -t proc proc "$root/proc" || impossible "nothing can be mounted"
mount -t sysfs -o ro sys "$root/sys"
mkdir -p "$root/dev/pts" "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
mount -t tmpfs shm "$root/dev/shm"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
git archive --prefix=isoroll/ HEAD | tar -xf - -C "$root/root"

# inside COMMAND: a line for the shell of a newcomer
inside() {
    chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        ${http_proxy+http_proxy="$http_proxy"} ${https_proxy+https_proxy="$https_proxy"} sh -c "cd ~/isoroll && $1"
}
packages() { chroot "$root" dpkg-query -W | wc -l; }
megabytes() { du -smx --exclude="$root/root" --exclude="$root/var/cache" --exclude="$root/var/lib/apt" "$root" | cut -f 1; }
report="$suite: empty: $(packages) packages, $(megabytes) MB, $(($(date +%s) - start)) s"
status=0
for what; do
    case $what in
    readme) command="sh tests/readme.sh" ;;
    tests) command=$(grep -o 'sh tests/run\.sh\( --[a-z]*\)*' README.md | head -n 1) ;;
    *) echo "neither readme nor tests: $what" >&2 && exit 2 ;;
    esac
    echo "=== $suite: $command"
    before="$(packages) $(megabytes)" start=$(date +%s)
    inside "$command" && verdict=passed || { status=1 verdict="FAILED"; }
    report="$report
$suite: $command: $verdict, $(($(packages) - ${before% *})) packages, $(($(megabytes) - ${before#* })) MB, $(($(date +%s) - start)) s"
done
echo "=== $report"
exit $status
