#!/bin/sh
# packages.sh [tests | all] - installs what .packages lists and is missing: what stands above "# tests"; with `tests` what
# stands above "# all"; or all of it.
# Where it cannot install, it says what is needed and goes on if the tools are there.
set -eu
list=$(dirname "$0")/../.packages
case ${1-} in
all) last='$' ;;
tests) last='/^# all/' ;;
*) last='/^# tests/' ;;
esac
wanted=$(sed -n "1,${last}p" "$list" | sed 's/#.*//')

missing=
for package in $wanted; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || true
    [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

root=
if [ "$(id -u)" -ne 0 ]; then
    sudo -n true 2>/dev/null && root='sudo -n' || root=none
fi
if [ "$root" != none ] && command -v apt-get >/dev/null; then
    echo "installing$missing"
    $root apt-get update -qq
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
