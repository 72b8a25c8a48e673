#!/bin/sh
# colours.sh ISOROLL - colours of pictures: all are of one table; lines of a plot are told apart without red cones,
# without green cones, and in grey (colours.py). The scripts are those of --script.
. "$(dirname "$0")/lib.sh"
needs gnuplot "pictures"
needs python3 "how colours are seen"
palette=$source/apps/isoroll/pictures/page.gp
for file in "$source"/apps/isoroll/plot/*.[ch] "$source"/apps/isoroll/pictures/*.gp; do
    case $file in
    */page.gp) ;;
    *) check_not "colours outside of page.gp: $file" grep -q "#[0-9A-F]\{6\}\|'0x[0-9A-F]\{6\}" "$file" ;;
    esac
done

# drawn NAME ARGUMENT...: a picture; its script is NAME.gp
drawn() {
    name=$1
    shift
    run 0 "$@" --script "$name.gp"
}
scene 0.5 "1, 2, 5" "0.9, -0.3, -0.225" "0.36, 0.48, 0.8" 10 0.1 >scene.yaml
run 0 run scene.yaml -o run.csv
run 0 run "$source/examples/10_bowl/scene.yaml" --t-end 4 --step 0.02 -o bowl.csv
run 0 run "$source/examples/02_neumann_shell/scene.yaml" --tol 1e-6 -o shell.csv
for table in run bowl shell; do drawn $table plot $table.csv -o picture.svg; done
drawn compare compare scene.yaml --plot picture.svg
drawn indicators chaos scene.yaml --turns 30 --plot picture.svg
drawn chaos chaos scene.yaml --turns 300 --starts 20 --plot picture.svg
drawn section section scene.yaml --starts 10 --crossings 50 -o section.csv --plot picture.svg
drawn lines frequencies scene.yaml --turns 50 --plot picture.svg
drawn momentum frequencies "$source/examples/02_neumann_shell/scene.yaml" --plot picture.svg
drawn splitting splitting scene.yaml --k 0.5,0.6,0.7 --digits double --plot picture.svg
drawn orbits periodic scene.yaml --period 2 --plot picture.svg
drawn follow periodic scene.yaml --period 1 --follow k=0.4:0.5 --plot picture.svg
drawn chart periodic scene.yaml --chart J2 --steps 4 --plot picture.svg
drawn cost cost scene.yaml --quick --plot picture.svg
printf 'scene: scene.yaml\nvary: {k: [-1, -0.5, 0.5, 1], J1: [1, 1.1]}\nmeasure: {state: {}}\n' >sweep.yaml
run 0 sweep sweep.yaml -o sweep.csv
drawn sweep plot sweep.csv -o picture.svg --value state_n1
run_python() { python3 -B "$here/colours.py" "$palette" "$@" >seen 2>&1; }
if run_python ./*.gp; then check "colours" true; else fail "colours: $(tail -n 5 seen)"; fi

# the law fails where it must: vermillion and green alike without red cones, lines alike in grey, a scale that turns
echo "plot \$a w l lc rgb '#D55E00', \$b w l lc rgb '#8C8C00'" >bad.gp
check_not "red and olive" run_python bad.gp ./*.gp
echo "plot \$a w l dt 1 lc rgb '#0072B2', \$b w l dt 1 lc rgb '#D55E00'" >bad.gp
check_not "blue and vermillion in grey" run_python bad.gp ./*.gp
echo "set palette defined (0 '#440154', 1 '#FDE725', 2 '#440154')" >bad.gp
check_not "a scale that turns back" run_python bad.gp ./*.gp
finish
