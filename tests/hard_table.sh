#!/bin/sh
# hard_table.sh BUILD: writes the tables of tests/README.md anew from what the hard cases of that build folder left in
# tests/hard_*.tsv (`ctest -L hard` makes them): a line each, topic case kind ..., see hard.c.
set -eu
: "${1:?usage: sh tests/hard_table.sh BUILD}"
build=$(cd "$1" && pwd)
cd "$(dirname "$0")"
mark='<!-- from here on written by hard_table.sh -->'
sed "/^$mark/,\$d" README.md >README.new
{
    echo "$mark"
    cat "$build"/tests/hard_*.tsv | sort -s -t "$(printf '\t')" -V -k1,1 | awk -F '\t' '
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
        $3 == "refused" {
            if (!($6 in known)) { note[++notes] = $6; known[$6] = notes }
            if ($4 == "") { worst[c] = "refused: " $6; notes--; next }
            matrix[c] = 1; cell[c, at($4 " | " $5)] = "refused " known[$6] ")"
        }
        END { flush() }'
} >>README.new
mv README.new README.md
