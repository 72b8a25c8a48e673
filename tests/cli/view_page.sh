#!/bin/sh
# view_page.sh ISOROLL - pages of isoroll view in a real Chromium (view_page.py), and pictures by --frames.
. "$(dirname "$0")/lib.sh"
run 0 view --help
browser=
for name in chromium chromium-browser google-chrome chrome; do
    [ -n "$browser" ] || ! command -v "$name" >/dev/null || browser=$name
done
if "$isoroll" view "$source/examples/15_two_spheres/scene.yaml" -o page.html 2>&1 | grep -q "built without three.js"; then
    skip "pages in a browser" "isoroll was built without three.js"
elif [ -z "$browser" ]; then
    skip "pages in a browser" "chromium is not installed"
elif has python3 "pages in a browser"; then
    python3 -B "$here/view_page.py" "$isoroll" "$source" "$work" >results 2>err || fail "view_page.py ended early"
    while read -r verdict words; do
        case $verdict in
        PASS) checks=$((checks + 1)) ;;
        FAIL) checks=$((checks + 1)) && fail "$words" ;;
        *) echo "$verdict $words" ;;
        esac
    done <results
    check "view_page.py came to its end" grep -q '^PASS the end' results

    # --- pictures
    cp "$source/examples/15_two_spheres/scene.yaml" .
    run 0 view scene.yaml --frames frames --fps 1 --seconds 3
    silent
    check "three pictures, and nothing else" test "$(ls -A frames | tr '\n' ' ')" = "frame0001.png frame0002.png frame0003.png "
    check "each is a PNG of 1280 x 720" test "$(for f in frames/*; do od -A n -t x1 -N 24 "$f"; done | tr -d ' \n')" = \
        "$(for f in 1 2 3; do printf 89504e470d0a1a0a0000000d4948445200000500000002d0; done)"
    check_not "they differ" cmp frames/frame0001.png frames/frame0002.png
fi
ln -s "$(command -v sh)" sh # a path without a browser
if [ -s page.html ]; then
    PATH=$work run 5 view "$source/examples/15_two_spheres/scene.yaml" --frames none --fps 1 --seconds 1
    check "words about Chromium" grep -q "cannot run Chromium: .*install it (package chromium)" err
fi
finish
