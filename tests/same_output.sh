#!/bin/sh
# same_output.sh OLD NEW - by hand: runs every command on every example with two builds of isoroll, and shows where
# their output differs: words, exit statuses, tables (CSV, and HDF5 by `convert` or `check`), JSON, pictures.
#
#     sh tests/same_output.sh OLD/isoroll NEW/isoroll
#
# What names a version, a file of the build, or a time that was measured is left out, and keys of JSON are sorted (it
# needs jq). Exit status 1: some output differs; the two folders that remain can be compared further.
set -eu
[ $# -eq 2 ] || { echo "usage: sh tests/same_output.sh OLD NEW" >&2; exit 2; }
examples=$(cd "$(dirname "$0")/../examples" && pwd)
old=$(realpath "$1") new=$(realpath "$2")
work=$(mktemp -d "${TMPDIR:-/tmp}/same_output.XXXXXX")
export LC_ALL=C NO_COLOR=1

# try NAME COMMAND...: runs a command of isoroll; what it says and how it ends are kept under this name
try() {
    name=$1
    shift
    status=0
    "$isoroll" "$@" >"$name.out" 2>"$name.err" </dev/null || status=$?
    echo "exit $status" >>"$name.err"
}

# Without what is another one in each build; the data of a page are a line of JSON
untimed='walk(if type == "object" then del(.seconds, .isoroll, .version) else . end)'
tidy() {
    for page in *.html; do
        [ ! -e "$page" ] || { sed -n '/^{"/p' "$page" >"$page-json.out" && sed -i '/^{"/d' "$page"; }
    done
    for file in *json.out; do
        [ ! -s "$file" ] || { jq -S "$untimed" "$file" >sorted && mv sorted "$file"; }
    done
    find . -type f ! -name '*.h5' ! -name '*.png' -exec sed -i \
        -e '/^# isoroll: /d' -e '/^# hash: /d' -e 's/isoroll [0-9][0-9.]*[0-9]/isoroll VERSION/g' \
        -e 's/[0-9.e-]* ms/TIME/g' -e '/^cost of a right-hand side: /d' -e "s|$isoroll|isoroll|g" {} +
    rm -f -- *.h5
}

all_of() {
    isoroll=$1
    mkdir -p "$2" && cd "$2"
    for topic in $("$isoroll" --help | awk '/^  [a-z]+ / && $2 != "help" { print $1 }'); do
        try "help-$topic" help "$topic"
        try "man-$topic" manual "$topic"
    done
    try list list
    for scene in "$examples"/*/*.yaml; do
        case $scene in */sweep.yaml | */full.yaml) continue ;; esac
        e=$(basename "$(dirname "$scene")")-$(basename "$scene" .yaml)
        try "$e-explain" explain "$scene"
        try "$e-run" run "$scene" --t-end 2 -o "$e.csv"
        try "$e-run-h5" run "$scene" --t-end 2 -o "$e.h5"
        try "$e-both" run "$scene" --t-end 2 --as both
        for to in ball point; do try "$e-to-$to" convert --to $to "$e.csv"; done
        try "$e-to-h5" convert --to point "$e.h5"
        for file in "$e.csv" "$e.h5"; do try "$e-check-$file" check "$file"; done
        try "$e-check-json" check --json "$e.csv"
        try "$e-compare" compare "$scene" --t-end 2
        try "$e-compare-json" compare "$scene" --t-end 2 --json
        try "$e-plot" plot "$e.csv" -o "$e-plot.svg"
        try "$e-view" view "$e.csv" -o "$e-view.html"
        try "$e-frequencies" frequencies "$scene" --turns 20
        try "$e-frequencies-json" frequencies "$scene" --turns 20 --json
        try "$e-section" section "$scene" --crossings 5 --starts 2 -o "$e-section.csv" --plot "$e-section.svg"
        try "$e-section-as" section "$scene" --crossings 3 --as both
        try "$e-chaos" chaos "$scene" --turns 30 --starts 3 --csv "$e-chaos.csv" --plot "$e-chaos.svg"
        try "$e-chaos-json" chaos "$scene" --turns 30 --starts 3 --json
        try "$e-periodic" periodic "$scene" --period 1 -o "$e-periodic.csv" --plot "$e-periodic.svg"
        try "$e-periodic-json" periodic "$scene" --period 2 --json
        try "$e-splitting" splitting "$scene" --k 0.5,-1 --digits double -o "$e-splitting.csv"
        try "$e-splitting-json" splitting "$scene" --digits double --json
        try "$e-integrals" integrals "$scene" --turns 5
        try "$e-integrals-json" integrals "$scene" --turns 5 --json
        try "$e-analogue" analogue "$scene"
        for table in section periodic splitting; do
            [ ! -e "$e-$table.csv" ] || try "$e-plot-$table" plot "$e-$table.csv" -o "$e-plot-$table.svg"
        done
    done
    scene=$examples/16_sections/scene.yaml
    try follow periodic "$scene" --period 1 --orbit 1 --follow k=0.4:0.6 -o follow.csv --plot follow.svg
    try follow-json periodic "$scene" --period 1 --orbit 1 --follow k=0.4:0.6 --json
    try chart periodic "$scene" --chart J2 --steps 12 -o chart.csv --plot chart.svg
    try chart-json periodic "$scene" --chart J2 --steps 12 --json
    printf 'scene: %s\nvary: {k: [0.5, -1, 2]}\nuntil: {turns: 20}\nmeasure: {chaos: {starts: 8}, rotations: {}}\n' \
        "$scene" >s.yaml
    try sweep-explain explain s.yaml
    for kind in csv h5; do try sweep-$kind sweep s.yaml -o sweep.$kind; done
    for kind in csv h5; do try sweep-plot-$kind plot sweep.$kind -o sweep-$kind.svg; done
    tidy
}

(all_of "$old" "$work/old")
(all_of "$new" "$work/new")
if diff -r "$work/old" "$work/new" >"$work/diff"; then
    echo "same output: $(find "$work/new" -type f | wc -l) files"
    rm -r "$work"
else
    grep -c '^diff\|^Only' "$work/diff" | sed 's/$/ files differ/'
    grep '^diff\|^Only' "$work/diff" | sed 's|.*/||' | head -40
    echo "all differences: $work/diff"
    exit 1
fi
