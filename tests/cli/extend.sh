# extend.sh - the recipes of tests/extend, each a patch, followed in a copy of the source: an effect, a method, an
# integral, a column of a result, an option of a study, a table of a new kind, its picture, a study of many orbits with
# its command; and the system of lib/README.md. Every backend and method either simulates the new effect, and all
# agree, or refuses it by name.
. "$(dirname "$0")/lib.sh"
copy=$work/copy
recipes=$source/tests/extend
mkdir "$copy"
cp -r "$source/lib" "$source/apps" "$source/CMakeLists.txt" "$copy/"

# follow NAME MOST: applies NAME.diff, which touches at most so many files
follow() {
    files=$(grep -c '^+++ ' "$recipes/$1.diff")
    check "$1.diff: $files files, $2 at most" test "$files" -ge 1 -a "$files" -le "$2"
    checks=$((checks + 1))
    patch -p1 -f -s --no-backup-if-mismatch -d "$copy" -i "$recipes/$1.diff" >patch.log 2>&1 && return
    fail "$1.diff does not apply: make it anew, as tests/extend/README.md tells"
    cat patch.log >&2
    finish || exit 1
}
follow effect 2
follow method 2
follow integral 1
follow column 2
follow option 4
follow table 2
follow picture 1
follow study 5

# A new study is its folder, one line in the list, a template, and a page of words.
grep '^+++ ' "$recipes/study.diff" | sed 's|^+++ b/||; s|^lib/instrument/passes/.*|its folder|' | sort -u >touched
check "what a study touches" test "$(tr '\n' ' ' <touched)" = \
    "apps/isoroll/cmd_passes.c apps/isoroll/pictures/passes.gp its folder lib/study/options_impl.h "
check "one line in the list" test "$(diff "$source/lib/study/options_impl.h" "$copy/lib/study/options_impl.h" |
    grep -c '^>')" = 1
check "passes.c has at most 90 lines" test "$(wc -l <"$copy/lib/instrument/passes/passes.c")" -le 90

# The system of lib/README.md: every block from "circle.c" to the end of its row compiles.
awk '/^    \/\* circle\.c/ { on = 1 } on && /^[^ ]/ { exit } on { sub(/^    /, ""); print }' \
    "$source/lib/README.md" >"$work/circle.c"
check "lib/README.md has the system circle" grep -q 'iso_system_circle = {' "$work/circle.c"
check "the system of lib/README.md compiles" "${CC:-cc}" -std=c11 -Wall -Wextra -Werror -fsyntax-only \
    -I"$source/lib" "$work/circle.c"

for file in model/effects/effect_drag method/kutta38 instrument/passes/passes; do # also with those of an optimising compiler
    check "$file.c has no warnings" "${CC:-cc}" -std=c11 -D_DEFAULT_SOURCE -O2 -Wall -Wextra -Wpedantic -Wshadow \
        -Wconversion -Werror -I"$copy/lib" -c "$copy/lib/$file.c" -o recipe.o
done

# A table of a new kind: one description of its columns makes files of both formats.
check "table_turns.c" "${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$ISO_BUILD/include" "$recipes/table_turns.c" \
    -o turns -L"$ISO_BUILD" -lisoroll -Wl,-rpath,"$ISO_BUILD"
check "a table of turns" ./turns turns.csv
check "it says its kind" grep -qx '# isoroll turns 1' turns.csv
check "its columns" test "$(columns turns.csv)" = number,angle
check "its rows" test "$(tail -n 1 turns.csv)" = 3,0.16666666666666666
./turns turns.h5 || skip "a table of turns in HDF5" "this build has none"

if [ "$(length short full)" = short ]; then
    skip "the copy of the sources with all recipes" "it is compiled at full length alone"
    finish
    exit
fi

# build WHAT [TARGET]: the copy's command, and TARGET
build() {
    checks=$((checks + 1))
    if ! { cmake -S "$copy" -B "$work/build" -DCMAKE_C_COMPILER="${CC:-cc}" -DISO_WERROR=ON -DBUILD_TESTING=OFF \
        -DISO_MPI=OFF -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 && cmake --build "$work/build" --target isoroll_command ${2:-} -j 2; } >"$work/build.log" 2>&1; then
        fail "$1 does not compile"
        grep -E 'error|warning' "$work/build.log" | head -n 5 >&2
        finish || exit 1
    fi
    isoroll=$work/build/isoroll
}

# holds NAME: the last `explain` lists the integral among those that hold
holds() {
    sed '/^integrals that do not hold/,$d' out | grep -q "^  ball  $1 "
}

