#!/bin/sh
# tables.sh ISOROLL - every table says where it comes from: the scene, the version and the command are in its lines,
# and what is made again from these lines alone has the same rows, to the byte. Each kind of table, as CSV and as HDF5:
# it has the columns that `list tables` tells, `plot` draws it, and `check`, `convert` and `view` take it if its rows
# are states.
. "$(dirname "$0")/lib.sh"

# say FILE KEY: the value of a line "# KEY: VALUE"
say() {
    sed -n "s/^# $2: //p" "$1"
}

# rebuild FILE: the scene that the lines of a table tell
rebuild() {
    awk '
        function list(text) { gsub(/ /, ", ", text); return "[" text "]" }
        /^# / { at = index($0, ": "); if (at > 3) says[substr($0, 3, at - 3)] = substr($0, at + 2) }
        END {
            if ("initial.normal" in says) {
                printf "reduced: {k: %s, J: %s%s}\n", says["k"], list(says["J"]), "D" in says ? ", D: " says["D"] : ""
                printf "initial: {normal: %s, ", list(says["initial.normal"])
                printf "angular_velocity: %s}\n", list(says["initial.angular_velocity"])
            } else {
                printf "point: {k: %s, J: %s, eps: %s}\n", says["k"], list(says["J"]), says["eps"]
                printf "initial: {gamma: %s, M: %s}\n", list(says["initial.gamma"]), list(says["initial.M"])
            }
            if ("tolerance" in says) printf "solver: {tolerance: %s}\n", says["tolerance"]
            printf "time: {end: 10, step: 1}\n"
            n = split(says["effects"], effect, " ")
            if (n > 0 && "initial.normal" in says) printf "effects:\n"
            for (i = 1; i <= n && "initial.normal" in says; i++) {
                printf "  %s: {", effect[i]
                comma = ""
                for (key in says) if (index(key, effect[i] ".") == 1) {
                    value = says[key]
                    name = substr(key, length(effect[i]) + 2)
                    printf "%s%s: %s", comma, name, value ~ / / ? list(value) : value
                    comma = ", "
                }
                printf "}\n"
            }
        }' "$1"
}

# again FILE KIND OPTION: the table says all; from its lines alone (OPTION names the file) comes the same
again() {
    file=$1 kind=$2 option=$3
    check "$file: first line" test "$(head -n 1 "$file")" = "# isoroll $kind 1"
    check "$file: version" test "$(say "$file" isoroll)" = "$version"
    for key in model k J command 'initial\.[nMag][a-z_]*'; do
        check "$file: line $key" grep -q "^# $key: " "$file"
    done
    mkdir -p again
    rebuild "$file" >again/scene.yaml
    command=$(say "$file" command)
    check "$file: the command" test "${command#isoroll }" != "$command"
    name=${command##* }
    checks=$((checks + 1)) last=$command
    (cd again && cp scene.yaml "$name" 2>/dev/null; eval "'$isoroll' ${command#isoroll } $option table.csv" >/dev/null 2>err) ||
        fail "$file: '$command' fails: $(cat again/err)"
    rows "$file" >wanted
    rows again/table.csv >got
    check "$file: the same columns" test "$(columns "$file")" = "$(columns again/table.csv)"
    check "$file: there are rows" test -s wanted
    check "$file: the same rows" cmp wanted got
    rm -r again
}
version=$("$isoroll" --version | sed -n 's/^isoroll //p')

scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >ball.yaml
cat >point.yaml <<'END'
point: {k: -0.5, J: [1.4, 2.1, 3], eps: 0.7}
initial: {gamma: [0.6, 0, 0.8], M: [0, 1.25, 0]}
time: {end: 10, step: 1}
solver: {tolerance: 1.0e-11}
END
sed 's/, eps: 0.7//' point.yaml >zero.yaml # on H = 0
cat >level.yaml <<'END'
ball:    {mass: 2, radius: 0.5, inertia: [0.9, 1.6, 2.5]}
surface: {kind: outside, radius: 0.5}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [0, 0.25, 0]}
time:    {end: 10, step: 1}
effects: {level: {c: 0.1}}
END
for scene in ball point zero level; do
    file=$scene.chaos.csv
    run 0 chaos $scene.yaml --turns 60 --csv $file -j 2
    again $file chaos --csv
