#!/bin/sh
# check.sh ISOROLL - `isoroll check` accepts rows that solve their model and finds rows that do not; `isoroll
# explain`.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >scene.yaml
for as in ball point both; do
    run 0 run scene.yaml --as "$as" -o "$as.csv"
    quietly check --max 1e-9 "$as.csv"
done
check "both models, the clocks, the map" test "$(grep -cE '^  (ball (flow|h|\|n\|)|point (flow|H)|map|clock s) ' out)" -eq 7
prints -x '11 rows' check ball.csv
grep -v '^#' ball.csv >bare.csv
run 0 check --max 1e-9 bare.csv --k=-1 --J 1.4,2.1,3
cat both.csv | "$isoroll" check --max 1e-9 >out
check "from standard input" test $? -eq 0

# finds NAME RESIDUAL...: the damaged file is refused, and these residuals are above the bound
finds() {
    what=$1
    shift
    run 1 check --max 1e-9 damaged.csv
    says "a residual is above 1e-09"
    for residual; do check "$what: $residual is named" grep -q "^  $residual  .*ABOVE THE BOUND" out; done
    quietly check damaged.csv # without a bound it only tells
}

# damage FILE AWK: changes row 4, x1 ... being its columns
damage() {
    awk -F, -v OFS=, -v CONVFMT=%.17g "/^[0-9]/ && ++row == 4 { $2 } { print }" "$1" >damaged.csv
}
# each number of each kind of file: test_check, test_study
damage ball.csv '$5 *= 1 + 1e-7; $6 *= 1 + 1e-7; $7 *= 1 + 1e-7'
finds "n scaled" "ball |n|" "ball flow"
check "the row is named" grep -q '^  ball |n|  *[0-9.e-]*  *4 ' out
# --- bad files, each with its place (each mistake: test_trajectory)
head -c 700 ball.csv | sed '$s/,[^,]*$//' >bad.csv # a file cut short
run 3 check bad.csv
says "bad.csv:"
refuses 2 "from 0 on" check --max -1 ball.csv
refuses 3 "--k contradicts" check --k 1 ball.csv
refuses 3 "--k K" check bare.csv

# --- explain
quietly explain scene.yaml
shows -F out "k = -1, J = 1.4 " ": Neumann's problem" "  integrable: a second integral is known" \
    "backend point, 6 states, in the clock t" "  M1 M2 M3               momentum" "as exact" "method taylor" \
    "energy of the ball h = 0.7374375" "11 rows to t = 10, columns t omega1" "integrals that hold" "F_shell" \
    "integrals that do not hold" "cost of a right-hand side: "
check_not "explain: no clock without a column" grep -q "because a column asks" out
run 0 explain scene.yaml --as both --backend point
shows -F out "backend point" "  M1 M2 M3 " " gamma3 " \
    "  tau s                  clock: a column, or the effect clock, asks for it"
refuses 2 "unknown option --rows" explain scene.yaml --rows 3
# --- what nobody looks at is told
run 0 check ball.csv --json
for name in model backend method tolerance isoroll; do
    check "--json says that nobody looks at # $name" grep -qx " *\"# $name\",*" out
done
check "--json has the residuals" grep -q '"name": "ball flow"' out
prints -x "not looked at: # model, # backend, # method, # tolerance, # isoroll" check ball.csv
# --- several orbits in one file: each for itself, all on the level of the lines
cat >several.yaml <<END
point: {k: 0.5, J: [1.4, 2.1, 3], eps: 1}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}
time: {end: 10}
END
run 0 section several.yaml --starts 3 --crossings 6 --as point --quiet -o several.csv
rows several.csv | cut -d, -f1,8-13 >several.points
prints -x '24 rows' check --max 1e-9 several.csv
check "what is not looked at" grep -q "^not looked at: other columns: 'crossing', 'l', 'x'" out
# converted orbit by orbit, there and back
run 0 convert several.csv --to ball --quiet -o there.csv
prints -x '24 rows' check --max 1e-9 there.csv
run 0 convert there.csv --to point --quiet -o back.csv
rows back.csv >back.rows
at_most "there and back" "$(paste -d, several.points back.rows | awk -F, '
    /^[0-9]/ { for (i = 1; i <= 7; i++) { d = $i - $(i + 7 + (i > 1)); if (d < 0) d = -d; if (d > w) w = d } }
    END { print NR == 24 ? w + 0 : 1 }')" 1e-13
sed 's/^orbit,/number,/' several.csv >damaged.csv # without the column it would be one orbit
finds "orbits that are taken for one" "point flow"
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >half.yaml
run 0 section half.yaml --starts 2 --crossings 4 --as ball --quiet -o balls.csv
for orbit in 0 1; do # one without a good row: its rows are nan, the others are as without it
    sed -E "s/^($orbit,.*),[^,]*\$/\1,7/" balls.csv >damaged.csv
    "$isoroll" convert damaged.csv --to point --quiet -o marked.csv 2>err
    check "orbit $orbit: exit status 1" test $? -eq 1
    check "orbit $orbit: its rows" test "$(grep -c '^nan,' marked.csv)" -eq 4
    check "the other orbits" test "$(rows marked.csv | grep -vc nan)" -eq 8
done
awk -F, -v OFS=, -v CONVFMT=%.17g '/^[12],/ { for (i = 8; i <= 10; i++) $i *= 1.01 } /^# (eps|h):/ { next } { print }' balls.csv >damaged.csv
refuses 3 "convert orbits of different energies one by one" convert damaged.csv --to point --quiet -o none.csv
check "nothing is written" test ! -e none.csv
awk '/^1,/ && !n++ { print "# eps: x" } { print }' balls.csv >damaged.csv # a line before the second orbit
refuses 3 "'eps: x' should be 1 finite number" convert damaged.csv --to point --quiet -o none.csv
run 0 periodic half.yaml --period 2 -o orbits.csv
prints "the flow from row to row, t, tau, s" check --max 1e-9 orbits.csv

finish
