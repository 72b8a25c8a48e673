#!/bin/sh
# examples.sh ISOROLL - every scene in examples/ does what the commands promise.
. "$(dirname "$0")/lib.sh"
for file in "$source"/examples/*/scene.yaml; do
    [ -f "$file" ] || continue
    run 0 explain "$file"
    silent
    run 0 run "$file" -o trajectory.csv
    silent
    check "$file: rows" test "$(rows trajectory.csv | wc -l)" -ge 2
    run 0 check --max 1e-9 trajectory.csv
    run 0 run "$file" --as both -o both.csv
    run 0 check --max 1e-9 both.csv
    run 0 compare "$file"
    silent
done
finish
