# view_live.sh ISOROLL - `isoroll view --live`: what it refuses, and the laboratory in a real Chromium (view_live.py).
. "$(dirname "$0")/lib.sh"
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.1 >scene.yaml
last="view --live -o lab.html"
if ! "$isoroll" view --live -o lab.html 2>err; then
    says "this isoroll was built without the library as WebAssembly"
    check "no page" test ! -e lab.html
    impossible "a laboratory" "isoroll was built with ISO_LIVE=OFF"
fi
silent
# own PAGE: without three.js, which is each system's own
own() { awk '/^<script>$/ && !seen++ { out = 1 } !out; /^<\/script>$/ { out = 0 }' "$1"; }
if [ ! -e "${ISO_BUILD-}/live/library.txt" ]; then # else the library is another one
    own lab.html >lab.own
    own "$source/examples/25_laboratory/laboratory.html" >kept.own
    check "the page in examples/25_laboratory is that of: view --live -o laboratory.html" cmp lab.own kept.own
fi
run 0 view scene.yaml --live -o scene.html
run 0 view scene.yaml -o plain.html
check "the page of a scene has no library" test "$(grep -c -i webassembly plain.html)" = 0
tr -d '\n' <scene.html >line.html
check "a policy that allows no request" grep -q \
    "content=\"default-src 'none'; [^\"]*script-src 'unsafe-inline' *'wasm-unsafe-eval'; worker-src blob: *\"" line.html
check "that of --live has it" grep -q "id=\"library\"" scene.html
{ cat scene.yaml && echo 'effects: {field: {linear: [0, 0, 0.1]}}'; } >field.yaml
refuses 3 "field.yaml:4:18: --live computes with level, rotor and gravity, and the scene has 'field'" \
    view field.yaml --live -o no.html
run 0 run scene.yaml -o run.csv
refuses 2 "view: --live computes from a scene: 'run.csv' is none" view run.csv --live -o no.html
check "no page" test ! -e no.html

if [ "$(length short full)" = short ]; then
    skip "a laboratory in a browser" "it is tried at full length alone"
    finish
    exit
fi
if ! has chromium "a laboratory in a browser" || ! has python3 "a laboratory in a browser"; then
    finish
    exit
fi
in_browser view_live.py
finish
