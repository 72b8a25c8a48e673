#!/bin/sh
# view_page.sh ISOROLL - pages of isoroll view in a real Chromium (view_page.py, view_shown.py).
. "$(dirname "$0")/lib.sh"
run 0 view --help
if [ "$(length short full)" = short ]; then
    skip "pages in a browser" "they are tried at full length alone"
    finish
    exit
fi
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
        for script in view_page.py view_shown.py; do in_browser "$script"; done
    fi
fi
finish
