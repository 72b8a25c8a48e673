#!/bin/sh
# Geometry numbers in physical scenes: a ball on a needle's tip, a shell around a pin, a ball that nearly fills its
# bowl.
. "$(dirname "$0")/lib.sh"
hard_topic "1. Geometry numbers, physical scenes"

# physical KIND RADIUS END
physical() {
    cat <<END
ball:    {mass: 6.8, radius: 0.1092, inertia: [0.0270, 0.0274, 0.0283]}
surface: {kind: $1, radius: $2}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time:    {end: $3, step: $3}
END
}

# there_and_back SCENE BOUND: both backends and both ways of conversion agree; the residuals of either file are small
there_and_back() {
    run 0 run "$1" -o ball.csv
    run 0 run "$1" --backend point -o other.csv
    hard_hold "$(difference ball.csv other.csv)" "$2"
    run 0 convert --to point ball.csv -o point.csv
    run 0 convert --to ball point.csv -o back.csv
    hard_hold "$(difference ball.csv back.csv)" "$2"
    run 0 check point.csv --max "$2"
    run 0 check ball.csv --max "$2"
    run 0 compare "$1" --rows 2
    run 0 explain "$1"
}

# Bounds: tolerance 1e-12 times the few steps of each way.
hard_case "a bowl 1e-7 wider than its ball" "backends, conversion there and back, check: 17 turns of the normal" \
    "k = 1.1e6: a radian of the point takes 1e9 units of s at |M| = 1e-8"
physical inside 0.1092001 1e-4 >bowl.yaml
there_and_back bowl.yaml 1e-11

hard_case "a shell around a pin" "the same, over 100 s" "k = -0.0092: M and s have powers of q up to 55"
physical shell 1.0e-3 100 >shell.yaml
there_and_back shell.yaml 1e-11

hard_case "a ball on a needle's tip" "the ball and gamma by both backends" "k = 9e-5: |M| = 1e5000 in these units"
physical outside 1.0e-5 10 >tip.yaml
run 0 run tip.yaml -o ball.csv
run 0 run tip.yaml --backend point -o other.csv
hard_hold "$(difference ball.csv other.csv)" 1e-12
echo 'output: {columns: [t, gamma1, gamma2, gamma3]}' | cat tip.yaml - >gamma.yaml
run 0 run gamma.yaml -o gamma.csv
run 0 run gamma.yaml --backend point -o other.csv
hard_hold "$(difference gamma.csv other.csv)" 1e-12
refuses 4 "k = 9.156670634557275e-05 is too extreme for M" run tip.yaml --as both
hard_refused "$(cat err)"
hard_naive "q^(-1/(2k)), q = 0.1" "$(awk 'BEGIN { print 0.1 ^ (-1 / (2 * 9.15667e-5)) }')" 1e308

finish
