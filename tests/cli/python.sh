#!/bin/sh
<<<<<<< HEAD
# python.sh ISOROLL - the package of apps/python: its tests in tests/python, the documents' code, the example. Its
# library is the shared one of $ISO_BUILD. $ISO_PYTHON: a Python to use.
=======
# python.sh ISOROLL - the package of apps/python: its tests in tests/python, among them the tutorial of examples, the
# wheel, the documents' code. Its library is the shared one of $ISO_BUILD. $ISO_PYTHON: a Python to use.
>>>>>>> w-tutorial
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
export ISOROLL_LIBRARY="$ISO_BUILD/libisoroll.so.0" ISO_COMMAND="$isoroll" ISO_SOURCE="$source"
export ISOROLL_COMMAND="$isoroll"
export PYTHONDONTWRITEBYTECODE=1
python=
for candidate in ${ISO_PYTHON-} python3 /usr/bin/python3; do
    [ -n "$python" ] || ! "$candidate" -c "import numpy" 2>/dev/null || python=$candidate
done
if [ -z "$python" ]; then
    checks=1
    skip "the Python package" "python3-numpy is not installed"
    finish
    exit
fi

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

<<<<<<< HEAD
# --- the example
if "$python" -c "import matplotlib" 2>/dev/null; then
    checks=$((checks + 1))
    PYTHONPATH=$source/apps/python MPLCONFIGDIR=$work "$python" "$source/examples/20_python/sections.py" \
        sections.png >out 2>err || fail "the example"
    check "a picture" test "$(wc -c <sections.png)" -gt 20000
else
    skip "the example" "python3-matplotlib is not installed"
fi
=======
# --- the wheel: built without network, installed somewhere, used there
if "$python" -c "import setuptools, pip, wheel" 2>/dev/null; then
    cp -r "$source/apps/python" package
    checks=$((checks + 1))
    "$python" -m pip --disable-pip-version-check wheel --quiet --no-build-isolation --no-index --no-deps ./package \
        -w wheels >out 2>err || fail "pip wheel"
    checks=$((checks + 1))
    "$python" -m pip --disable-pip-version-check install --quiet --no-index --no-deps --target there wheels/*.whl \
        >out 2>err || fail "pip install"
    check "it is typed" test -f there/isoroll/py.typed
    version=$("$isoroll" --version | head -n 1 | sed 's/[^0-9]*\([0-9.]*\).*/\1/')
    check "the version of the wheel is $version" test -f "wheels/isoroll-$version-py3-none-any.whl"
    check "it works there" env PYTHONPATH="$work/there" "$python" -c \
        "import isoroll; assert 'there' in isoroll.__file__ and len(isoroll.run('scene.yaml')) == 301"
else
    skip "the wheel" "python3-pip, python3-setuptools or python3-wheel is not installed"
fi

# --- what test_tables.py and test_tutorial.py pass over
for module in matplotlib pandas; do
    "$python" -c "import $module" 2>/dev/null || skip "what takes $module" "python3-$module is not installed"
done
>>>>>>> w-tutorial
finish
