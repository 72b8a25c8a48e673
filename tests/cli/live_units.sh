#!/bin/sh
# live_units.sh ISOROLL - unit tests of what the page of `isoroll view --live` runs, in node: the same C as WebAssembly
# (apps/live/CMakeLists.txt has the list), at short length.
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
live=$ISO_BUILD/live
[ -e "$live/library.txt" ] || impossible "unit tests in node" "isoroll was built without emscripten or the sources of GSL"
[ "$(length short full)" = full ] || impossible "unit tests in node" "they are built at full length alone"
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
