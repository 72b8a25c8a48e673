#!/bin/sh
# periodic.sh ISOROLL - `isoroll periodic`: orbits, following, charts, files, pictures, what is refused.
# Traces by SciPy, orbits and branches by their laws: test_periodic, test_periodic_levels, test_follow.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >a.yaml
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >b.yaml
scene 1 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >d.yaml

# --- orbits
quietly periodic b.yaml --period 3 -o b.csv
check "rotations first" grep -q "^rotations about the principal axes" out
check "columns" test "$(columns b.csv | cut -d, -f 1-12)" = \
    "orbit,period,l,x,trace,error,stability,symmetry,copies,t,tau,s"
check "a stable fixed point of the return map" test "$(rows b.csv | awk -F, '$2 == 1 && $7 == "stable"' | wc -l)" -eq 1
prints "6\.27038962043661[0-9]\{14,\}" periodic b.yaml --period 1 --polish
prints "lie on resonant tori" periodic d.yaml --period 6
check "k = 1: all are degenerate" test "$(grep -c degenerate out)" -eq 9

# --- following
prints "touch *0.57775689376.*does not pass it" periodic b.yaml --period 1 --orbit 1 --follow k=0.3:0.8 -o f.csv
shows out "it shrinks onto the rotation about axis 1 at k = 0.65388982" "symmetry breaking *0.415374"
check "columns of a branch" test "$(columns f.csv)" = "branch,line,period,k,l,x,trace,event,u"

# --- the chart
run 0 periodic b.yaml --chart J2=1.5:4.5 --k -1:1 --steps 12 -o chart.csv
check "rows of a chart" test "$(grep -c '^grid,' chart.csv)" -eq 169
check "borders" grep -q '^border,' chart.csv

# --- levels
cat >level.yaml <<END
point: {k: 0.5, J: [1, 2, 5], eps: 1}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.3, 0]}
time: {end: 10, step: 1}
END
run 0 periodic level.yaml --period 2 --json -j 2
level=$(value level 1)
check "JSON says the level" test -n "$level"
prints "^level of the point, (H/eps) J2^(1/k): -" periodic level.yaml --period 2 -o level.csv
check "so does the CSV" grep -q "^# level: $level" level.csv
run 0 periodic level.yaml --period 2 --follow level=-0.15:-0.12 -o f.csv
check "--follow level" test "$(columns f.csv)" = "branch,line,period,level,l,x,trace,event,u"
sed 's/0\.3/0.1/' level.yaml >low.yaml
run 0 periodic low.yaml --period 2
says "the point can come to rest"
check "a rotation that is none" grep -q "^ *1  none on this level: an oscillation between two places of rest" out
run 0 periodic b.yaml --chart level=-1:1 --steps 6 -o chart.csv
check "a chart by the level" test "$(columns chart.csv)" = "kind,k,level,least,greatest"
check "places without a rotation" grep -q "^left out: .* an oscillation between two places of rest" out

# --- interrupted
if interruptible "periodic after SIGINT"; then
    follows() { grep -q ",failure," cut.csv 2>/dev/null; }
    interrupted_when follows periodic b.yaml --period 2 --follow k=0.3:0.9 -j 1 -o cut.csv
    check "words" grep -q "interrupted: branches are missing or cut" err
    check "and the branches so far" follows
    # before there is an orbit to follow
    interrupted "interrupted: \(orbits are missing\|branches are missing or cut\)" "worked 2" \
        periodic b.yaml --period 64 --all --grid 100000 --follow k=0.3:0.9
    check_not "and none that say there is none" grep -q "no symmetric orbit" err
    interrupted "interrupted: no chart" "worked 20" periodic b.yaml --chart J2 --steps 1500 -o cut_chart.csv
    check "and no file" test ! -e cut_chart.csv
fi

# --- refusals (others: test_refusals)
refuses 3 "the list ends at 1" periodic b.yaml --period 1 --orbit 2 --follow k=0.4:0.6
refuses 2 "contains k = 0" periodic b.yaml --period 1 --follow k=-1:1
refuses 2 "largest moment" periodic b.yaml --period 1 --follow J2=1.5:6
refuses 2 "expected a number" periodic b.yaml --chart J2 --level low
refuses 2 "does not go with" periodic b.yaml --chart level=0:1 --level 1
refuses 2 "level is for --chart" periodic b.yaml --level 1
scene 2 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >calm.yaml
refuses 3 "no symmetric orbit to follow at k = 2, J = 1.4 2.1 3, level 0: the search along the six" \
    periodic calm.yaml --period 2 --follow k=1.9:2.1
says "found none of at most 2 returns"
scene 0.01 "1.4, 2.1, 3" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >flat.yaml
refuses 3 "only for |k| >= 0.02" periodic flat.yaml
refuses 2 "nothing is computed for |k| < 0.02" periodic b.yaml --chart J2 --k=-0.01:0.01
refuses 2 "goes with --all" periodic b.yaml --grid 100
refuses 2 "goes with --chart" periodic b.yaml --steps 100
refuses 2 "do not go with --chart" periodic b.yaml --chart J2 --all
refuses 2 "not --polish" periodic b.yaml --polish --follow k=0.4:0.6
refuses 2 "choose one" periodic b.yaml --json -o -

finish
