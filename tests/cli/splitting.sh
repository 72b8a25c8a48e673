#!/bin/sh
# splitting.sh ISOROLL - `isoroll splitting`: k = 1, scans, zeros, JSON, CSV, pictures, refusals, the
# table of a document. Values of other programs and of more digits: test_splitting_k, test_splitting_levels.
. "$(dirname "$0")/lib.sh"

scene 0.5 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >half.yaml
quietly splitting half.yaml
check "one row" grep -q '^ *0.5 .* 6.14708829830.*e-03 ' out

# --- a list, as CSV
quietly splitting half.yaml --digits double --k=0.5,3/4,1,-1/2 -o split.csv -j 2
check "k = 1: words" grep -q ' 0 .*not distinguishable from 0: below ' out

# --- a zero
scene 1 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.5 >wide.yaml
quietly splitting wide.yaml --k=-1.7,-1.5 --digits double --json
shows out '"k": -1.6024081' '"next": {'
prints 'where the manifolds touch' splitting wide.yaml --k=-1.7,-1.5 --digits double
run 0 splitting wide.yaml --k 0.9,1.1 --digits double
check_not "none at k = 1" grep -q 'm = 0 at' out

# --- the table of lib/doc/why_only_one.md: "K M", where 64 bits are enough; or those with a star
table() {
    awk -F'|' -v star="$1" '
        NF != 5 || $2 !~ /^ [0-9]+(\/[0-9]+)? $/ || $2 == " 1 " { next }
        { for (i = 3; i <= 4; i++) if (($i ~ /\*/) == star) { m = $i; gsub(/[ *]/, "", m); k = $2; gsub(/ /, "", k)
                                                            print (i == 3 ? "" : "-") k, m } }
    ' "$source/lib/doc/why_only_one.md"
}

# holds_table DIGITS K: m is that of the page, within its error, and above 100 errors, for K of the file `wanted`
holds_table() {
    run 0 splitting half.yaml --digits "$1" --k="$2" -o split.csv
    checks=$((checks + 1))
    awk -F '[, ]' 'NR == FNR { k[NR] = $1; m[NR] = $2; rows = NR; next }
        /^[-0-9]/ && $8 == 0 { d = $3 - m[++n]; size = $3 < 0 ? -$3 : $3; if (d < 0) d = -d
                               if (!(d <= 6e-7 * size + $4 && size > 100 * $4)) { print k[n], $3, $4; bad = 1 } }
        END { exit bad || n != rows || n == 0 }' wanted split.csv >wrong || fail "the table: $(head -n 3 wrong)"
}
table 0 | awk -v step="$(length 24 1)" 'NR % step == 0' >wanted
check "rows of the table" test -s wanted
holds_table double "$(cut -d ' ' -f 1 wanted | paste -s -d , -)"
if [ "$(length 0 1)" = 1 ] && "$isoroll" list methods | grep -q -w taylor_quad; then # one by one: zeros are slow
    for row in $(table 1 | awk 'NR % 8 == 0 { print $1 "=" $2 }'); do
        echo "${row%=*} ${row#*=}" >wanted
        holds_table auto "${row%=*}"
    done
fi

# --- ranges through 0 and through 1
run 1 splitting half.yaml --digits double --k=-0.1:0.1:0.1 -o split.csv
says "1 of 3 values of k failed: k = 0"
check "0 is told" grep -q '^ *0  k = 0' out
run 0 splitting half.yaml --digits double --k=0.95:1.05:0.05
check_not "k = 1 is no further zero" grep -q 'm = 0 at' out
run 0 splitting half.yaml --digits double --k=-1.05:-0.95:0.1
check_not "nor is -1, between two values" grep -q 'm = 0 at' out

# --- levels: 1 the scene's; many (the numbers: test_splitting_levels)
cat >level.yaml <<END
point: {k: 0.5, J: [1.4, 2.1, 3], eps: 1}
initial: {gamma: [0.6, 0, 0.8], M: [0, 0.5, 0]}
time: {end: 1, step: 1}
END
prints "^level of the point, (H/eps) J2^(1/k): -0.19928916282" splitting level.yaml --digits double -o split.csv
run 0 splitting half.yaml --digits double --level=-0.2:0.2:0.2 -o split.csv
check "as many levels" test "$(rows split.csv | wc -l)" -eq 3
check "0 is 0" test "$(cell split.csv 1 level)" = 0
refuses 3 "oscillation between two places of rest" splitting half.yaml --level=-0.9
run 1 splitting half.yaml --digits double --level=-0.9,0
says "1 of 2 values of the level failed"

# --- JSON: the contract
run 0 splitting half.yaml --json
for key in rows k x m error digits; do check "JSON: $key" grep -q "\"$key\":" out; done
check "JSON: digits" grep -q '"digits": 19' out

# --- Ctrl-C
refuses 5 "nowhere" splitting half.yaml -o nowhere/split.csv
if interruptible "splitting after SIGINT"; then
    one_k() { grep -q '^ *0.3 ' out; }
    interrupted_when one_k splitting half.yaml --digits double -j 1 --k 0.3:3:0.0001
    says "interrupted: "
    check "what is done" one_k
fi

# --- refusals
for k in 1/0 1:2:3:4 '1,,2' x nan 1:2:1e-9 1e999; do
    refuses 2 "expected values and ranges" splitting half.yaml --k "$k"
done
refuses 2 "double, quad or auto" splitting half.yaml --digits few
refuses 2 "choose one" splitting half.yaml -o - --json
finish
