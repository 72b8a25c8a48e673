#!/bin/sh
# python.sh ISOROLL - the package of apps/python: its tests in tests/python, among them the tutorial of examples, and the
# documents' code. Its library is the shared one of $ISO_BUILD. $ISO_PYTHON: a Python to use.
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
export ISOROLL_LIBRARY="$ISO_BUILD/libisoroll.so.0" ISO_COMMAND="$isoroll" ISO_SOURCE="$source"
export ISOROLL_COMMAND="$isoroll"
export PYTHONDONTWRITEBYTECODE=1
find_python numpy
[ -n "$python" ] || impossible "the Python package" "python3-numpy is not installed"

# --- the tests
for file in "$source"/tests/python/test_*.py; do
    name=$(basename "$file" .py)
    PYTHONPATH=$source/apps/python "$python" -W error::ResourceWarning "$file" >out 2>err
    status=$?
    ran=$(sed -n 's/^Ran \([0-9]*\) test.*/\1/p' err)
    checks=$((checks + ${ran:-0}))
    echo "$name: ${ran:-no} tests"
    [ "$status" -eq 0 ] && [ "${ran:-0}" -gt 0 ] || { fail "$name"; cat err >&2; }
done

# --- a library that the loader finds by itself
check "found by its name" env -u ISOROLL_LIBRARY LD_LIBRARY_PATH="$ISO_BUILD" PYTHONPATH="$source/apps/python" \
    "$python" -c "import isoroll"

# --- the code of its README, in a folder with a scene
cp "$source/examples/15_two_spheres/scene.yaml" .
sed -n '/^```python/,/^```$/{/^```/d;p;}' "$source/apps/python/README.md" >readme.py
check "the README has code" test "$(wc -l <readme.py)" -ge 15
checks=$((checks + 1))
PYTHONPATH=$source/apps/python "$python" readme.py >out 2>err || fail "the README's code"
check "it writes a trajectory" "$isoroll" check --max 1e-9 point.csv

# --- what test_tables.py and test_tutorial.py pass over
for module in matplotlib pandas; do
    "$python" -c "import $module" 2>/dev/null || skip "what takes $module" "python3-$module is not installed"
done
finish
