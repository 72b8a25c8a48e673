#!/bin/sh
# abi.sh ISOROLL [--renew] - programs that were compiled before run with the library as it is now: its binary interface
# is that of ../abi/libisoroll.so.0.abi.gz (../abi/README.md). Only at full length: it compiles the library once more.
. "$(dirname "$0")/lib.sh"
kept=$source/tests/abi/libisoroll.so.0.abi.gz
renew=${2-}

# unable REASON: the end
unable() {
    skip "the binary interface" "$1"
    checks=1 # to skip is no failure
    finish
    exit
}
[ -n "$renew" ] || [ "$(length short full)" = full ] || unable "only at full length"
command -v abidw >/dev/null && command -v abidiff >/dev/null || unable "abidw (abigail-tools) is not installed"
[ "$(uname -m)" = x86_64 ] || unable "the kept dump is one of x86-64"
"${CC:-cc}" --version | grep -qi clang && unable "the kept dump is one of gcc"

{ cmake -S "$source" -B build -DCMAKE_C_COMPILER="${CC:-cc}" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG="-O0 -g" \
    -DBUILD_TESTING=OFF -DISO_MPI=OFF && cmake --build build -j 2 --target isoroll isoroll_static; } >log 2>&1 ||
    { cat log; exit 1; }
for component in libisoroll0 libisoroll-dev; do
    cmake --install build --component $component --prefix "$work/installed" >log || { cat log; exit 1; }
done
library=$(find installed -name 'libisoroll.so.*.*')
abidw --headers-dir installed/include --drop-private-types --drop-undefined-syms --no-corpus-path --no-comp-dir-path \
    --no-show-locs --no-elf-needed --no-parameter-names --no-write-default-sizes --out-file now.abi "$library" ||
    { echo "FAIL abidw"; exit 1; }
if [ "$renew" = --renew ]; then
    gzip -9nc now.abi >"$kept"
    echo "renewed: $kept"
    exit
fi
gzip -dc "$kept" >kept.abi
check "there are functions" test "$(grep -c '<function-decl ' now.abi)" -ge 100
checks=$((checks + 1))
abidiff --no-added-syms kept.abi now.abi >err 2>&1 || fail "the binary interface has changed: see tests/abi/README.md"
[ "$failures" -eq 0 ] || cat err
finish
