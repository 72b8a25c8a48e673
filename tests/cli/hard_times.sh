# Hard times through the command: lists in any order, runs that fail before the end, numbers at the ends of the
# doubles.
# shellcheck shell=sh
. "$(dirname "$0")/lib.sh"
hard_topic "7b. Times and numbers through the command"

scene -1 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 100 1 >scene.yaml

# --- any order: the rows of the sorted list, found in as many steps

seq 0 0.1 300 >forth.txt
seq 300 -0.1 0 >back.txt
{ seq -100 -0.5 -150 && seq 100 0.5 200 && seq 50 -0.25 -50 && echo 1e-300 1e-300 -0 0 0; } >mixed.txt
tr ' ' '\n' <mixed.txt | sort -g >sorted.txt

# steps: of the last run, which was --verbose
steps() {
    sed -n 's/.*: \([0-9]*\) steps.*/\1/p' err
}

hard_case "lists backwards" "steps beyond those of the same list forwards, and rows that differ" \
    "an orbit sets out again from its start where a time lies behind"
for way in "ball adams" "ball rk8pd" "ball bdf" "ball taylor" "point taylor" "point blanes_moan6" \
    "point verner_8_5_6"; do
    backend=${way% *} method=${way#* }
    run 0 run scene.yaml --times forth.txt --backend "$backend" --method "$method" --tol 1e-8 --verbose
    forth=$(steps)
    rows out >forth.rows
    run 0 run scene.yaml --times back.txt --backend "$backend" --method "$method" --tol 1e-8 --verbose
    rows out | sort -g >back.rows
    apart=$(cmp -s forth.rows back.rows; echo $?)
    hard_hold $(($(steps) - forth + apart)) 0 "$backend" "$method"
    run 0 run scene.yaml --times mixed.txt --backend "$backend" --method "$method" --tol 1e-8
    rows out | sort -g | uniq >mixed.rows
    check "the order of the file is kept" sh -c "tr ' ' '\n' <mixed.txt | sed 's/^-0$/0/' |
        awk '{ printf \"%.17g\n\", \$1 }' >a
        grep -v '^#' out | tail -n +2 | cut -d, -f1 | sed 's/^-0$/0/' >b; cmp a b"
    run 0 run scene.yaml --times sorted.txt --backend "$backend" --method "$method" --tol 1e-8
    rows out | sort -g | uniq >sorted.rows
    check "mixed and sorted rows of $way" cmp mixed.rows sorted.rows
done
run 0 run scene.yaml --times back.txt --backend exact
# an orbit that sets out again for each row goes half of all steps as often as there are rows
hard_naive "a start for each row, in steps" "$((forth * 3001 / 2))" "$forth"

# --- what was found before a failure or a loss of contact stands in the file's order

cat >loss.yaml <<'END'
reduced: {k: 0.6, J: [1.4, 2.1, 3.0], D: 0.9}
initial: {normal: [0, 0.6, 0.8], angular_velocity: [0.1, 0, 0]}
time: {end: 10, step: 1}
effects: {gravity: {mgb: 2, up: [0, 0.6, 0.8]}, reactions: {}}
output: {columns: [t, pressure]}
END
run 0 run loss.yaml --times - <forth.txt
rows out >forth.rows
run 0 run loss.yaml --times - <back.txt
rows out | sort -g >back.rows
hard_case "lost contact, backwards" "rows beyond the loss, and others than those of the list forwards" \
    "the loss is looked for from row to row"
check "contact is lost on the way" test "$(wc -l <forth.rows)" -lt 3000
apart=$(paste -d, forth.rows back.rows | awk -F, 'function abs(x) { return x < 0 ? -x : x }
    !(abs($1 - $3) <= 1e-12 && abs($2 - $4) <= 1e-12) { wrong++ } END { print wrong + 0 }')
hard_hold "$apart" 0 ball auto

# --- ends of the doubles: refused or answered, with no number that is none

hard_case "ends of the doubles" "runs that are neither answered in numbers nor refused in words" \
    "t/unit, t rate and h overflow or underflow"
wrong=0 tried=0
# ends: one command on one scene; exit status 0, or 3 or 4 with words that say why, and no numbers that are none
ends() {
    tried=$((tried + 1))
    "$isoroll" "$@" >out 2>err
    status=$?
    bad=1
    if [ "$status" -eq 0 ] && [ ! -s err ]; then bad=0; fi
    if { [ "$status" -eq 3 ] || [ "$status" -eq 4 ]; } && head -n 1 err | grep -q '^isoroll: '; then bad=0; fi
    if grep -v '^#' out | grep -q -i -E '(^|[, ])[-+]?(nan|inf)'; then bad=1; fi
    [ "$bad" -eq 0 ] || echo "$* with $(tr '\n' ' ' <scene.yaml): $status" >&2
    wrong=$((wrong + bad))
}
for end in 0 -0.0 5e-324 1e-300 -1e-300 1e300 -1e300 1.7e308; do
    for omega in "0.9, -0.3, -0.225" "0, 0, 0" "0.9e-300, -0.3e-300, -0.225e-300" "0.9e300, -0.3e300, -0.225e300" \
        "0.9e-310, -0.3e-310, -0.225e-310" "9e-324, -3e-324, 0"; do
        scene -1 "1.4, 2.1, 3" "$omega" "0.36, 0.48, 0.8" "$end" 1e300 >scene.yaml
        for backend in ball point exact; do ends run scene.yaml --backend $backend; done
        ends run scene.yaml --as both
        ends compare scene.yaml --json
        ends frequencies scene.yaml --json
    done
done
scene -1 "1.4, 2.1, 3" "0.9e308, -0.3e308, -0.225e308" "0.36, 0.48, 0.8" 1e-307 1e-308 >scene.yaml
ends run scene.yaml
check "the fastest of all" test "$status" -eq 0
hard_hold "$wrong" 0
check "there were some" test "$tried" -gt 280
hard_naive "1e300 squared" "$(awk 'BEGIN { print (1e300 * 1e300 > 1e308 ? "inf" : 0) }')" 0

# a grid has its start and its end however short it is
scene -1 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 5e-324 100 >scene.yaml
run 0 run scene.yaml
check "two rows to the end of one ulp" test "$(rows out | cut -d, -f1 | tr '\n' ' ')" = "0 4.9406564584124654e-324 "

finish
