#!/bin/sh
# reproduce.sh [--list | --short | --all] [ISOROLL [NAME...]] - makes the figures and tables of the documents again, and
# compares the numbers that it makes with those that the documents print. --short (default) takes some minutes, --all
# hours, --list makes nothing. ISOROLL is the command, in the folder where cmake has built it (with the tests, for some
# rows); .build/release/isoroll if absent. NAME: only these rows of the list. Results go to the folder `reproduced` there,
# or here if nobody may write there.
#
# A row of the list is a figure that pictures.sh draws, or a table: the first one below HEADING in DOCUMENT.
#   figure   is drawn without an error
#   digits   each number differs from the document's by at most one unit of its last digit, and its own error twice
#   abs X, factor X   ... by at most X, or by at most this factor: what chaotic orbits give changes with the last bits
#   shown    both are printed: times of this machine and of another one
#   beside   the same, of a program that prints a whole table
set -eu
list() {
    cat <<END
name|length|minutes|agrees|document|heading or examples|command
values|short|1|digits|lib/doc/why_only_one.md|The values of m|isoroll splitting SCENE --k LIST
signs|all|6|digits|lib/doc/prove.md|Certified signs|isoroll prove SCENE
integrals|short|0.5|factor 1.1|lib/doc/rotor.md|an integral|isoroll integrals SCENE --degree 4
far|short|0.5|factor 4|lib/doc/methods.md|4[.] |isoroll compare SCENE --rows 1 --tol X
proofs|short|0.2|shown|lib/doc/prove.md|How long it takes|isoroll prove SCENE --k K
spheres|short|0.1|figure|examples/README.md|01 to 07, 12, 15, 16, 23|pictures.sh BUILD spheres
foreign|short|0.1|figure|examples/README.md|14|pictures.sh BUILD foreign
paths|short|0.1|figure|examples/README.md|01, 09, 10|pictures.sh BUILD paths
contacts|short|0.1|figure|examples/README.md|11|pictures.sh BUILD contacts
sections|short|0.1|figure|examples/README.md|16, 20|pictures.sh BUILD sections
separable|short|0.1|figure|examples/README.md|24|pictures.sh BUILD separable
tangle|short|0.1|figure|examples/README.md|16|pictures.sh BUILD tangle
tutorial|short|0.5|figure|examples/README.md|22|pictures.sh BUILD tutorial
rotors|all|2|abs 0.04|lib/doc/rotor.md|The chaotic share, k|isoroll chaos SCENE --starts 32
exponents|all|2|factor 1.2|lib/doc/rotor.md|The largest exponent|isoroll chaos SCENE --starts 32
rotors_k|all|2|abs 0.04|lib/doc/rotor.md|The share over k, K|isoroll chaos SCENE --starts 32
certified|all|3|shown|lib/doc/certify.md|How long it takes|isoroll run SCENE --certify --digits D
chaos|all|-|figure|examples/README.md|13|pictures.sh BUILD chaos
splitting|all|3|figure|examples/README.md|17|pictures.sh BUILD splitting
sweeps|all|3|figure|examples/README.md|18, 19, 21|pictures.sh BUILD sweeps
rotor_map|all|6|figure|examples/README.md|20|pictures.sh BUILD rotor_map
many|all|30|figure|examples/README.md|18|pictures.sh BUILD many
cost|all|1|figure|lib/doc/methods.md|02|pictures.sh BUILD cost
methods|all|-|beside|lib/doc/methods.md|3[.] |bench_methods taylor rk8pd rkck bsimp msadams adams bdf
exact|all|-|beside|lib/doc/methods.md|5[.] |bench_exact
effects|all|-|beside|lib/doc/methods.md|7[.] |bench_effects
batch|all|-|beside|lib/doc/performance.md|Many orbits at once|bench_batch -1 2 lanes
crossings|all|-|beside|lib/doc/performance.md|Against other programs|bench_crossings 0.5
anytime|all|-|beside|lib/doc/performance.md|Questions about any time|bench_anytime
backends|all|-|beside|lib/doc/performance.md|What the backends cost|bench_backends
verdicts|all|-|beside|lib/doc/measured.md|1[.] |bench_chaos 100
shares|all|-|beside|lib/doc/measured.md|The share and|bench_share 200 100 300 0
errors|all|-|beside|lib/doc/measured.md|The error of an exponent|bench_exponent 130 16000 77
END
}

length=short
case ${1-} in
--list | --short | --all) length=${1#--} && shift ;;
-*) echo "usage: reproduce.sh [--list | --short | --all] [ISOROLL [NAME...]]" >&2 && exit 2 ;;
esac
if [ "$length" = list ]; then
    list | awk -F '|' '{ printf "%-9s  %-6s  %7s  %-10s  %-23s  %-24s  %s\n", $1, $2, $3, $4, $5, $6, $7 }'
    exit
