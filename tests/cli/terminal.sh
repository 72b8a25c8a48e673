#!/bin/sh
# terminal.sh ISOROLL - text for people: no line wider than the terminal, no digit that says nothing, the result said in
# one sentence. COLUMNS stands for the terminal; a real one is tried as well, where `script` can make it.
. "$(dirname "$0")/lib.sh"
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 20 0.2 >open.yaml
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >scene.yaml
printf 'scene: scene.yaml\nvary: {k: [0.5, 1]}\nmeasure: {rotations: {}}\n' >sweep.yaml
run 0 run scene.yaml --as both -o both.csv
commands=$("$isoroll" --help | sed -n 's/^  \([a-z]*\)  *\[*[A-Z][A-Z]*\]*  *[a-z].*/\1/p')

# says_words: everything that commands print for people, one file each: NAME.out
says_words() {
    "$isoroll" --help >program.out
    for command in $commands; do "$isoroll" "$command" --help >"help_$command.out"; done
    "$isoroll" list >list.out
    for file in "$source"/examples/[0-9]*/scene.yaml; do
        name=$(basename "$(dirname "$file")")
        "$isoroll" explain "$file" >"explain_$name.out"
        "$isoroll" compare "$file" --rows 3 --t-end 3 --step 1 >"compare_$name.out" 2>/dev/null # some have no twin
        "$isoroll" analogue "$file" >"analogue_$name.out" 2>/dev/null
    done
    "$isoroll" explain sweep.yaml >explain_sweep.out
    "$isoroll" check both.csv >check.out
    "$isoroll" chaos open.yaml --turns 20 --starts 3 >chaos.out
    "$isoroll" frequencies scene.yaml >frequencies.out
    "$isoroll" frequencies open.yaml --turns 60 >estimated.out
    "$isoroll" periodic open.yaml --period 2 >periodic.out
    "$isoroll" periodic open.yaml --chart J2 --steps 3 >chart.out
    "$isoroll" splitting open.yaml --digits double --k 0.5,1 >splitting.out
    "$isoroll" integrals open.yaml --degree 2 >integrals.out
    "$isoroll" cost open.yaml --quick --method taylor >cost.out
}

for width in 44 $(length "" 80) 120; do
    mkdir -p "at_$width"
    for file in scene.yaml open.yaml sweep.yaml both.csv; do cp $file "at_$width/"; done
    (cd "at_$width" && COLUMNS=$width && export COLUMNS && says_words 2>/dev/null)
    check "$width columns: all has been said" test "$(find "at_$width" -name '*.out' -size +0 | wc -l)" -ge 60
    awk -v width=$width 'length > width { print FILENAME ": " $0 }' "at_$width"/*.out >wide
    checks=$((checks + 1))
    [ ! -s wide ] || fail "$width columns: $(wc -l <wide) lines are wider, as $(head -n 1 wide)"
done

# The words do not depend on the width, and neither do the cells of a table.
words() {
    tr -s ' \n' '\n\n' <"$1"
}
for name in program list $(for c in $commands; do echo "help_$c"; done); do
    words at_44/$name.out >narrow
    words at_120/$name.out >broad
    check "$name: the same words at 44 and 120 columns" cmp narrow broad
done
for name in check frequencies periodic integrals chaos splitting compare_16_sections; do
    words at_44/$name.out | grep -v '^[0-9.]*$' | sort -u >narrow # times of the backends are measured
    words at_120/$name.out | grep -v '^[0-9.]*$' | sort -u >broad
    check "$name: the same cells at 44 and 120 columns" cmp narrow broad
done

# --- a pipe gets whole lines; help is for people there, too
unset COLUMNS
"$isoroll" explain open.yaml | sed '/^cost of/d' >whole
check "a line of a pipe is whole" test "$(wc -l <whole)" -lt "$(wc -l <at_44/explain_16_sections.out)"
check "so is a message" test "$("$isoroll" run absent.yaml 2>&1 | wc -l)" -eq 1
for width in 44 80 120; do
    rm -f shown
    script -qec "stty cols $width; '$isoroll' check both.csv; '$isoroll' list effects; '$isoroll' run $work/absent_absent_absent.yaml" \
        /dev/null </dev/null >shown 2>/dev/null || true
    [ -s shown ] || { skip "a terminal of $width columns" "no terminal can be made here (script)" && continue; }
    check "a terminal of $width columns" test -z "$(tr -d '\r' <shown | awk -v width=$width 'length > width && !/absent/')"
    check "a terminal of $width columns is used" awk -v least=$((width * 8 / 10)) 'length >= least { found = 1 } END { exit !found }' shown
done

# --- numbers: none has a digit that can be left out, so that it still reads as the same double
noisy() {
    grep -o -E '[0-9]*\.[0-9]+(e[-+]?[0-9]+)?' "$@" | awk -F: '
        function digits(text) { sub(/e.*/, "", text); sub(/\./, "", text); sub(/^0*/, "", text); return length(text) }
        { text = $NF; x = text + 0
          for (p = 1; p < 17; p++) if (sprintf("%.*g", p, x) + 0 == x) break
          if (digits(text) > p) print }'
}
sed '/^cost of/d' at_120/explain_1*.out at_120/explain_0*.out >explained
check "explain has numbers" test "$(grep -c '[0-9]\.[0-9]' explained)" -ge 20
check "explain: no digit too many: $(noisy explained | head -n 1)" test -z "$(noisy explained)"
check "files: no digit too many" test -z "$(grep '^# [kJ]\|^# tol' both.csv >lines && noisy lines)"
refuses 3 "'tolerance' is 0.1000001, it must be" run - <<END
$(cat scene.yaml)
solver: {tolerance: 0.1000001}
END

# --- help has all commands, in groups, each once
"$isoroll" --help >help
check "four groups" test "$(grep -cE '^(start|study|many|reference)(:|$)' help)" -eq 4
check "each command once" test -z "$(echo "$commands" | sort | uniq -d)"

# --- the result of compare, in its last line
verdict() { # WORDS ARGUMENT...
    words=$1
    shift
    run 0 compare "$@"
    check "compare $*: $words" test "$(tail -n 1 out | cut -c "1-${#words}")" = "$words"
}
verdict "the same orbit: both models agree to " open.yaml
check "it is the largest difference" test "$(tail -n 1 out | sed 's/.* //')" = "$(sed -n 's/^  ball, point  *//p' out | tr -s ' ' '\n' | sort -g | tail -n 1)"
verdict "the same orbit: both models and the closed solution agree to " scene.yaml
verdict "the orbits part: " open.yaml --t-end 300
verdict "not shown to be the same orbit: " scene.yaml --method rk4 --tol 0.1 --t-end 200
check_not "which is not called the same" grep -q '^the same orbit' out
run 0 explain open.yaml
check "explain begins with the twin" test "$(head -n 1 out | cut -c 1-21)" = "This orbit has a twin"

finish