build "the recipes" isoroll
run 0 list effects
grep -q '^  drag ' out || fail "list effects has no drag"
run 0 list methods
grep -q '^  kutta38 ' out || fail "list methods has no kutta38"
awk 'NF > 2 && $1 != "name" && /^  / { print $1 }' out >methods
[ "$(wc -l <methods)" -gt 20 ] || fail "list methods has fewer than 20 rows"

# the picture: by its template, which a user can change
if has gnuplot "a picture of a new kind"; then
    run 0 plot turns.csv -o turns.svg
    check "its axes" grep -q 'angle in rad' turns.svg
    sed 's/angle in rad/another angle/' "$copy/apps/isoroll/pictures/turns.gp" >my.gp
    run 0 plot turns.csv -o turns.svg --template my.gp
    check "by the user's own template" grep -q 'another angle' turns.svg
fi

# the table, and the column: in the list, in the table and in JSON
run 0 list tables
grep -q '^  turns  *a row is a turn$' out && grep -q '^    angle  *rad  *by which it goes on$' out || fail "list tables has no turns"
grep -q '^    u  *rad  *where it passes its symmetry line$' out || fail "list tables has no column u"
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >free_ball.yaml
scene 1 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >closed.yaml
run 0 periodic free_ball.yaml --period 1 -o periodic.csv
columns periodic.csv | grep -q ',closure,u,omega1,' || fail "the table has no column u"
run 0 periodic free_ball.yaml --period 1 --json
grep -q '^   "u": [0-9.]*,$' out || fail "JSON has no u"

# The study of many orbits, by its name: a round ball turns at the rate |k omega| = 5, so n3 = 0 is passed 79 times until
# t = 100, from every start.
cat >round.yaml <<'EOF'
reduced: {k: 1, J: [2, 2, 2]}
initial: {normal: [0, 0, 1], angular_velocity: [3, 4, 0]}
time:    {end: 100, step: 10}
EOF
run 0 passes round.yaml --starts 3 -o passes.csv
grep -qx 'n3 = 0 is passed 316 times until t = 100, by one orbit at most 79 times' out || fail "passes does not say what it found"
grep -v '^#' passes.csv | tr '\n' ' ' | grep -qx 'orbit,count 0,79 1,79 2,79 3,79 ' || fail "orbits do not pass n3 = 0 79 times"
grep -q '^# command: isoroll passes ' passes.csv || fail "the table of passes does not say how it was made"
run 0 passes --help
if has gnuplot "a picture of the new study"; then
    run 0 plot passes.csv -o passes.svg
    check "its axes" grep -q '>orbit<' passes.svg
fi

# The option: where there is a closed solution, an estimate finds its frequencies.
run 0 frequencies --help
grep -q -e '--estimate' out || fail "frequencies --help has no --estimate"
run 0 frequencies closed.yaml --json
grep -q '"solution": "closed"' out || fail "there is no closed solution to compare with"
sed -n 's/.*"frequency_ratio": \([0-9.]*\).*/\1/p' out >rotation
run 0 frequencies closed.yaml --estimate --turns 100 --json
grep -q '"solution": "estimated"' out || fail "--estimate does not estimate"
sed -n 's/.*"frequency_ratio": \([0-9.]*\).*/\1/p' out >>rotation
awk '{ r[NR] = $1 } END { exit !(NR == 2 && (r[1] * r[2] - 1) ^ 2 < 1e-16) }' rotation ||
    fail "--estimate finds other frequencies" # its first one is the second

cat >drag.yaml <<'EOF'
reduced: {k: 0.5, J: [1.4, 2.1, 3.0]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time:    {end: 10, step: 10}
effects: {drag: {c: 0.3}}
EOF

# difference FILE FILE: the largest difference of the numbers in the last rows
difference() {
    tail -q -n 1 "$1" "$2" | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) first[i] = $i }
        NR == 2 { for (i = 1; i <= NF; i++) { d = $i - first[i]; if (d < 0) d = -d; if (d > most) most = d } }
        END { print most + 0 }'
}

# --- the effect: a formula -----------------------------------------------------------------------------------------

run 0 run drag.yaml --tol 1e-13 -o reference.csv
grep -q '^# method: taylor$' reference.csv || fail "auto does not take taylor for a formula"
while read -r method; do
    checks=$((checks + 1))
    if "$isoroll" run drag.yaml --method "$method" --tol 1e-9 --backend ball -o "$method.csv" 2>err; then
        off=$(difference reference.csv "$method.csv")
        awk -v off="$off" 'BEGIN { exit !(off < 1e-5) }' || fail "$method: drag differs by $off"
    else
        grep -q -E "'drag'|for the point" err || fail "$method refuses drag without its name"
        says "isoroll"
    fi
