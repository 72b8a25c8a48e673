#!/bin/sh
# examples.sh ISOROLL - every scene in examples/ does what the commands promise.
. "$(dirname "$0")/lib.sh"
for file in "$source"/examples/*/scene.yaml; do
    [ -f "$file" ] || continue
    run 0 explain "$file"
    silent
    mapped=$(grep -c '^  holds: ' out)
    run 0 run "$file" -o trajectory.csv
    check "$file: rows" test "$(rows trajectory.csv | wc -l)" -ge 2
    head -n 40 trajectory.csv | grep -q '^t.*n3\|^s.*gamma3' && run 0 check --max 1e-9 trajectory.csv
    if [ "$mapped" = 0 ]; then
        run 3 compare "$file"
        says 'breaks the isomorphism'
        continue
    fi
    run 0 run "$file" --as both -o both.csv
    silent
    run 0 check --max 1e-9 both.csv
    run 0 compare "$file"
    silent
done
finish