fi
given=${1-.build/release/isoroll}
[ $# -eq 0 ] || shift
for name; do
    list | grep -q "^$name|" || { echo "reproduce.sh: the list has no row $name" >&2 && exit 2; }
done
[ -x "$given" ] || { echo "reproduce.sh: there is no command $given" >&2 && exit 2; }
build=$(cd "$(dirname "$given")" && pwd)
isoroll=$build/$(basename "$given")
source=$(cd "$(dirname "$0")/.." && pwd)
[ ! -w "$build" ] || cd "$build"
mkdir -p reproduced && cd reproduced
results=$PWD
rm -rf examples chaos.*.csv far.* && cp -r "$source/examples" . # where pictures are drawn
mkdir -p apps && rm -rf apps/python && cp -r "$source/apps/python" apps

# cells: the table of the document, a line "ROW|COLUMN|LABEL|TEXT" for each cell; LABEL is the first cell of the row
cells() {
    awk -v heading="^#+ .*$heading" '
        /^#/ { inside = $0 ~ heading }
        /^\|/ && inside { if (++row < 3) next
            gsub(/[$`\\]/, ""); n = split($0, cell, / *\| */)
            for (i = 3; i < n; i++) print row - 2 "|" i - 1 "|" cell[2] "|" cell[i]; next }
        row { exit }' "$source/$document"
}

# compared MADE CELLS: each line "ROW|COLUMN|NUMBER", or "ROW|COLUMN|NUMBER|ERROR", of MADE against its cell
compared() {
    awk -F '|' -v rule="$agrees" '
        function size(x) { return x < 0 ? -x : x + 0 }
        function number(text) { return match(text, /-?[0-9]+(\.[0-9]*)?(e[-+]?[0-9]+)?/) ? substr(text, RSTART, RLENGTH) : "" }
        function unit(x, e, digits) { # of its last digit
            e = x ~ /e/ ? substr(x, index(x, "e") + 1) : 0; sub(/e.*/, "", x)
            digits = index(x, ".") ? length(x) - index(x, ".") : 0
            return 10 ^ (e - digits)
        }
        function agree(made, said, text, a, b) {
            if (text ~ /below/) return size(made) <= number(substr(text, index(text, "below")))
            if (how == "digits") return size(made - said) <= 1.0001 * unit(said) + 2 * error[$1, $2]
            if (how == "abs") return size(made - said) <= much
            a = size(made); b = size(said)
            return a <= much * b && b <= much * a
        }
        BEGIN { split(rule, word, " "); how = word[1]; much = word[2] }
        FILENAME == ARGV[1] { made[$1, $2] = $3; error[$1, $2] = $4; count++; next }
        number($4) != "" { all++ }
        !(($1, $2) in made) { next }
        { seen++; said = number($4); place = $3 ", column " $2 ": the document has " $4 ", made " made[$1, $2] }
        how == "shown" { print "    " place; next }
        !agree(made[$1, $2], said, $4) { print "    " place; different++ }
        END {
            if (!count || seen != count) { print "    " count + 0 " numbers made, " seen + 0 " in the table"; exit 1 }
            if (how != "shown") print "    " count - different " of " count " numbers agree (" rule "); the table has " all
            exit different > 0
        }' "$1" "$2"
}

# scene K J: a ball; scene_rotor K MOMENTUM: that of 20_rotor with another k and momentum
scene() {
    cat >scene.yaml <<END
reduced: {k: $1, J: [$2]}
initial: {normal: [0.36, 0.48, 0.8], angular_velocity: [0.9, -0.3, -0.225]}
time: {end: ${3-10}, step: ${4-1}}
END
}
scene_rotor() {
    sed "s|k: -1, J|k: $1, J|; s|momentum: \[.*\]|momentum: [$2]|" "$source/examples/20_rotor/scene.yaml" >scene.yaml
}

of_column() { # of `cells`
    grep "^[0-9]*|$1|"
}

# made_NAME: the numbers of a table, from `cells` on standard input, lines "ROW|COLUMN|NUMBER"

made_values() { # m at k in column 2, at -k in column 3; rows with a star, and 0, need 128 bits and minutes
    if [ "$length" = all ]; then cat; else grep -v -e '[*]' -e below; fi | cut -d '|' -f 1-3 >places
    scene 1/2 "1.4, 2.1, 3"
    "$isoroll" splitting scene.yaml -o values.csv --digits "$([ "$length" = all ] && echo auto || echo double)" \
        --k="$(awk -F '|' '{ print ($2 == 3 ? "-" : "") $3 }' places | paste -s -d , -)" >splitting.txt
    awk -F , '!/^[#k]/ && $8 == 0 { print $3 "|" $4 }' values.csv | paste -d '|' places - | cut -d '|' -f 1,2,4,5
}

made_signs() { # k and -k for one J, then for the other
    while IFS='|' read -r row column k _; do
        case $column in 2 | 3) J="1.4, 2.1, 3" ;; *) J="1, 2, 5" ;; esac
        case $column in 3 | 5) k=-$k ;; esac
        scene "$k" "$J"
        "$isoroll" prove scene.yaml </dev/null | sed -n "s/^m = \([^ ]*\).*/$row|$column|\1/p"
    done
}

made_integrals() { # column 2 to 5: degree 1 to 4, the last number of its row
    of_column 2 | while IFS='|' read -r row _ momentum _; do
        scene_rotor -1 "$(echo "$momentum" | sed 's/[()]//g; s/ \./ 0./g; s/^\./0./')"
        "$isoroll" integrals scene.yaml --degree 4 </dev/null |
            awk -v row="$row" '$1 ~ /^[1-4]$/ && NF == 7 { print row "|" $1 + 1 "|" $NF }'
    done
}

made_far() {
    of_column 2 | while IFS='|' read -r row _ k backend; do
        for column in 3 4; do
            to=far.$k.$column
            scene "$k" "1.4, 2.1, 3" 1000000 1000
            [ -e "$to" ] || "$isoroll" compare scene.yaml --rows 1 --tol 1e-1$((column == 3 ? 2 : 5)) >"$to" </dev/null
            awk -v row="$row|$column|" -v of="$backend," '
                $1 == of && $2 == "exact" { print row ($3 > $4 ? $3 : $4) }' "$to"
        done
    done
}

made_proofs() { # the half returns, and seconds
    of_column 2 | if [ "$length" = all ]; then cat; else grep -v '|5|'; fi | while IFS='|' read -r row _ k _; do
        scene "${k%%,*}" "$(case $k in *,*) echo 1, 2, 5 ;; *) echo 1.4, 2.1, 3 ;; esac)"
        began=$(date +%s)
        "$isoroll" prove scene.yaml </dev/null | sed -n "s/^after \([0-9]*\) half.*/$row|4|\1/p"
        echo "$row|5|$(($(date +%s) - began))"
    done
}

made_certified() {
    grep '[0-9.]* (' | while IFS='|' read -r row column digits _; do
        scene 1/2 "1.4, 2.1, 3" "$([ "$column" = 2 ] && echo 100 || echo 1000)" "$([ "$column" = 2 ] && echo 50 || echo 500)"
        began=$(date +%s)
        "$isoroll" run scene.yaml --certify --digits "$digits" -o certified.csv --quiet </dev/null
        echo "$row|$column|$(($(date +%s) - began))"
    done
}

# chaos_of K MOMENTUM: the file with the verdicts on 32 orbits, made once
chaos_of() {
    verdicts=chaos.$1.$(echo "$2" | tr -d ' ' | tr , _).csv
    scene_rotor "$1" "$2"
    [ -s "$verdicts" ] || "$isoroll" chaos scene.yaml --starts 32 --csv "$verdicts" >/dev/null </dev/null
}

# along K DIRECTION: a momentum of the size K
along() {
    awk -v K="$1" -v to="$2" 'BEGIN {
        split(to, d, ","); r = sqrt(d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2)
        printf "%.17g, %.17g, %.17g\n", K * d[1] / r, K * d[2] / r, K * d[3] / r }'
}
direction() { # of a column of the table
    echo 1,0,0 0,1,0 0,0,1 .3,.4,.5 | cut -d ' ' -f $(($1 - 1))
}
share_of() {
    awk -F , '/^[1-9]/ { n++; chaotic += $4 == "chaotic" } END { print chaotic / n }' "$1"
}

made_rotors() {
    while IFS='|' read -r row column K _; do
        chaos_of -1 "$(along "$K" "$(direction "$column")")"
        echo "$row|$column|$(share_of "$verdicts")"
    done
}

made_exponents() {
    while IFS='|' read -r row column K _; do
        chaos_of -1 "$(along "$K" "$(direction "$column")")"
        awk -F , -v place="$row|$column|" '/^[1-9]/ && $4 == "chaotic" && $28 > largest { largest = $28 }
            END { print place largest + 0 }' "$verdicts"
    done
}

made_rotors_k() {
    while IFS='|' read -r row column K _; do
        chaos_of "$(echo -2 -1 -0.5 0.5 1 2 | cut -d ' ' -f $((column - 1)))" "$(along "$K" .3,.4,.5)"
        echo "$row|$column|$(share_of "$verdicts")"
    done
}

failed=
list | sed 1d >rows.txt
while IFS='|' read -r name long minutes agrees document heading command <&3; do
    if [ $# -gt 0 ]; then
        case " $* " in *" $name "*) ;; *) continue ;; esac
    elif [ "$length" = short ] && [ "$long" = all ]; then
        continue
    fi
    echo "$name: $document, $heading: $command ($minutes minutes)"
    case $agrees in
    figure)
        sh examples/pictures.sh "$build" "$name" >"$name.txt" 2>&1 && ! grep "left out" "$name.txt" && echo "    drawn" ;;
    beside)
        # shellcheck disable=SC2086 # a command and its arguments
        { echo "The document:" && cells && echo "Made:" && "$build/tests/"$command; } >"$name.txt" 2>&1 &&
            echo "    both tables are in $results/$name.txt" ;;
    *)
        cells >"$name.cells"
        "made_$name" <"$name.cells" >"$name.txt" && compared "$name.txt" "$name.cells" ;;
    esac || { echo "    failed; see $results/$name.txt" && failed="$failed $name"; }
done 3<rows.txt
echo "Not made here: what only tests measure (lib/doc/measured.md names them), and races on other machines."
[ -z "$failed" ] || { echo "reproduce.sh: not as the documents say:$failed" >&2 && exit 1; }