done <methods
grep -q kutta38 methods && [ -s kutta38.csv ] || fail "kutta38 does not simulate drag"
for backend in point exact; do
    "$isoroll" run drag.yaml --backend $backend >out 2>err && fail "backend $backend takes drag"
    grep -q "'drag'" err || fail "backend $backend refuses drag without its name"
done
run 3 compare drag.yaml
grep -q "'drag'" err || fail "compare refuses drag without its name"
run 0 check reference.csv --max 1e-10
run 0 explain drag.yaml
holds h && fail "explain lists the energy as conserved"
holds omega.n || fail "explain does not list what drag conserves"
grep -q "'drag' breaks it" out || fail "explain does not tell that drag breaks the isomorphism"
grep -q '^# drag.c: ' reference.csv || fail "the file does not state drag.c"
run 3 convert --to point reference.csv
grep -q "'drag'" err || fail "convert refuses drag without its name"

# Three equal moments: omega keeps its direction, |omega| = w/(1 + c w t/J).
cat >round.yaml <<'EOF'
reduced: {k: 1, J: [2, 2, 2]}
initial: {normal: [0, 0, 1], angular_velocity: [3, 4, 0]}
time:    {end: 10, step: 10}
effects: {drag: {c: 0.3}}
EOF
run 0 run round.yaml --tol 1e-14 -o round.csv
tail -n 1 round.csv | awk -F, '{ w = sqrt($2 * $2 + $3 * $3 + $4 * $4) * (1 + 0.3 * 5 * 10 / 2) / 5 - 1
    exit !(w < 1e-12 && w > -1e-12) }' || fail "drag is not that of the closed form"

printf 'reduced: {k: 1, J: [2, 2, 2]}\n' >bad.yaml
sed -n '2,3p' round.yaml >>bad.yaml
echo 'effects: {drag: {c: -1}}' >>bad.yaml
run 3 run bad.yaml
says "'c' is negative"

# --- the integral --------------------------------------------------------------------------------------------------

sed '/effects/d' round.yaml >free.yaml
run 0 explain free.yaml
holds omega.omega || fail "explain does not list the new integral"
run 0 explain drag.yaml
holds omega.omega && fail "explain lists the new integral where it does not hold"
run 0 run free.yaml -o free.csv
run 0 check free.csv --max 1e-12
grep -q 'ball omega.omega' out || fail "check does not look at the new integral"

# --- breaking the effect -------------------------------------------------------------------------------------------

# No formula: what needs one refuses, auto takes what does not.
drag=$copy/lib/model/effects/effect_drag.c
cp "$drag" effect_drag.c
follow effect_plain 1
build "the effect without a formula"
run 0 run drag.yaml --tol 1e-13 -o plain.csv
grep -q '^# method: taylor' plain.csv && fail "taylor simulates an effect without a formula"
off=$(difference reference.csv plain.csv)
awk -v off="$off" 'BEGIN { exit !(off < 1e-9) }' || fail "drag without a formula differs by $off"
for method in taylor taylor_extended bdf bsimp; do
    "$isoroll" run drag.yaml --method $method >out 2>err && fail "$method simulates an effect without a formula"
    grep -q "'drag'" err || fail "$method does not name the effect it refuses"
done

# No word on the energy: nobody takes it for conserved.
sed -e '/\.work = /d' effect_drag.c >"$drag"
build "the effect without its work"
run 0 explain drag.yaml
holds h && fail "explain lists the energy of an effect that does not state its work"
run 0 run drag.yaml --tol 1e-13 -o silent.csv
cmp -s silent.csv reference.csv || fail "the effect without its work moves otherwise"

# No reason why the isomorphism breaks, and no image: it is broken all the same.
sed -e '/\.breaks = /d' effect_drag.c >"$drag"
build "the effect without a reason"
run 3 compare drag.yaml
grep -q "'drag'" err || fail "compare takes an effect without an image"

# No equations: refused by name.
sed -e '/\.motion = /d' -e 's/^static void motion/__attribute__((unused)) static void motion/' \
    effect_drag.c >"$drag"
build "the effect without equations"
run 3 run drag.yaml
grep -q "the row of 'drag' is not complete" err || fail "an effect without equations is not refused by name"
finish
