# Conversion where it is hard: k -> 0, clocks that differ by many decades, many round trips, gaps and repeated rows.
. "$(dirname "$0")/lib.sh"
hard_topic "9. Conversion"

# there FILE N: FILE to the other model and back, N times
there() {
    n=0
    while [ $n -lt "$2" ]; do
        "$isoroll" convert --to point "$1" >there.csv 2>err && "$isoroll" convert --to ball there.csv >"$1" 2>err || return 1
        n=$((n + 1))
    done
}

# states FILE: without its clocks
states() {
    awk -F, -v OFS=, '/^#/ { print; next } { $1 = ""; sub(/^,/, ""); print }' "$1"
}

for k in 1 -1 0.4; do
    trips=$(length 30 100)
    [ $k != 0.4 ] || trips=$(length 100 1000)
    hard_case "$trips round trips, k = $k" "(omega, n), in units in the last place" \
        "rounding of n -> gamma changes the factor of omega: taken from n one way and gamma back, omega drifts by it each time"
    scene $k "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1 0.5 >scene.yaml
    run 0 run scene.yaml --as ball -o ball.csv
    states ball.csv >before
    states ball.csv >timeless.csv # without clocks: states alone
    check "k = $k: $trips round trips" there timeless.csv $trips
    # each trip rounds (18) and its inverse once; what is rounded is nearly the same each time and settles
    hard_hold "$(difference before timeless.csv 2.220446049250313e-16)" 8
done

for k in 0.02 -0.02 0.005; do
    hard_case "k = $k" "(omega, n) there and back, in parts of 4/|2k| ulp" "q^(1/2k) in the factor of M spans many decades"
    scene $k "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1 0.25 >scene.yaml
    run 0 run scene.yaml --as ball -o ball.csv
    states ball.csv >before
    states ball.csv >trip.csv
    check "k = $k: a round trip" there trip.csv 1
    unit=$(awk -v k=$k 'BEGIN { k = k < 0 ? -k : k; print 2.220446049250313e-16 * 4 / (2 * k) }')
    hard_hold "$(difference before trip.csv "$unit")" 1
done

hard_case "s/t = 1e30" "t there and back" "s is 1e30 times t: a sum of steps that starts at 0"
scene -1 "1.4e10, 2.1e10, 3.0e10" "0.9e-20, -0.3e-20, -0.225e-20" "0.36, 0.48, 0.8" 1e21 1e20 >scene.yaml
run 0 run scene.yaml --as ball -o ball.csv
cp ball.csv trip.csv
check "a round trip" there trip.csv 1
hard_hold "$(difference ball.csv trip.csv)" 1e-11

scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.25 >scene.yaml
run 0 run scene.yaml --as ball -o ball.csv
run 0 convert --to point ball.csv -o point.csv
hard_case "gaps: rows missing" "s of the rows that are left, against the whole file" "the other clock is a sum from row to row"
awk '!/^[0-9]/ || ++n == 1 || n > 20 && n % 3 == 2' ball.csv >gaps.csv
awk '!/^[-0-9]/ || ++n == 1 || n > 20 && n % 3 == 2' point.csv >expected.csv
run 0 convert --to point gaps.csv
hard_hold "$(difference expected.csv out)" 1e-12

hard_case "repeated rows" "every number, against the file without them" "a step of length 0 in the middle of a sum"
awk '/^[0-9]/ && ++n % 4 == 0 { print } { print }' ball.csv >twice.csv
awk '/^[-0-9]/ && ++n % 4 == 0 { print } { print }' point.csv >expected.csv
run 0 convert --to point twice.csv
hard_hold "$(difference expected.csv out)" 0

hard_case "a time that repeats with another state" "the states" "two orbits in one file"
awk -F, -v OFS=, '/^[0-9]/ && ++n == 8 { $1 = t } /^[0-9]/ { t = $1 } { print }' ball.csv >stuck.csv
run 1 convert --to point stuck.csv
check "the row is named" grep -q "stuck.csv:19: this row is" err
hard_hold "$(rows out | cut -d, -f2- >stuck; rows point.csv | cut -d, -f2- | cmp -s - stuck; echo $?)" 0

finish
