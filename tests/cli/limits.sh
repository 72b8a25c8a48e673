#!/bin/sh
# limits.sh ISOROLL - what strangers' files cannot do: be deeper, longer or larger than lib/README.md says (4, What
# input is trusted). At each limit a file is read; one above it, it is refused in words, at once and in little memory.
. "$(dirname "$0")/lib.sh"
scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 5 0.5 >scene.yaml
run 0 run scene.yaml -o ball.csv
rows=$(rows ball.csv | wc -l)

# repeat N TEXT: the text, N times
repeat() { awk -v n="$1" -v text="$2" 'BEGIN { for (i = 0; i < n; i++) printf "%s", text }'; }

# --- YAML: depth, values, bytes
{ cat scene.yaml && printf 'effects: %s1%s\n' "$(repeat 8 '[')" "$(repeat 8 ']')"; } >deep.yaml
refuses 3 "nested more than 8 levels deep" run deep.yaml
{ cat scene.yaml && printf 'effects: %s1%s\n' "$(repeat 100000 '[')" "$(repeat 100000 ']')"; } >deep.yaml
refuses 3 "nested more than 8 levels deep" run deep.yaml
{ cat scene.yaml && printf 'effects: [%s1]\n' "$(repeat 10001 '1,')"; } >many.yaml
refuses 3 "more than 10000 values" run many.yaml
{ cat scene.yaml && printf '# ' && head -c 16700000 /dev/zero | tr '\0' x && echo; } >large.yaml
run 0 run large.yaml -o out.csv
head -c 100000 /dev/zero | tr '\0' '\n' >>large.yaml
refuses 3 "larger than 16 MiB" run large.yaml
refuses 3 "larger than 16 MiB" sweep /dev/zero -o out.csv
printf 'a: &a [1]\nb: *a\n' >anchor.yaml # of these a small file makes a thousand million values
refuses 3 "anchor.yaml:1:4: an anchor" run anchor.yaml

# --- CSV: the length of a line, columns, lines of keys; any number of rows
{ printf '#' && repeat 65534 x && echo && cat ball.csv; } >line.csv
prints -x "$rows rows" check line.csv
{ printf '#' && repeat 65535 x && echo && cat ball.csv; } >line.csv
refuses 3 "line.csv:1:1: this line is longer than 64 KiB" check line.csv
head -c 100000000 /dev/zero | tr '\0' x >endless.csv
refuses 3 "longer than 64 KiB" check endless.csv
# wide N: a file of another program with N columns
wide() { awk -F, -v OFS=, -v n="$1" '/^#/ { next } { head = !seen++; for (i = NF + 1; i <= n; i++)
    $i = head ? "x" i : 1; print }' ball.csv; }
wide 1024 >wide.csv
prints -x "$rows rows" check wide.csv --k=-1 --J 1.4,2.1,3
wide 1025 >wide.csv
refuses 3 "more than 1024 columns" check wide.csv --k=-1 --J 1.4,2.1,3
keys=$(grep -c '^# .*: ' ball.csv)
# keyed N: a file with N lines of keys
keyed() { head -n 1 ball.csv && awk -v n=$(($1 - keys)) 'BEGIN { for (i = 0; i < n; i++) print "# key" i ": 1" }' &&
    tail -n +2 ball.csv; }
keyed 4096 >keys.csv
prints -x "$rows rows" check keys.csv
keyed 4097 >keys.csv
refuses 3 "more than 4096 lines '# key: value'" check keys.csv

# --- memory: a file is read row by row; 64 MiB hold 200000 rows of 27 MB and whatever comes
awk -F, -v OFS=, '/^#/ { print; next } !seen++ { print; next } { row[++n] = $0 }
    END { for (i = 0; i < 200000; i++) print row[i % n + 1] }' ball.csv >long.csv
if (ulimit -v 65536) 2>/dev/null && (ulimit -v 65536 && "$isoroll" --version) >/dev/null 2>&1; then
    checks=$((checks + 1))
    (ulimit -v 65536 && "$isoroll" convert --quiet --to point long.csv -o /dev/null >out 2>err)
    [ $? -le 1 ] || fail "a long file in little memory"
    check_not "a long file in little memory" grep -qi "memory" err
else
    skip "little memory" "ulimit -v does not work here, or isoroll needs more to start"
fi
# --- a line without end can be interrupted
if interruptible "a line without end"; then
    signalled INT "computed 20" check /dev/zero
    check "a line without end: Ctrl-C ends it" test $status -ne 0
fi
finish
