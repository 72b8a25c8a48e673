#!/bin/sh
# keep.sh - compiles the library for the page of `isoroll view --live` from the last commit, and keeps it in the folder
# `kept`, with what it was made of. It needs emscripten, node and the network (Debian's sources of GSL and libyaml).
set -eu
cd "$(dirname "$0")/../.."
[ -z "$(git status --porcelain lib apps/live)" ] || { echo "commit lib and apps/live first" >&2; exit 1; }
sources=$PWD/.build/live-sources build=.build/live kept=apps/live/kept
[ -d "$sources" ] || sh apps/live/sources.sh "$sources"
export NODE_PATH=/usr/share/nodejs
emcmake cmake -S apps/live -B $build -DISO_LIVE_SOURCES="$sources" >$build.log 2>&1 &&
    cmake --build $build --parallel 2 >>$build.log 2>&1 || { cat $build.log; exit 1; }
mkdir -p $kept
cp $build/isoroll.js $build/library.txt $kept
size() { wc -c <"$1" | tr -d ' '; }
hash() { sha256sum "$1" | cut -d ' ' -f 1; }
cat >$kept/README.md <<END
# The library as WebAssembly, compiled

\`isoroll view --live\` puts these two files into its page. \`sh apps/live/keep.sh\` made them of the
sources of this project; \`sh tests/run.sh --all\` compiles them anew, and compares what both compute.

| what | |
|---|---|
| revision of the sources | $(git rev-parse HEAD) |
| compiler | emscripten $(emcc --version | sed -n '1s/.* \([0-9.]*[0-9]\).*/\1/p') |
| with | $(cd "$sources" && echo gsl-*/ libyaml-*/ | tr -d /) |
| isoroll.wasm | $(size $build/isoroll.wasm) bytes |
| its SHA-256 | $(hash $build/isoroll.wasm) |
| library.txt, which is that by gzip and base64 | $(size $kept/library.txt) bytes |
| isoroll.js, its loader | $(size $kept/isoroll.js) bytes |
| its SHA-256 | $(hash $kept/isoroll.js) |
END
