#!/bin/sh
# packages.sh [tests | all] - installs what .packages lists and is missing: what stands above "# tests"; with `tests` what
# stands above "# all"; or all of it. Of "A | B" it takes the first that is installed or that apt knows.
# Where it cannot install, it says what is needed and goes on if the tools are there.
set -eu
list=$(dirname "$0")/../.packages
case ${1-} in
all) last='$' ;;
tests) last='/^# all/' ;;
*) last='/^# tests/' ;;
esac
# find_missing: sets $missing, in one line
find_missing() {
    missing=$(sed -n "1,${last}p" "$list" | sed 's/#.*//; s/|//g' | while read -r line; do
        [ -n "$line" ] || continue
        for package in $line "${line%% *}"; do # at the end the first: apt knows none
            state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || true
            [ "$state" != installed ] || break
            [ "$package" = "$line" ] || [ -n "$(apt-cache show "$package" 2>/dev/null)" ] || continue
            break
        done
        [ "$state" = installed ] || printf ' %s' "$package"
    done)
}
find_missing
[ -n "$missing" ] || exit 0

root=
if [ "$(id -u)" -ne 0 ]; then
    sudo -n true 2>/dev/null && root='sudo -n' || root=none
fi
if [ "$root" != none ] && command -v apt-get >/dev/null; then
    $root apt-get update -qq
    find_missing # of what apt knows now
    echo "installing$missing"
    # shellcheck disable=SC2086 # $missing is a list
    $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
    exit
fi

echo "isoroll needs packages that this script cannot install here. On Debian or Ubuntu, as root:" >&2
echo "    apt-get install --no-install-recommends$missing" >&2
echo "elsewhere what they hold: a C compiler, CMake, make, pkg-config, SUNDIALS, GSL, libyaml, jansson, gnuplot; if wanted HDF5, three.js" >&2
for tool in cmake make cc pkg-config gnuplot; do
    command -v $tool >/dev/null || { echo "$tool is not there: cannot go on" >&2; exit 1; }
done
echo "the tools are there: going on without" >&2
