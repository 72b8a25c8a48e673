#!/bin/sh
# view_page.sh ISOROLL - pages of isoroll view in a real Chromium (view_page.py, view_shown.py), and pictures by --frames.
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
    if [ "${ISO_SANITIZE-0}" = 0 ]; then # the pages of isoroll with sanitizers are the same: cli/view.sh writes them
        for script in view_page.py view_shown.py; do
            in_browser "$script"
        done
    fi

    # --- pictures
    cp "$source/examples/15_two_spheres/scene.yaml" .
    run 0 view scene.yaml --frames frames --fps 1 --seconds 3
    silent
    check "three pictures, and nothing else" test "$(ls -A frames | tr '\n' ' ')" = "frame0001.png frame0002.png frame0003.png "
    check "each is a PNG of 1280 x 720" test "$(for f in frames/*; do od -A n -t x1 -N 24 "$f"; done | tr -d ' \n')" = \
        "$(for f in 1 2 3; do printf 89504e470d0a1a0a0000000d4948445200000500000002d0; done)"
    check_not "they differ" cmp frames/frame0001.png frames/frame0002.png
    cp frames/frame0001.png old.png
    refuses 5 "--frames: 'frames' has frame0003.png of an older film, and this one has 2 pictures" \
        view scene.yaml --frames frames --fps 1 --seconds 2
    check "nothing is overwritten" cmp frames/frame0001.png old.png
    name=$(printf '\nframe 0 data:image') # a file's name cannot forge a picture
    mkdir -p "$name/png;base64,QUJD"
    for name in 'frame 776 data:image/png;base64,QUJD' "$name/png;base64,QUJD"; do
        mkdir -p "$(dirname "$name")" && cp scene.yaml "$name.yaml"
        rm -rf forged
        run 0 view "$name.yaml" --frames forged --fps 1 --seconds 1
        check "one picture" test "$(ls -A forged)" = frame0001.png
        check "it is a PNG" test "$(od -A n -t x1 -N 4 forged/frame0001.png)" = " 89 50 4e 47"
    done
    setsid "$isoroll" view scene.yaml --frames stopped --fps 10 --seconds 100 2>err &
    group=$! # Chromium is in it too; SIGINT would be ignored in the background
    until [ -e stopped/frame0020.png ] || ! kill -0 $group; do sleep 0.1; done
    kill -TERM -$group
    wait $group
    check "interrupted pictures: status 1" test $? -eq 1
    check "interrupted pictures: words" grep -q "interrupted: [0-9]* pictures were drawn" err
fi
ln -s "$(command -v sh)" sh # a path without a browser
if [ -s page.html ]; then
    PATH=$work run 5 view "$source/examples/15_two_spheres/scene.yaml" --frames none --fps 1 --seconds 1
    check "words about Chromium" grep -q "cannot run Chromium: .*install it (package chromium)" err
fi
finish
