#!/bin/sh
# upgrade.sh ISOROLL - files that earlier states of isoroll wrote (../upgrade/README.md) are read rightly: they solve
# their equations, hold the orbits of their scenes, and convert to the orbits of the other model. So are files of
# big-endian machines.
. "$(dirname "$0")/lib.sh"
cp "$source"/tests/upgrade/* .
gzip -d ./*.gz
hdf5=yes
if ! "$isoroll" run free.yaml -o fresh.h5 2>err && grep -q "this build has no HDF5" err; then
    skip "files in HDF5" "isoroll was built without HDF5"
    hdf5=
fi
check "there are files of five states" test "$(ls [1-5]_*.csv [3-5]_*.h5 | cut -c1 | sort -u | wc -l)" -eq 5

# what the same scenes give today; states before 5 measured places along the ball's axes at time 0
"$isoroll" run free.yaml --as both -o free.now
"$isoroll" run point.yaml --as both -o point.now
for scene in twist plane effects; do "$isoroll" run $scene.yaml -o $scene.now; done
sed 's/attitude: {}/attitude: {quaternion: [1, 0, 0, 0]}/' effects.yaml >before.yaml
"$isoroll" run before.yaml -o before.now

# state 2 does not say these two
sed '1a # radius: 0.03' 2_effects.csv >radius && mv radius 2_effects.csv
sed '1a # radius: 0.5' 2_plane.csv >radius && mv radius 2_plane.csv

files=$(ls [1-5]_*.csv)
[ -z "$hdf5" ] || files="$files $(ls [1-5]_*.h5)"
for file in $files; do
    # one step from row to row has a relative error of 1e-12 at most; ten rows, and the two models' scales
    prints -x "10 rows" check "$file" --max 1e-10
    scene=${file#*_} scene=${scene%.*} now=${file#*_} now=${now%.*}
    case $file in [2-4]_effects*) now=before ;; esac
    case $file in *.csv) at_most "$file: the orbit of its scene" "$(difference "$file" $now.now)" 1e-9 ;; esac
    # every column can be chosen and comes back; the pictures know the axes of space
    if command -v gnuplot >/dev/null; then
        run 0 plot "$file" -o picture.svg
        check "$file: a picture" test -s picture.svg
    fi
    case $scene in free) to="point ball" ;; point) to="ball point" ;; plane) to=point ;; *) to= ;; esac
    for model in $to; do
        as=both
        case $file in 1_point*) [ $model = ball ] || continue ;; esac
        [ $scene != plane ] || as=point
        "$isoroll" run $scene.yaml --as $as -o wanted.csv
        run 0 convert --quiet --to $model "$file" -o converted.csv
        at_most "$file: to $model" "$(difference wanted.csv converted.csv)" 1e-9
    done
done
command -v gnuplot >/dev/null || skip "pictures of old files" "gnuplot is not installed"

# --- HDF5 files of machines that store the other end of a number first: the same numbers
if [ -n "$hdf5" ]; then
    mkdir big little
    mv big_endian_effects.h5 big/effects.h5
    mv 5_effects.h5 little/effects.h5
    mv big_endian_sweep.h5 big/sweep.h5
    mv little_endian_sweep.h5 little/sweep.h5
    for end in big little; do
        (cd $end && "$isoroll" check effects.h5 --max 1e-10 >checked 2>&1)
        check "a $end-endian trajectory" test $? -eq 0
        ! command -v gnuplot >/dev/null || (cd $end && "$isoroll" plot sweep.h5 --value state_n1 -o sweep.svg >said 2>&1)
    done
    check "ten rows are checked" grep -qx "10 rows" big/checked
    check "the same defects" cmp big/checked little/checked
    ! command -v gnuplot >/dev/null || check "the same picture of a sweep" cmp big/sweep.svg little/sweep.svg
fi

# --- sweeps, with a point that failed: their own layout of HDF5, and the line "columns" of CSV
numbers_of() { grep -v '^#' "$1"; }
if [ -n "$hdf5" ]; then
    run 1 sweep --merge 6_sweep_1.h5 6_sweep_2.h5 -o merged.csv
    says "1 points failed; the first is point 1: <sweep>:1:22: k = 0"
    numbers_of 6_sweep.csv >wanted
    numbers_of merged.csv >merged
    check "the parts of a sweep" cmp wanted merged
    run 1 sweep --merge 6_sweep_1.h5 6_sweep_2.h5 -o merged.h5
fi
for file in 6_sweep.csv ${hdf5:+6_sweep.h5 merged.h5}; do
    ! command -v gnuplot >/dev/null || { run 0 plot $file --value state_n1 -o "$file.svg"
        check "$file: the picture" cmp "$file.svg" 6_sweep.csv.svg; }
done

# --- a section that does not tell the order of its columns
if [ -n "$hdf5" ]; then
    prints -x "10 rows" check section.h5 --max 1e-10
    run 0 view section.h5 -o section.html
    check "both its orbits" test "$(grep -o '"kind": *"trajectory"' section.html | wc -l)" -eq 2
fi

# --- a file of a version that is not known yet is refused, by its number
sed 's/trajectory 1/trajectory 2/' 5_free.csv >later.csv
refuses 3 "expected version 1 of the trajectory format, not 2" check later.csv
finish
