#!/bin/sh
# columns.sh ISOROLL - every table that a command writes has the columns that `isoroll list tables` tells, each with its
# meaning.
. "$(dirname "$0")/lib.sh"

# listed KIND: its columns, as in the head of a table
listed() {
    awk -v kind="$1" '/^  [^ ]/ { own = substr($0, 3, 22); sub(/ *$/, "", own) }
                      /^    [^ ]/ && own == kind { printf "%s%s", comma, $1; comma = "," }' tables
}

# writes KIND FILE ARGUMENT...: a command writes this table to FILE
writes() {
    kind=$1 file=$2
    shift 2
    run 0 "$@" "$file"
    check "$kind: first line" test "$(head -n 1 "$file")" = "# isoroll $kind 1"
    check "$kind: columns" test "$(columns "$file")" = "$(listed "$kind")"
    echo "$kind" >>tried
}

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >scene.yaml
run 0 list tables
cp out tables
check "each column has a meaning" awk '/^    [^ ]/ && NF < 3 { print; bad = 1 } END { exit bad }' tables
writes section section.csv section scene.yaml --crossings 3 -o
writes chaos chaos.csv chaos scene.yaml --turns 20 --csv
writes periodic periodic.csv periodic scene.yaml --period 1 -o
writes "periodic follow" follow.csv periodic scene.yaml --period 1 --orbit 1 --follow k=0.49:0.51 -o
writes "periodic chart" chart.csv periodic scene.yaml --chart J2 --steps 3 -o
writes splitting splitting.csv splitting scene.yaml --digits double -o
writes cost cost.csv cost scene.yaml --quick --method taylor --tol 1e-9 --csv
check "every table is tried" test "$(grep -c '^  [^ ]' tables)" -eq "$(wc -l <tried)"
finish
