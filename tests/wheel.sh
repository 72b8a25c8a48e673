#!/bin/sh
# wheel.sh [SUITE...] - the wheel for Python where nothing else of ours is installed: pip makes it of the packed
# sources, and installs it in empty Debians with Python, NumPy and venv, by default bookworm and trixie. In bullseye,
# whose glibc is too old, pip refuses it. It needs root and debootstrap, and downloads. So it is run by hand.
ISO_SOURCE=${ISO_SOURCE:-$(cd "$(dirname "$0")/.." && pwd)}
suites=${*:-bookworm trixie bullseye}
build=$ISO_SOURCE/.build/wheel
set -- "$build/isoroll"
. "$ISO_SOURCE/tests/cli/lib.sh"

[ "$(id -u)" -eq 0 ] || impossible "an empty Debian" "only root can have one"
for tool in debootstrap cmake; do
    command -v $tool >/dev/null || impossible "an empty Debian" "$tool is not installed"
done
python=/usr/bin/python3

# --- the build's wheel, and pip's of the packed sources: the same bytes
start=$(date +%s)
{ nice cmake -S "$ISO_SOURCE" -B "$build" -DBUILD_TESTING=OFF -DISO_MPI=OFF &&
    nice cmake --build "$build" -j "$(nproc)" --target wheel --target isoroll_command --target sdist; } >log 2>&1 ||
    { cat log; exit 1; }
echo "compiled in $(($(date +%s) - start)) s"
start=$(date +%s)
checks=$((checks + 1))
nice $python -m pip wheel --quiet --no-build-isolation --no-index --no-deps "$build"/wheel/isoroll-*.tar.gz -w pip \
    >out 2>err || fail "pip wheel"
echo "pip wheel of the sources: $(($(date +%s) - start)) s"
wheel=$(ls "$build"/wheel/*.whl)
check "the same bytes" cmp "$wheel" "pip/$(basename "$wheel")"
cp "$ISO_SOURCE/examples/15_two_spheres/scene.yaml" .
run 0 run scene.yaml -o ball.csv

# inside COMMAND: a line for the shell of the Debian at $root
inside() {
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C \
        sh -ec "cd /tmp; $1" >out 2>err
}
# done_inside NAME COMMAND: and it succeeds
done_inside() {
    checks=$((checks + 1))
    inside "$2" || fail "$suite: $1"
}
# left: what is still mounted when the script ends
left() {
    for suite in $suites; do umount "$work/$suite/proc" 2>/dev/null; done
    rm -rf "$work"
}
trap left EXIT

cat >use.py <<'END'
import isoroll
t = isoroll.run("scene.yaml")
isoroll.write(t, "python.csv")
assert not [line for line in open("/proc/self/maps") if "libgsl" in line or "libsundials" in line or "libyaml" in line]
END
cat >hdf5.py <<'END'
import isoroll
t = isoroll.run("scene.yaml")
isoroll.write(t, "ball.h5")
assert (isoroll.read("ball.h5").array == t.array).all()
END
for suite in $suites; do
    root=$work/$suite
    nice debootstrap --variant=minbase --include=python3,python3-numpy,python3-venv "$suite" "$root" >log 2>&1 ||
        { skip "$suite" "debootstrap fails: $(tail -n 1 log)"; continue; }
    mount -t proc proc "$root/proc"
    cp /etc/resolv.conf "$root/etc/"
    cp "$wheel" scene.yaml use.py hdf5.py "$root/tmp/"
    done_inside "a virtual environment" 'python3 -m venv --system-site-packages there'
    glibc=$(chroot "$root" getconf GNU_LIBC_VERSION)
    if [ "$suite" = bullseye ]; then
        check_not "$suite: pip takes it, with $glibc" inside 'there/bin/pip install --no-index ./*.whl'
        check "$suite: it says why" grep -q 'not a supported wheel' err
        umount "$root/proc"
        continue
    fi
    check_not "$suite: nothing of ours" inside 'ls -R /usr/lib | grep -E "lib(gsl|sundials|yaml|jansson|hdf5|isoroll)"'
    start=$(date +%s)
    done_inside "pip installs it" 'there/bin/pip install --no-index ./*.whl'
    echo "$suite: $glibc, $(chroot "$root" python3 --version), pip install: $(($(date +%s) - start)) s"
    done_inside "isoroll in Python" 'there/bin/python use.py'
    done_inside "the command" 'there/bin/isoroll run scene.yaml -o command.csv'
    for by in python command; do check "$suite: $by: the same bits" cmp ball.csv "$root/tmp/$by.csv"; done
    done_inside "HDF5" 'there/bin/python hdf5.py'
    umount "$root/proc"
done
finish
