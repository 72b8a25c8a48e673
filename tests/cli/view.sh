#!/bin/sh
# view.sh ISOROLL - isoroll view without a browser: sizes, what a page may not contain, messages. view_page.sh tests
# pages in a browser.
. "$(dirname "$0")/lib.sh"
scene -1 "1, 2, 5" "0.8, 0.1, -0.6" "0.6, 0, 0.8" 30 0.1 >scene.yaml

# --- a build without three.js refuses
if "$isoroll" view scene.yaml -o page.html 2>&1 | grep -q "built without three.js"; then
    refuses 2 "package libjs-three" view scene.yaml -o page.html
    impossible "pages" "isoroll was built without three.js"
fi

# --- a page of each kind of input, at most 3 MB
# bytes FILE
bytes() {
    wc -c <"$1"
}
quietly view scene.yaml -o page.html
at_most "a page of a scene" "$(bytes page.html)" 3000000
run 0 view scene.yaml -o -
check "standard output" cmp out page.html
"$isoroll" view - -o - <scene.yaml | sed 's/<stdin>/scene.yaml/' >stdin.html
check "standard input" grep -q '"kind":"scene"' stdin.html
"$isoroll" run scene.yaml -o ball.csv
"$isoroll" run scene.yaml --as point -o point.csv
for file in ball.csv point.csv; do
    quietly view $file -o $file.html
    check "$file is a trajectory" grep -q '"kind":"trajectory"' $file.html
done
if "$isoroll" run scene.yaml -o ball.h5 2>/dev/null; then
    run 0 view ball.h5 -o h5.html
    check "HDF5" grep -q '"kind":"trajectory"' h5.html
else
    skip "HDF5" "this build has none"
fi
"$isoroll" section scene.yaml --starts 30 --crossings 300 --quiet -o section.csv
run 0 view section.csv -o section.html
check "a section" grep -q '"kind":"section"' section.html
at_most "a page of a section" "$(bytes section.html)" 3000000
if [ "$(length short full)" = full ]; then # 100 s: 10 ms for each of the 10000 that it shows
    awk -F, '/^#/ || !/^[0-9]/ { print; next } { row = $0; sub(/^[^,]*/, "", row); rows[n++] = row }
        END { for (i = 0; i < 10010; i++) printf "%.0f%s\n", i + 9e15, rows[i % n] }' section.csv >orbits.csv
    run 0 view orbits.csv -o orbits.html
    at_most "a page of 10010 orbits of one crossing" "$(bytes orbits.html)" 3000000
    check "the page says how many orbits it shows" grep -q "The section shows the first 10000 of 10010 orbits." orbits.html
fi
"$isoroll" run scene.yaml --step 0.001 -o many.csv
run 0 view many.csv -o many.html
check "rows are thinned out, and the page says so" grep -q '"total":"30001","every":"7"' many.html
at_most "a page of many rows" "$(bytes many.html)" 3000000

# --- an attitude is listed if the scene or the file states one; each page computes one to draw the ball
for stated in false true; do
    { cat scene.yaml && { [ $stated = false ] || echo 'effects: {attitude: {}}'; }; } >stated.yaml
    "$isoroll" run stated.yaml -o stated.csv
    for file in stated.yaml stated.csv; do
        run 0 view $file -o stated.html
        check "$file: stated, $stated" grep -q "\"attitude\":$stated,\"k\":" stated.html
    done
done

# --- nothing is loaded
policy="default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; script-src 'unsafe-inline' *"
tr -d '\n' <page.html >line.html
check "a policy that allows no request" grep -q "content=\"$policy\"" line.html
check_not "a source elsewhere" grep -Eiq '(src|href|action) *= *"?(https?:|//)|@import|url\((https?:|//)' page.html
check "the only link" test "$(grep -ci '<link' page.html)" -eq 1
for code in "$source"/apps/isoroll/view/*.js "$source"/apps/isoroll/view/*.css; do
    check_not "$code: fetch, XMLHttpRequest, WebSocket, innerHTML, eval" \
        grep -Eq 'fetch\(|XMLHttpRequest|WebSocket|sendBeacon|innerHTML|outerHTML|insertAdjacent|document\.write|eval\(|https?://' "$code"
done

# --- hostile names and lines
hostile='<img src=x onerror=alert(1)>&amp;"'
sed "1a # title: </script><script>alert(1)</script>" ball.csv >"$hostile.csv"
run 0 view "$hostile.csv" -o hostile.html
check_not "a tag of the file's name" grep -q '<img' hostile.html
check_not "a tag of the file's lines" grep -q 'alert(1)</script' hostile.html
check "as many scripts end as in another page" \
    test "$(grep -o '</script' hostile.html | wc -l)" -eq "$(grep -o '</script' page.html | wc -l)"
check "the name is there, escaped" grep -q 'u003cimg src=x onerror=alert(1)' hostile.html
name=$(printf 'b\377\303.csv') # no UTF-8
cp ball.csv "$name"
run 0 view "$name" -o utf8.html
check "a name that is no UTF-8" grep -q '"title":"[^"]*b??.csv"' utf8.html

# --- what a file lacks is named
refuses 2 "view: -o FILE is missing" view scene.yaml
run 0 run scene.yaml -o rows.csv
awk -F, -v OFS=, '/^[0-9]/ && ++row == 3 { $2 += 0.5 } { print }' rows.csv >third.csv
refuses 3 "third.csv: row 3: omega has a part" view third.csv -o page.html
refuses 2 "--k is for trajectories, and this is a scene" view scene.yaml --k 1 -o page.html
# without COLUMN...: ball.csv without these columns
without() {
    awk -F, -v drop=" $* " '/^#/ { print; next }
        !n { for (i = 1; i <= NF; i++) keep[i] = index(drop, " " $i " ") == 0; n = NF }
        { line = ""; for (i = 1; i <= n; i++) if (keep[i]) line = line (line == "" ? "" : ",") $i; print line }' ball.csv
}
without omega2 >a.csv
refuses 3 "a.csv: there is no column 'omega2'" view a.csv -o a.html
without t >a.csv
refuses 3 "there is no column 't' or 's': a page needs the time of each row" view a.csv -o a.html
without n1 n2 n3 omega1 omega2 omega3 >a.csv
refuses 3 "there is no column 'M1': a page needs omega1 ... n3 of the ball, or M1 ... gamma3" view a.csv -o a.html
grep -v '^# k' ball.csv >a.csv
refuses 3 "does not say its k" view a.csv -o a.html
head -n 12 ball.csv >a.csv
refuses 3 "at least two rows" view a.csv -o a.html
{ head -n 14 ball.csv; sed -n 13p ball.csv; } >a.csv
refuses 3 "row 4: its t = 0.1 is out of order" view a.csv -o a.html
refuses_changed ball.csv 's/^0.5,[^,]*,/0.5,nan,/' "expected a finite number for omega1" view -o a.html
refuses_changed section.csv 's/,l,x$/,l,y/' "there are no columns 'l' and 'x'" view -o b.html
refuses_changed section.csv '/^# eps/d; /^# h:/d' "'isoroll section --as ball'" view -o b.html
refuses_changed section.csv '20s/^[0-9]*/3.5/' "bad.csv: row 3: expected a whole number of 0 or more for orbit, found 3.5" \
    view -o b.html
