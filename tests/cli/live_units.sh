#!/bin/sh
# live_units.sh ISOROLL - the library of the page of `isoroll view --live`, in node: the one that is kept has the size and
# hash that its page states; it computes what the sources give that are compiled now; and unit tests of the same C as
# WebAssembly (apps/live/CMakeLists.txt has the list), at short length.
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
live=$ISO_BUILD/live kept=$source/apps/live/kept
stated() { sed -n "s/^| $1[^|]* | \([0-9a-f]*\).*/\1/p" "$kept/README.md" | tr '\n' ' '; }
base64 -d "$kept/library.txt" | gzip -dc >isoroll.wasm
check "sizes are those stated" test "$(stated 'isoroll\.wasm')$(stated 'library')$(stated 'isoroll\.js')" = \
    "$(wc -c <isoroll.wasm) $(wc -c <"$kept/library.txt") $(wc -c <"$kept/isoroll.js") "
check "hashes are those stated" test "$(stated 'its SHA')" = \
    "$(cat isoroll.wasm | sha256sum | cut -c 1-64) $(sha256sum <"$kept/isoroll.js" | cut -c 1-64) "
[ -e "$live/library.txt" ] || impossible "the library compiled anew" "not built: ISO_LIVE_BUILD=ON needs emscripten and the sources of GSL"
[ "$(length short full)" = full ] || impossible "unit tests in node" "they are built at full length alone"
check "the library that is kept computes what the sources give: sh apps/live/keep.sh" \
    node --no-experimental-fetch "$here/live_kept.js" "$source/apps/isoroll/view/worker.js" "$kept" "$live"
export NODE_PATH=/usr/share/nodejs ISO_TEST_LENGTH=short
check "they are built" cmake --build "$live" --target units --parallel 2
count=0
for test in "$live"/test_*.js; do
    count=$((count + 1))
    node --no-experimental-fetch "$test" >out 2>&1 || { tail -n 20 out && fail "$(basename "$test" .js)"; }
done
check "there are many: $count" test "$count" -ge 7
checks=$((checks + count))
finish
