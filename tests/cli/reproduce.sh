#!/bin/sh
# reproduce.sh ISOROLL - examples/reproduce.sh: each row of its list has what makes it and what it is compared with; a
# number that a document changes is found. At full length a table is made.
. "$(dirname "$0")/lib.sh"
script=$source/examples/reproduce.sh
sed -n '/^name|/,/^END/p' "$script" | sed '1d; $d' >rows.txt
check "the list has rows" test "$(wc -l <rows.txt)" -ge 30
while IFS='|' read -r name _ _ agrees document heading command; do
    case $agrees in
    figure) check "$name is drawn" grep -q "^draw_$name()" "$source/examples/pictures.sh" ;;
    beside) check "$name has a program" test -f "$source/tests/bench/$(echo "$command" | sed 's/bench_//; s/ .*//').c" ;;
    *) check "$name is made" grep -q "^made_$name()" "$script" ;;
    esac
    # shellcheck disable=SC2016 # a program for awk
    [ "$agrees" = figure ] || check "$document has '$heading' with a table" awk -v heading="^#+ .*$heading" '
        /^#/ { inside = $0 ~ heading } inside && /^[|]---/ { found = 1 } END { exit !found }' "$source/$document"
done <rows.txt
sed -n 's/^draw_\(.*\)() {.*/\1/p' "$source/examples/pictures.sh" | sort >drawn
sed -n 's/|.*|figure|.*//p' rows.txt | sort >listed
check "the list has every picture that is drawn" cmp drawn listed
check "--list" sh "$script" --list
check_not "an option that it does not have" sh "$script" --nothing
check_not "no command" sh "$script" absent
check_not "a row that the list does not have" sh "$script" "$isoroll" nothing

# a copy of what the script reads, where a document may be changed
: >err
mkdir -p copy/lib copy/apps build && cp -r "$source/lib/doc" copy/lib && cp -r "$source/apps/python" copy/apps
cp -r "$source/examples" copy && ln -s "$isoroll" build/isoroll
if [ "$(length short full)" = full ] && "$isoroll" prove "$source/examples/17_why_only_one/scene.yaml" >out 2>err; then
    sed -i '/^| [0-9/]* | -\{0,1\}[0-9.]*e[-+]/{ /^| 1\/5 /!d }' copy/lib/doc/prove.md # four numbers are enough
    check "a table is made" sh copy/examples/reproduce.sh build/isoroll signs
    sed -i 's/4.613405e-01/4.613425e-01/' copy/lib/doc/prove.md
    check_not "it is changed" cmp -s copy/lib/doc/prove.md "$source/lib/doc/prove.md"
    check "there is the wrong digit" grep -q 4.613425e-01 copy/lib/doc/prove.md
    check_not "a wrong digit is found" sh copy/examples/reproduce.sh build/isoroll signs
elif grep -q 'this build has no Arb' err; then
    skip "a table of numbers" "this build has no Arb"
fi
if has gnuplot "a picture"; then
    rm -f copy/examples/14_from_python/picture.svg
    check "a picture is drawn" sh copy/examples/reproduce.sh build/isoroll foreign
    check "where it belongs" test -s build/reproduced/examples/14_from_python/picture.svg
    sed -i 's/point/pint/; 1q' copy/examples/14_from_python/orbit.txt
    check_not "one that cannot be drawn" sh copy/examples/reproduce.sh build/isoroll foreign
fi
finish
