#!/bin/sh
# hard_table.sh BUILD - makes the tables of the hard cases from what these tests left in BUILD/tests/hard_*.tsv:
#
#     BUILD/hard_cases.md     all of it: every case by every backend and method
#     tests/hard/README.md    one line for each case, between its two markers
#
# Run the hard cases at full length first: `ISO_TEST_LENGTH=full ctest --test-dir BUILD -L hard`.
# A line of a .tsv is: topic, case, kind, then what shared/hard.c says.
set -eu
: "${1:?usage: sh tests/hard_table.sh BUILD}"
build=$(cd "$1" && pwd)
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sort -s -t "$(printf '\t')" -V -k1,1 "$build"/tests/hard_*.tsv >"$work/all.tsv"

# --- all of it
{
    echo "# The hard cases, by every backend and method"
    awk -F '\t' '
    # a topic: its cases in words, then a matrix of backends and methods by cases
    function flush(i, j, row, text, plain, wide) {
        if (!cases) return
        printf "\n## %s\n\n| case | must hold | bound | measured, worst | why it is hard | naive |\n|---|---|---|---|---|---|\n", topic
        for (i = 1; i <= cases; i++)
            printf "| %s | %s | %s | %s | %s | %s |\n", name[i], quantity[i], bound[i], worst[i], why[i], naive[i]
        if (ways) {
            text = "\n| backend | method |"
            for (i = 1; i <= cases; i++) if (i in matrix) text = text " " name[i] " |"
            print text
            text = "|---|---|"
            for (i = 1; i <= cases; i++) if (i in matrix) text = text "---|"
            print text
            for (j = 1; j <= ways; j++) {
                text = "| " way[j] " |"
                for (i = 1; i <= cases; i++) if (i in matrix) text = text " " cell[i, j] " |"
                print text
            }
            if (notes) print ""
            for (j = 1; j <= notes; j++) print j ") " note[j] "  "
        }
        cases = ways = notes = 0
        split("", seen); split("", place); split("", cell); split("", matrix); split("", known)
        split("", worst); split("", bound); split("", naive); split("", least); split("", most)
    }
    function at(label) {
        if (!(label in place)) { way[++ways] = label; place[label] = ways }
        return place[label]
    }
    { gsub(/\|/, "\\|") }
    $1 != topic { flush(); topic = $1 }
    $3 == "case" { if (!($2 in seen)) { name[++cases] = $2; seen[$2] = cases; quantity[cases] = $4; why[cases] = $5 } next }
    { c = seen[$2] }
    $3 == "naive" { naive[c] = naive[c] (naive[c] == "" ? "" : "; ") $4 ": " $6; next }
    $3 == "hold" {
        if (!(c in most) || $7 + 0 > most[c] + 0) most[c] = $7
        if (!(c in least) || $7 + 0 < least[c] + 0) least[c] = $7
        bound[c] = least[c] + 0 == most[c] + 0 ? most[c] : least[c] " to " most[c]
        if (worst[c] == "" || $6 + 0 > worst[c] + 0) worst[c] = $6
        if ($4 == "") next
        matrix[c] = 1; cell[c, at($4 " | " $5)] = $6
    }
    $3 == "skipped" { worst[c] = "skipped: " $6; next }
    $3 == "refused" {
        if (!($6 in known)) { note[++notes] = $6; known[$6] = notes }
        if ($4 == "") { worst[c] = "refused: " $6; notes--; next }
        matrix[c] = 1; cell[c, at($4 " | " $5)] = "refused " known[$6] ")"
    }
    END { flush() }' "$work/all.tsv"
} >"$build/hard_cases.md"

# --- one line for each case
awk -F '\t' '
    function flush(i) {
        if (cases) printf "\n## %s\n\n| case | bound | worst |\n|---|---|---|\n", topic
        for (i = 1; i <= cases; i++) printf "| %s | %s | %s |\n", substr(name[i], 1, 70), bound(i), worst[i]
        cases = 0
        split("", seen); split("", worst); split("", least); split("", most)
    }
    function bound(i) { return !(i in most) ? "" : least[i] + 0 == most[i] + 0 ? most[i] : least[i] " to " most[i] }
    { gsub(/\|/, "\\|") }
    $1 != topic { flush(); topic = $1 }
    $3 == "case" { if (!($2 in seen)) { name[++cases] = $2; seen[$2] = cases } next }
    { c = seen[$2] }
    $3 == "hold" {
        if (!(c in most) || $7 + 0 > most[c] + 0) most[c] = $7
        if (!(c in least) || $7 + 0 < least[c] + 0) least[c] = $7
        if (worst[c] == "" || $6 + 0 > worst[c] + 0) worst[c] = $6
    }
    $3 == "skipped" || $3 == "refused" && worst[c] == "" { worst[c] = $3 }
    END { flush() }' "$work/all.tsv" >"$work/cases"

# --- put between the lines "<!-- hard_table.sh" and "<!-- end"
awk -v table="$work/cases" '
    /^<!-- end/ { skipping = 0 }
    !skipping { print }
    /^<!-- hard_table.sh/ { while ((getline line <table) > 0) print line; skipping = 1 }' hard/README.md >"$work/new"
cat "$work/new" >hard/README.md
