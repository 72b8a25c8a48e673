#!/bin/sh
# compare.sh ISOROLL - `isoroll compare` on every example: the backends agree, integrals are conserved, a table and
# pictures come out.
. "$(dirname "$0")/lib.sh"

# compares NAME SCENE: the backends agree (that drifts and differences are the true ones: test_study)
compares() {
    quietly compare "$2"
    check "$1: the same orbit" grep -q '^the same orbit: ' out
}

scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
cat >point.yaml <<END
point: {k: 0.6, J: [1.4, 2.1, 3.0]}
initial: {gamma: [0.6, 0, 0.8], M: [0, 2.5, 0]}
time: {end: -5}
END
compares "a ball" scene.yaml
compares "a point, backwards" point.yaml
for file in "$source"/examples/*/scene.yaml; do
    [ -f "$file" ] && "$isoroll" explain "$file" | grep -q '^  holds: ' || continue # an effect breaks the isomorphism
    compares "${file#"$source/"}" "$file"
done

quietly compare scene.yaml
check "a table" test "$(grep -cE '^ +[-0-9.e+]+ +(ball|point) ' out)" -ge 24 # 2 models x 6 rows x 2 backends
quietly compare scene.yaml --json
check "JSON" is_json
check "six differences of each pair of three backends" test "$(grep -A 7 '"worst_difference": {' out | grep -c '": [0-9.e-]*,\{0,1\}$')" -ge 6
run 0 compare scene.yaml --rows 2
check "--rows 2" test "$(grep -cE '^ +[-0-9.e+]+ +(ball|point) ' out)" -eq 8
run 0 compare scene.yaml --rows 1
check "--rows 1" test "$(grep -cE '^ +10 +(ball|point) ' out)" -eq 2
refuses 2 "expected a whole number" compare scene.yaml --rows 2.5
prints '^backend ball   adams: ' compare scene.yaml --t-end -3 --step 1 --method adams --tol 1e-10

# --- pictures
if has gnuplot "--plot"; then
    quietly compare scene.yaml --plot picture.svg
    steady picture.svg
    run 5 compare scene.yaml --plot absent/a.svg
    says "absent"
fi

# --- what the picture says is true. gnuplot is replaced by a script that keeps its input.
stand_in
real_path=$PATH

# draws ARGUMENT...: the picture of a comparison; its states are in `states`, its curves in `curve`: t s n gamma, the
# parts of both clocks, the colour, the number
draws() {
    PATH=$work/bin:$real_path
    run 0 compare "$@" --plot drawn.svg
    PATH=$real_path
    for block in states curve; do
        awk -v head="\$$block << EOD" -v names="t s n1 n2 n3 gamma1 gamma2 gamma3 t_part s_part colour number" '
            $0 == "EOD" { inside = 0 }
            inside == 1 { n = split(names, name, " "); for (i = 1; i <= NF; i++) { gsub(/"/, "", $i); at[$i] = i }
                          inside = 2; next }
            inside == 2 { for (i = 1; i <= n; i++) printf "%s%s", $at[name[i]], i < n ? " " : "\n" }
            $0 == head { inside = 1 }' script >$block
    done
}

# true_picture NAME J1 J2 J3: rows "t s n gamma ...": gamma = J^(-1/2) n / |J^(-1/2) n|, equal steps of t, 0 to 8 in
# order at every 8th row, each with its parts of both clocks; neighbours of a curve are near
true_picture() {
    at_most "$1: equal numbers at equal states" "$(awk -v a="$2" -v b="$3" -v c="$4" '
        function abs(x) { return x < 0 ? -x : x }
        { x = $3 / sqrt(a); y = $4 / sqrt(b); z = $5 / sqrt(c); r = sqrt(x * x + y * y + z * z)
          d = abs(x / r - $6) + abs(y / r - $7) + abs(z / r - $8); if (d > worst) worst = d }
        END { print NR == 65 ? worst + 0 : "not 65 rows" }' states)" 1e-10
    check "$1: numbers" test "$(awk 'NR % 8 == 1 { printf "%s", $12 }' states)" = 012345678
    at_most "$1: steps of the curves" "$(awk '
        NR > 1 { for (i = 3; i < 9; i += 3) {
                     d = 0; for (j = i; j < i + 3; j++) d += ($j - p[j]) ^ 2;
                     if (sqrt(d) > worst) worst = sqrt(d) } }
        { for (i = 3; i < 9; i++) p[i] = $i } END { print (NR > 9 ? worst : "few rows") }' curve)" 0.06
    check "$1: the curve ends where the states end" test "$(tail -n 1 curve | cut -d ' ' -f 1)" = \
        "$(tail -n 1 states | cut -d ' ' -f 1)"
}
draws scene.yaml
true_picture "a ball" 1.4 2.1 3.0
check "a result in words" grep -q 'the closed solution, agree to [0-9.]*e-1' script
check_not "no word of the inside" grep -qi -e backend -e scene.yaml script
draws scene.yaml --t-end 0.5
true_picture "a short orbit" 1.4 2.1 3.0
check "a short orbit is drawn whole" grep -q 'drawn and compared: to t \\075 0.5' script
check "and ends with it" test "$(tail -n 1 states | cut -d ' ' -f 1)" = 0.5
draws point.yaml
true_picture "a point, backwards" 1.4 2.1 3.0
draws "$source/examples/16_sections/scene.yaml"
true_picture "chaos" 1 2 5
check "two computations" grep -q 'two computations, .* agree to' script
run 0 compare scene.yaml --t-end 0 --plot drawn.svg
# refused before the work, which would take days
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1e12 1e11 >endless.yaml
refuses 2 "" compare endless.yaml --plot a.jpg

scene 1 "1, 2, 3" "0, 0, 0" "0, 0, 1" 1 0.1 >rest.yaml
refuses 3 "at rest" compare rest.yaml
finish