done
run 0 chaos ball.yaml --turns=40 --starts 4 --seed 7 --tol 1e-10 --model point --csv starts.csv
again starts.csv chaos --csv
check "--tol is in the lines" grep -qx '# tolerance: 1e-10' starts.csv
check "the command" grep -qx '# command: isoroll chaos --turns 40 --starts 4 --seed 7 --tol 1e-10 --model point ball.yaml' starts.csv
for scene in ball zero; do
    run 0 periodic $scene.yaml --period 1 -o $scene.periodic.csv -j 1
    again $scene.periodic.csv periodic -o
    run 0 splitting $scene.yaml --digits double -o $scene.splitting.csv
    again $scene.splitting.csv splitting -o
done
run 0 splitting ball.yaml --k 0.5,-1/2 --digits double -o k.csv
again k.csv splitting -o
run 0 periodic ball.yaml --period 1 --follow k=0.5:0.52 -o follow.csv
again follow.csv "periodic follow" -o
run 0 periodic ball.yaml --chart J2=1.5:2.5 --k 0.2:1 --steps 8 -o chart.csv
again chart.csv "periodic chart" -o

# Times are never the same twice: of cost the columns that are no times are compared.
run 0 cost ball.yaml --quick --method rk8pd --backend ball --csv cost.csv
for key in model k J h eps command end reference 'second reference' uncertainty initial.normal isoroll; do
    check "cost: line $key" grep -q "^# $key: " cost.csv
done

# Sections and trajectories: the lines, and the same rows.
run 0 section ball.yaml --crossings 5 --starts 2 --seed 3 --quiet -o section.csv
rebuild section.csv >made.yaml
run 0 section made.yaml --crossings "$(say section.csv crossings)" --starts "$(say section.csv starts)" \
    --seed "$(say section.csv seed)" --quiet -o made.csv
check "a section made again" cmp section.csv made.csv
for scene in ball point; do
    run 0 run $scene.yaml -o $scene.csv
    for key in model k J isoroll backend method; do check "$scene: line $key" grep -q "^# $key: " $scene.csv; done
done

# The result of a sweep has the sweep and its scene.
printf 'scene: ball.yaml\nvary: {k: [0.5, 0.7]}\nmeasure: {rotations: {}}\n' >sweep.yaml
run 0 sweep sweep.yaml -o swept.csv
mkdir other
sed -n 's/^# scene | //p' swept.csv >other/ball.yaml
sed -n 's/^# | //p' swept.csv >other/sweep.yaml
(cd other && "$isoroll" sweep sweep.yaml -o swept.csv) || fail "the sweep of a result"
check "a sweep made again" cmp swept.csv other/swept.csv

# Every kind of table, as CSV and as HDF5. make KIND FILE
make() {
    case $1 in
    trajectory) run 0 run ball.yaml -o "$2" ;;
    section) run 0 section ball.yaml --crossings 5 --starts 2 --as both --quiet -o "$2" ;;
    sweep) run 0 sweep sweep.yaml -o "$2" ;;
    chaos) run 0 chaos ball.yaml --turns 60 --starts 4 --csv "$2" ;;
    periodic) run 0 periodic ball.yaml --period 2 -o "$2" ;;
    "periodic follow") run 0 periodic ball.yaml --period 1 --follow k=0.5:0.52 -o "$2" ;;
    "periodic chart") run 0 periodic ball.yaml --chart J2=1.5:2.5 --k 0.2:1 --steps 8 -o "$2" ;;
    splitting) run 0 splitting ball.yaml --k 0.5,-1/2 --digits double -o "$2" ;;
    cost) run 0 cost ball.yaml --quick --method rk8pd --backend ball --csv "$2" ;;
    *) fail "this test does not make the table '$1'" ;;
    esac
}

# listed KIND: its columns as `list tables` tells them, as in the head of a table
listed() {
    awk -v kind="$1" '/^  [^ ]/ { own = substr($0, 3, 22); sub(/ *$/, "", own) }
                      /^    [^ ]/ && own == kind { printf "%s%s", comma, $1; comma = "," }' tables
}

