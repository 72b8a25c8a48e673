#!/bin/sh
# reproducible.sh - two builds of the same sources, in folders with other names, at other times, in another order of
# files: the same bytes. Compares the programs, both libraries, man pages, and the Debian packages if dpkg is there.
# It compiles everything twice (without tests), so it is run by hand. Options of CMake may follow.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# build FOLDER OPTION...: a copy of the sources in FOLDER, built there
build() {
    folder=$work/$1
    shift
    mkdir -p "$folder"
    tar -C "$source" --exclude=./.build --exclude=./.git -cf - . | tar -C "$folder" -xmf -
    { nice cmake -S "$folder" -B "$folder/out" -DCMAKE_INSTALL_PREFIX=/usr -DBUILD_TESTING=OFF "$@" &&
        nice cmake --build "$folder/out" -j "$(nproc)"; } >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    if command -v dpkg-shlibdeps >/dev/null; then
        (cd "$folder/out" && cpack) >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    fi
}
build one "$@"
build another/much/longer.name "$@"
different=0 same=0
for file in isoroll isoroll-mpi libisoroll.so.0.3.0 libisoroll.a isoroll.pc $(cd "$work/one/out" && ls ./*.deb man/man1/* man/*soroll 2>/dev/null); do
    [ -e "$work/one/out/$file" ] || continue
    if cmp "$work/one/out/$file" "$work/another/much/longer.name/out/$file"; then
        same=$((same + 1))
    else
        different=$((different + 1))
    fi
done
[ $same -gt 10 ] || { echo "FAIL there are only $same files"; exit 1; }
echo "reproducible: $same files the same, $different different"
[ $different -eq 0 ]
