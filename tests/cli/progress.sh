#!/bin/sh
# progress.sh ISOROLL - a bar on a terminal, from the beginning of the work on, in every command that can take long.
# Nothing is measured: each command is given work without an end, and is stopped when its bar has been seen.
. "$(dirname "$0")/lib.sh"
if ! { command -v script && script -qec true /dev/null </dev/null; } >/dev/null 2>&1; then
    impossible "progress on a terminal" "no terminal can be made here (script)" # as in a bare chroot
fi
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1e9 1e3 >scene.yaml
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1e5 0.01 >rows.yaml
printf 'scene: scene.yaml\nvary: {k: [0.5, 0.7]}\nmeasure: {chaos: {starts: 100}}\nuntil: {turns: 100000000}\n' >sweep.yaml
"$isoroll" run rows.yaml --step 100 -o ball.csv
head -c 10000 ball.csv >rows.csv
mkfifo slow slower # files that never end: their writer waits

# begin NAME ARGUMENT...: starts a command on a terminal, in the background
begin() {
    name=$1
    shift
    mkdir "$name"
    printf "cd '%s' && echo \$\$ >'%s/pid' && exec env %s '%s' %s\n" "$work" "$name" "${variable-NO_COLOR=1}" "$isoroll" "$*" >"$name/job"
    script -qfec "sh '$name/job'" /dev/null </dev/null >"$name/terminal" 2>&1 &
    names="$names $name"
}

# seen NAME: waits until the bar is there, with the time since the beginning; or until the command has ended
seen() {
    patience=600 # tenths of a second, for a machine that is busy: then the test fails
    until grep -q '[.#].* [0-9]* % [0-9]*:[0-9][0-9]' "$1/terminal" 2>/dev/null; do
        patience=$((patience - 1))
        [ $patience -gt 0 ] && { [ ! -s "$1/pid" ] || kill -0 "$(cat "$1/pid")" 2>/dev/null; } || return 1
        sleep 0.1
    done
}

# end NAME: the bar was seen; the command ends
end() {
    checks=$((checks + 1))
    seen "$1" || fail "$1: no bar: $(tr '\r' '\n' <"$1/terminal" | tail -n 2)"
    [ ! -s "$1/pid" ] || kill -KILL "$(cat "$1/pid")" 2>/dev/null
}

names=
begin run run scene.yaml -o run.csv
begin chaos chaos scene.yaml --turns 100000 --starts 100000 -j 1
begin section section scene.yaml --crossings 1000000000 -o section.csv
begin area section scene.yaml --area --crossings 100000000 --starts 100
begin sweep sweep sweep.yaml -o sweep.csv -j 1
begin integrals integrals scene.yaml --degree 8 --turns 100000 -j 1
if "$isoroll" run rows.yaml --certify --t-end 0 >/dev/null 2>&1; then # Arb is there
    begin certify run rows.yaml --certify --digits 1000 --work-digits 3000 -o certified.csv
fi
for name in $names; do end "$name"; done
names=
begin splitting splitting scene.yaml --k 1.7:1.9:0.001 --digits quad -j 1
begin periodic periodic scene.yaml --period 64 --all --grid 1000000 -j 1
begin follow periodic scene.yaml --period 12 --follow k=0.4:0.9 -j 1
begin chart periodic scene.yaml --chart J2 --steps 2000 -j 1
begin frequencies frequencies scene.yaml --turns 100000
begin compare compare scene.yaml
begin cost cost rows.yaml
for name in $names; do end "$name"; done
names=
begin convert "convert --to point slow -o point.csv"
begin check "check slower"
begin view "view scene.yaml -o page.html"
begin explain "explain sweep.yaml"
exec 8<>slow 9<>slower
cat rows.csv >&8
cat rows.csv >&9
for name in $names; do end "$name"; done
exec 8>&- 9>&-

# The first chunk of a sweep has not ended, and the bar is there: it starts when the work starts.
check "sweep: nothing is done" grep -q ' 0 % ' sweep/terminal

# No colour with NO_COLOR; with an empty one there is.
check_not "no colour with NO_COLOR" grep -q "$(printf '\033')" run/terminal
variable=NO_COLOR= names=
begin coloured run scene.yaml -o coloured.csv
end coloured
check "in colour" grep -q "$(printf '\033\\[36m')" coloured/terminal

# What is left: once a part is done.
checks=$((checks + 1))
begin left run scene.yaml --t-end 1e7 -o left.csv
patience=600
until grep -q ' [0-9]*:[0-9][0-9] left' left/terminal 2>/dev/null || [ $patience -eq 0 ]; do
    patience=$((patience - 1))
    sleep 0.1
done
[ $patience -gt 0 ] || fail "no time left"
end left

# A picture: gnuplot tells nothing, so that the line says what is done, not how much. This gnuplot does not end.
mkdir bin
printf '#!/bin/sh\n: >"%s/bin/pid.$$"\nexec sleep 100\n' "$work" >bin/gnuplot
chmod +x bin/gnuplot
"$isoroll" run rows.yaml --step 1000 -o few.csv
variable="NO_COLOR=1 PATH='$work/bin:$PATH'" names=
begin plot plot few.csv -o few.svg
begin picture section scene.yaml --crossings 30 --plot section.svg -o section.csv
begin traces chaos scene.yaml --turns 50 --plot chaos.svg
for picture in $names; do
    checks=$((checks + 1))
    patience=600
    until grep -q '[.#] drawing, [0-9]*:[0-9][0-9]' "$picture/terminal" 2>/dev/null || [ $patience -eq 0 ]; do
        patience=$((patience - 1))
        sleep 0.1
    done
    [ $patience -gt 0 ] || fail "$picture: nothing says that it draws: $(tr '\r' '\n' <"$picture/terminal" | tail -n 2)"
    check_not "$picture: no time left" sh -c "tr '\\r' '\\n' <$picture/terminal | sed -n '/drawing/,\$p' | grep -q left"
    kill -KILL "$(cat "$picture/pid")"
done
for pid in bin/pid.*; do kill "${pid#bin/pid.}" 2>/dev/null; done
variable=NO_COLOR=1

# Rows on the same terminal are progress enough, and stderr that is no terminal gets no bar.
begin rows run scene.yaml
until [ "$(cat rows/terminal 2>/dev/null | wc -l)" -gt 100 ]; do sleep 0.1; done
kill -KILL "$(cat rows/pid)"
check_not "no bar between rows" grep -q '\.\.\.\.' rows/terminal
"$isoroll" run scene.yaml -o rows.csv 2>err &
await computed 200 $!
kill -KILL $!
check_not "no bar in a file" grep -q '\.\.\.\.' err
finish