# words_of KIND: what stands in its picture
words_of() {
    case $1 in
    section) echo "3 orbits" ;;
    chaos) echo "undecided" ;;
    periodic) echo "unstable" ;;
    "periodic follow") echo ">trace<" ;;
    "periodic chart") echo "least" ;;
    splitting) echo "Splitting of the separatrix .*J = (1, 2, 5)" ;;
    cost) echo "processor time in seconds" ;;
    esac
}

# take KIND FILE: what the commands do with it. Pictures and converted rows go to FILE.svg and FILE.rows
take() {
    if [ -n "$draws" ]; then
        run 0 plot "$2" -o "$2.svg"
        check "the picture of $1" grep -q "$(words_of "$1")" "$2.svg"
        steady "$2.svg"
    fi
    case $1 in
    trajectory | section | periodic)
        run 0 check "$2" --max 1e-9
        run 0 convert --to point "$2" -o converted.csv
        rows converted.csv >"$2.rows"
        check "$2: there are converted rows" test -s "$2.rows"
        [ -z "$views" ] || run 0 view "$2" -o page.html
        [ "$1" != periodic ] || refuses 3 "is a table of periodic orbits, which is for: " run "$2"
        ;;
    *)
        refuses 3 "which is for: plot" check "$2"
        refuses 3 "which is for: plot" convert --to point "$2"
        refuses 3 "which is for: plot" view "$2" -o page.html
        ;;
    esac
}

draws='' views='' endings=csv
if has gnuplot "pictures of tables"; then draws=yes; fi
if "$isoroll" view ball.yaml -o page.html 2>/dev/null; then views=yes; else skip "pages of tables" "this build has no three.js"; fi
if "$isoroll" run ball.yaml -o probe.h5 2>/dev/null; then endings="csv h5"; else skip "HDF5" "this build has none"; fi
[ "$endings" = csv ] || refuses 3 "<stdin>:1:1: this is an HDF5 file: give its name" check - <probe.h5
echo "t,n1,n2,n3" | gzip >zipped.csv.gz
refuses 3 "zipped.csv.gz:1:1: this file is compressed by gzip: gunzip it first" check zipped.csv.gz
run 0 list tables
cp out tables
check "each column has a meaning" awk '/^    [^ ]/ && NF < 3 { print; bad = 1 } END { exit bad }' tables
{ printf '%s\n' trajectory sweep && sed -n 's/^  \([a-z ]*[a-z]\)  *a row is .*/\1/p' out; } >kinds
check "tables of studies are listed" test "$(wc -l <kinds)" -ge 9
while read -r kind; do
    for ending in $endings; do
        make "$kind" table.$ending
        take "$kind" table.$ending
        case $ending$kind in h5* | csvtrajectory | csvsweep) continue ;; esac
        checks=$((checks + 1))
        case $(columns table.csv), in # those of a section may have the states behind them
        "$(listed "$kind")",*) ;;
        *) fail "$kind: columns $(columns table.csv), not $(listed "$kind")" ;;
        esac
    done
    [ "$endings" != csv ] && [ "$kind" != cost ] || continue # the times of cost are never the same twice
    check "$kind: HDF5 and CSV are converted to the same rows" test ! -e table.csv.rows -o \
        "$(cat table.csv.rows 2>/dev/null)" = "$(cat table.h5.rows 2>/dev/null)"
    if [ -n "$draws" ]; then
        sed -i 's/table\.h5/table.csv/' table.h5.svg
        check "$kind: HDF5 and CSV give the same picture" cmp table.csv.svg table.h5.svg
    fi
    rm -f table.*
done <kinds

# A command is one line that a shell reads, whatever the file is called.
odd=$(printf "a b'c\$d")
cp ball.yaml "$odd"
run 0 chaos "$odd" --turns 3 --csv odd.csv
eval "set -- $(say odd.csv command)"
check "an odd name" test "${5-}" = "$odd"
run 0 chaos --turns 3 --csv - - <ball.yaml
check "a scene from standard input" grep -qx '# command: isoroll chaos --turns 3 -' out

finish
