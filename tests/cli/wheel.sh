#!/bin/sh
# wheel.sh ISOROLL - the wheel that the build made in $ISO_BUILD/wheel: what is in it, what it needs, whether it gives
# the bits of the command in a virtual environment. ../wheel.sh tries it where nothing else of ours is installed.
. "$(dirname "$0")/lib.sh"
: "${ISO_BUILD:?}"
find_python "numpy, pip, venv"
[ -n "$python" ] || impossible "the wheel" "python3-numpy or python3-pip is not installed"
wheel=$(ls "$ISO_BUILD"/wheel/*.whl 2>/dev/null)
[ -n "$wheel" ] || impossible "the wheel" "the build made none: cmake --build $ISO_BUILD --target wheel says why"
pack=$source/apps/python/pack.py
export PYTHONDONTWRITEBYTECODE=1
unset ISOROLL_LIBRARY LD_LIBRARY_PATH PYTHONPATH SOURCE_DATE_EPOCH

# --- what is in it
version=$("$isoroll" --version | head -n 1 | sed 's/[^0-9]*\([0-9.]*\).*/\1/')
"$python" -m zipfile -l "$wheel" >list
about=isoroll-$version.dist-info
for file in isoroll/__init__.py isoroll/py.typed isoroll/_instruments.pyi isoroll/libisoroll.so.0 "isoroll-$version.data/scripts/isoroll" \
    "$about/METADATA" "$about/licenses/LICENSE" "$about/licenses/NOTICES"; do
    check "the wheel has $file" grep -q "^$file " list
done
check "every module" test "$(grep -c '^isoroll/.*\.py ' list)" -eq "$(find "$source/apps/python/isoroll" -name "*.py" | wc -l)"

# --- pip installs it
checks=$((checks + 1))
{ "$python" -m venv --without-pip --system-site-packages there &&
    there/bin/python -m pip --disable-pip-version-check install --quiet --no-index "$wheel"; } >out 2>err ||
    fail "pip install"
home=$(echo "$work"/there/lib/python3*/site-packages)
library=$home/isoroll/libisoroll.so.0
for word in GSL SUNDIALS HDF5 libyaml jansson three.js; do
    check "the notices name $word" grep -q "^  $word " "$home/$about/licenses/NOTICES"
done

# --- what it needs: glibc, no older one than its name says; and it exports what the library does
oldest=${wheel##*manylinux_2_}
oldest=${oldest%%_*}
for file in "$library" there/bin/isoroll; do
    name=$(basename "$file")
    objdump -T "$file" | sed -n 's/.*GLIBC_2\.\([0-9]*\).*/\1/p' | sort -n | tail -n 1 >newest
    at_most "$name: glibc 2.N" "$(cat newest)" "$oldest"
    objdump -p "$file" | sed -n 's/^ *NEEDED *//p' | grep -vxE 'lib(c|m)\.so\.6|ld-linux.*' >others
    check "$name: nothing but glibc, not $(cat others)" test ! -s others
done
echo "glibc 2.$oldest or later; $(wc -c <"$wheel") bytes"
case $(getconf GNU_LIBC_VERSION 2>/dev/null) in # which functions get new versions in later ones is not known
'glibc 2.3'[0-6]) at_most "glibc of RHEL 9, Ubuntu 22.04, Debian 12: 2.N" "$oldest" 34 ;;
esac
for file in "$library" "$ISO_BUILD/libisoroll.so.0"; do
    nm -D --defined-only "$file" | sed 's/.* //' | sort >"$(basename "$(dirname "$file")").names"
done
check "it exports what the library exports" cmp isoroll.names "$(basename "$ISO_BUILD").names"
check "there are names" test "$(wc -l <isoroll.names)" -gt 80

# --- its library and its command have the bits of the command; methods of GSL and SUNDIALS too
cp "$source/examples/15_two_spheres/scene.yaml" .
cat >use.py <<'END'
import sys
import isoroll
for method in sys.argv[1:]:
    isoroll.write(isoroll.run("scene.yaml", method=method), f"python_{method}.csv")
with open("/proc/self/maps") as maps:
    print(*sorted({line.split()[-1] for line in maps if "/" in line and ".so" in line}), sep="\n")
END
methods="taylor rk8pd bsimp adams verner_8_5_6"
"$isoroll" list methods >known
for method in $methods; do check "there is the method $method" grep -q -w "$method" known; done
checks=$((checks + 1))
# shellcheck disable=SC2086 # a list
env -i there/bin/python use.py $methods >maps 2>err || fail "isoroll in the virtual environment"
check "the library of the wheel is loaded" grep -qxF "$library" maps
check "no library that it has inside" test -z "$(grep -E '/lib(gsl|sundials|yaml|jansson|hdf5)' maps)"
for method in $methods; do
    run 0 run --method "$method" scene.yaml -o command.csv
    check "$method: Python has the command's bits" cmp command.csv "python_$method.csv"
    check "$method: its command has them" env -i there/bin/isoroll run --method "$method" scene.yaml -o there.csv
    check "$method: its command has them" cmp command.csv there.csv
done

# --- HDF5 is inside
if ! "$isoroll" run scene.yaml -o system.h5 2>err && grep -q "no HDF5" err; then
    skip "HDF5 in the wheel" "this build has none"
else
    cat >hdf5.py <<'END'
import isoroll
t = isoroll.run("scene.yaml")
isoroll.write(t, "wheel.h5")
assert (isoroll.read("wheel.h5").array == t.array).all()
with open("/proc/self/maps") as maps:
    assert "libhdf5" not in maps.read()
END
    check "HDF5 in Python" env -i there/bin/python hdf5.py
    check "HDF5 in the command" env -i there/bin/isoroll run scene.yaml -o there.h5
    check "the same rows" env -i there/bin/isoroll check there.h5 --max 1e-8
fi

# --- the packer: the same bytes again, one date; and it refuses what needs other libraries
mkdir again dynamic
cp "$ISO_BUILD"/wheel/libisoroll.so.0 "$ISO_BUILD"/wheel/isoroll "$ISO_BUILD"/wheel/NOTICES "$ISO_BUILD"/wheel/_instruments.pyi again
check "a wheel again" "$python" "$pack" wheel again
check "it has the same bytes" cmp "$wheel" "again/$(basename "$wheel")"
check "another date" env SOURCE_DATE_EPOCH=1000000000 "$python" "$pack" wheel again
check "of 2001" sh -c "'$python' -m zipfile -l again/*.whl | grep -q 'METADATA *2001-09-09'"
cp again/* dynamic
cp "$ISO_BUILD/libisoroll.so.0" dynamic
"$python" "$pack" wheel dynamic >out 2>err
check "it refuses a library that needs GSL" grep -q 'libisoroll.so.0 cannot be in a wheel: it needs .*libgsl' err

# --- the sources: packed again, from what was packed, they are the same bytes
check "the sources are packed" "$python" "$pack" sdist first
mkdir unpacked
tar -xf "first/isoroll-$version.tar.gz" -C unpacked
check "pip finds the packer" grep -qF 'backend-path = ["apps/python"]' "unpacked/isoroll-$version/pyproject.toml"
check "packed again" "$python" "unpacked/isoroll-$version/apps/python/pack.py" sdist second
check "the same bytes" cmp "first/isoroll-$version.tar.gz" "second/isoroll-$version.tar.gz"
check "they configure" cmake -S "unpacked/isoroll-$version" -B build -DBUILD_TESTING=OFF
if [ "$(length short full)" = full ]; then # not optimised, to be quick; tests/wheel.sh compares bytes
    checks=$((checks + 1))
    export CMAKE_ARGS="-DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DISO_LIVE=OFF"
    "$python" -m pip --disable-pip-version-check wheel --quiet --no-build-isolation --no-index --no-deps \
        "first/isoroll-$version.tar.gz" -w third >out 2>err || fail "pip wheel"
    check "pip makes a wheel of them" test -s "third/$(basename "$wheel")"
fi
finish
