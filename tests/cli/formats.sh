#!/bin/sh
# formats.sh ISOROLL - lib/doc/formats.md names every column and every key, and its scene and commands work.
. "$(dirname "$0")/lib.sh"
doc=$source/lib/doc/formats.md

for column in $("$isoroll" list columns | awk 'NR > 1 {print $1}'); do
    check "column $column" grep -q -w -e "$column" "$doc"
done

# keys OF WHAT: what a scene may have there, as the message about an unknown key lists it
named=0
keys() {
    run 3 explain bad.yaml
    for key in $(sed -n 's/.*; valid \(is\|are\) \(.*\)$/\2/p' err | tr -d ,); do
        check "key $key of $1" grep -q -w -e "$key" "$doc"
        named=$((named + 1))
    done
}
echo 'zzzzzzzz: 1' >bad.yaml
keys "a scene"
for section in ball surface reduced point initial time solver output effects; do
    echo "$section: {zzzzzzzz: 1}" >bad.yaml
    keys $section
done
for effect in gravity field twist reactions; do
    echo "effects: {$effect: {zzzzzzzzz: 1}}" >bad.yaml
    keys $effect
done
check "keys are found" test $named -ge 40

# the example of a scene, and the lines that its section on CSV shows
sed -n '/^## 1/,/^A scene has/s/^    //p' "$doc" >scene.yaml
run 0 explain scene.yaml
run 0 run scene.yaml --t-end 1 -o ball.csv
sed -n '/^## 2/,/^A reader/s/^    # \([a-zA-Z]*\):.*/\1/p' "$doc" | sort >shown
sed -n 's/^# \([a-zA-Z]*\):.*/\1/p' ball.csv | sort >written
check "lines of a trajectory" cmp shown written
check "and a few of them" test "$(wc -l <shown)" -ge 8

if command -v gnuplot >/dev/null; then
    run 0 run scene.yaml -o ball.csv
    { echo 'set terminal unknown; set table "table"' && sed -n '/^```gnuplot/,/^```$/{/^```/d;p;}' "$doc"; } >doc.gp
    check "gnuplot" gnuplot doc.gp
    check "gnuplot reads all rows" test "$(grep -c '^ ' table)" -eq 1001
fi
finish