check_not "no page of bad input" test -e b.html

if "$isoroll" section scene.yaml --starts 30 --crossings 300 --quiet -o section.h5 2>/dev/null; then
    run 0 view section.h5 -o section5.html
    check "a section in HDF5 gives the same page" test "$(sed 's/section.h5/section.csv/' section5.html | cksum)" = "$(cksum <section.html)"
    if python3 -c "import h5py" 2>/dev/null; then
        python3 -c "import h5py
with h5py.File('wide.h5', 'w') as f:
    f.attrs['format'] = 'isoroll section 1'
    for i in range(64):
        f['section/z%02d' % i] = [[1e99] * 4] * 2048"
        refuses 3 "wide.h5: more than 64 columns" view wide.h5 -o b.html
    else
        skip "HDF5 of too many columns" "python3-h5py is not installed"
    fi
fi
refuses 3 "the last time is 0" view - -o b.html <<END
reduced: {k: 1, J: [1, 2, 3]}
initial: {normal: [0, 0, 1], angular_velocity: [1, 0, 0]}
time: {end: 0, step: 1}
END

mkfifo pipe
cat section.csv >pipe &
refuses 3 "(a pipe is read as a scene: give a pipe of rows as -)" view pipe -o b.html
cat scene.yaml >pipe &
run 0 view pipe -o pipe.html


# --- times may run backwards
"$isoroll" run scene.yaml --t-end -3 -o back.csv
run 0 view back.csv -o back.html

# --- a ball without a point
cat >bowl.yaml <<END
reduced: {k: 1.5, J: [1, 2, 3]}
initial: {normal: [0.6, 0, 0.8], angular_velocity: [0.8, 1.5, -0.6]}
time: {end: 3, step: 0.1}
effects: {gravity: {mgb: -0.7, up: [0, 0.6, 0.8]}}
END
run 0 view bowl.yaml -o bowl.html
check "the page says why there is no point" grep -q '"alone":"[^"]*gravity' bowl.html

# --- the two computations of a chaotic scene part, and M and gamma are of one orbit
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 1000 0.1 >chaos.yaml
run 0 view chaos.yaml -o chaos.html
check "the page says from when on they part" grep -q '"notes":\["From t = [0-9.]* on the two computations part' chaos.html

# --- rows that are far apart
check_not "rows of a scene turn little" grep -q 'Rows turn by' page.html
"$isoroll" run scene.yaml --step 3 -o far.csv
run 0 view far.csv -o far.html
check "the page says that the motion between rows is a guess" \
    grep -q '"Rows turn by up to [0-9]* degrees: between them the motion is a guess."' far.html

# --- rows that are no orbit: there is a page, and words; exit status as of convert
cat >wrong.csv <<END
t,omega1,omega2,omega3,n1,n2,n3
0,0,1,0,1,0,0
1,0,0.3,0,0,0,1
2,0,0,7,0,1,0
END
run 1 view wrong.csv --k=-1 --J=1,2,5 -o wrong.html
check "words" grep -q "wrong.csv: rows are no orbit: the row at t = [12] is missed by 1" err
check "words on the page" grep -q '"Rows are no orbit: the row at t = [12] is missed by 1' wrong.html
awk -F, '/^-?[0-9]/ && ++n == 50 { sub(/^[^,]*/, "0.5") ; kept = $0; exit } END { print kept }' ball.csv >row
awk 'NR == FNR { wrong = $0; next } /^0.5,/ { $0 = wrong } { print }' row ball.csv >a.csv # another moment's state
run 1 view a.csv -o a.html
check "one wrong row among others" grep -q "rows are no orbit" err

# --- loss of contact
"$isoroll" run "$source/examples/09_off_the_top/scene.yaml" -o off.csv 2>/dev/null
run 0 view off.csv -o off.html
check "the page of its trajectory says that contact is lost" grep -q '"contact is lost at t = 0.79' off.html
finish
