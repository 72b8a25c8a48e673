#!/bin/sh
# machines.sh ISOROLL - what happens where something is missing: 64 bits, glibc, libraries.
. "$(dirname "$0")/lib.sh"
cc=${CC:-cc}

# --- 32 bits are refused, in words
echo 'int main(void) { return 0; }' >empty.c
if "$cc" -m32 empty.c -o empty 2>/dev/null; then
    check_not "32 bits are refused" cmake -S "$source" -B narrow -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS=-m32
    cmake -S "$source" -B narrow -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS=-m32 >out 2>err
    check "and it says why" grep -q "isoroll needs a 64-bit processor and compiler" err
else
    skip "32 bits" "$cc cannot compile for them here"
fi

scene -1 "1.4, 2.1, 3.0" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 5 0.5 >scene.yaml
run 0 run scene.yaml -o ball.csv

# --- musl, a C library without GNU's functions: everything but HDF5 compiles. Libraries for it are not at hand.
if [ "$(length short full)" = full ] && has musl-gcc "musl"; then
    mkdir -p musl
    for header in gsl sundials cvode arkode nvector sunmatrix sunlinsol sunnonlinsol yaml.h; do
        [ ! -e /usr/include/$header ] || ln -s /usr/include/$header musl/
    done
    find "$source/lib" -name '*.c' ! -name 'hdf5*' ! -name 'arb_*' ! -name variant.c >files
    check "there are files" test "$(wc -l <files)" -ge 100
    while read -r file; do
        checks=$((checks + 1))
        musl-gcc -std=c11 -D_DEFAULT_SOURCE -Werror=implicit-function-declaration -fsyntax-only -I "$source/lib" \
            -I musl "$file" 2>err || fail "musl: $file"
    done <files
fi

# --- without HDF5, Arb, MPI, three.js and SUNDIALS: the library and the command are built, and say what they lack. What
# is left works as before. Not optimised: the compiler then makes no fused multiply-adds.
[ "$(length short full)" = full ] || { finish && exit; }
with=$isoroll without=$work/bare/isoroll
built() {
    cmake -S "$source" -B bare -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0 \
        -DISO_WERROR=ON -DISO_HDF5=OFF -DISO_ARB=OFF -DISO_MPI=OFF -DISO_LIVE=OFF -DISO_SUNDIALS=OFF \
        -DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON -DISO_THREE_JS= -DBUILD_TESTING=OFF && cmake --build bare -j 2
}
checks=$((checks + 1))
built >build.log 2>&1 || { fail "a bare build"; grep -E 'error|warning' build.log | head -n 5 >&2; finish; exit; }
isoroll=$without
refuses 2 "this build has no HDF5" run scene.yaml -o bare.h5
refuses 2 "this build has no Arb" prove scene.yaml
refuses 2 "built without three.js" view scene.yaml -o page.html
check_not "nothing of SUNDIALS is linked" sh -c "ldd $without bare/libisoroll.so | grep -i sundials"
check "isoroll.pc does not ask for it" sh -c "! grep -i sundials bare/isoroll.pc"
isoroll=$with
run 0 list methods
grep -v -E '^  [a-z0-9_]+ +(cvode|arkode) ' out >rest
check "SUNDIALS has methods" test "$(wc -l <rest)" -lt "$(wc -l <out)"
isoroll=$without
run 0 list methods
check "all methods but those of SUNDIALS" cmp rest out
run 0 --version
check_not "no version of it" grep SUNDIALS out

# --- refused by name, on the command line and in a scene
for method in adams cvode-bdf dormand_prince; do
    refuses 2 "'$method'" run scene.yaml --method $method
    says "built without SUNDIALS"
    { cat scene.yaml && echo "solver: {method: $method}"; } >method.yaml
    refuses 3 "'$method'" run method.yaml
    says "built without SUNDIALS"
done

# --- the rest: the same numbers
for method in rk8pd msadams bsimp; do
    run 0 run scene.yaml --method $method -o without.csv
    check "$method" "$with" run scene.yaml --method $method -o with.csv
    check "$method: the same rows" test "$(difference with.csv without.csv)" = 0
done
run 0 run scene.yaml -o without.csv
at_most "the same rows by Taylor series" "$(difference ball.csv without.csv)" 1e-13
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >stiff.yaml
echo 'effects: {twist: {resistance: 1.0e+6}}' >>stiff.yaml
sed -i 's/reduced: {/&D: 0.7, /' stiff.yaml
run 0 run stiff.yaml -o stiff.csv
check "a stiff model: bsimp" grep -q '^# method: bsimp$' stiff.csv
check "with SUNDIALS: bdf" sh -c "'$with' run stiff.yaml | grep -q '^# method: bdf$'"
run 0 cost scene.yaml --quick
finish
