# without_sundials.sh - the library and the command without SUNDIALS (ISO_SUNDIALS=OFF): what is left works as before, and
# what is missing is refused by name. Building takes a minute: at full length alone.
. "$(dirname "$0")/lib.sh"
[ "$(length short full)" = full ] || impossible "a build without SUNDIALS" "only at full length"
with=$isoroll
without=$work/build/isoroll
built() {
    cmake -S "$source" -B build -DISO_SUNDIALS=OFF -DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON -DISO_WERROR=ON -DISO_MPI=OFF -DISO_LIVE=OFF \
        -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="${CC:-cc}" && cmake --build build -j 2
}
checks=$((checks + 1))
built >build.log 2>&1 || { fail "no build without SUNDIALS"; grep -E 'error|warning' build.log | head -n 5 >&2; finish; exit; }

# --- what is missing, and nothing else
check_not "nothing of SUNDIALS is linked" sh -c "ldd $without build/libisoroll.so | grep -i sundials"
check "isoroll.pc does not ask for it" sh -c "! grep -i sundials build/isoroll.pc"
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
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 1 >ball.yaml
for method in adams cvode-bdf dormand_prince; do
    refuses 2 "'$method'" run ball.yaml --method $method
    says "built without SUNDIALS"
    { cat ball.yaml && echo "solver: {method: $method}"; } >method.yaml
    refuses 3 "'$method'" run method.yaml
    says "built without SUNDIALS"
done

# --- the rest: the same numbers
for method in auto rk8pd msadams bsimp; do
    run 0 run ball.yaml --method $method -o without.csv
    check "$method" "$with" run ball.yaml --method $method -o with.csv
    check "$method: the same bytes" cmp with.csv without.csv
done
{ cat ball.yaml && echo 'effects: {twist: {resistance: 1.0e+6}}'; } | sed 's/reduced: {/&D: 0.7, /' >stiff.yaml
run 0 run stiff.yaml -o stiff.csv
check "a stiff model: bsimp" grep -q '^# method: bsimp$' stiff.csv
check "with SUNDIALS: bdf" sh -c "'$with' run stiff.yaml | grep -q '^# method: bdf$'"
run 0 cost ball.yaml
finish
