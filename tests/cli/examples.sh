#!/bin/sh
# examples.sh ISOROLL - what the examples with more files show. (That every command takes them, and that their rows solve
# their model: every_command.sh; both models: compare.sh.)
. "$(dirname "$0")/lib.sh"

# potentials that separate: with another coefficient the same start is chaotic
folder=$source/examples/24_separable
for scene in scene rosochatius quartic; do
    prints -x "this orbit: regular" chaos "$folder/$scene.yaml" --model ball --turns 1500
done
sed 's/{c: 1}/{c: 1.05}/' "$folder/scene.yaml" >sea.yaml
prints -x "this orbit: chaotic" chaos sea.yaml --model ball

# trajectories from elsewhere
folder=$source/examples/14_from_python
run 0 convert --to point --scene "$folder/scene.yaml" "$folder/orbit.txt" -o point.csv
run 0 check --max 1e-9 point.csv
run 0 check --max 1e-9 --scene "$folder/scene.yaml" "$folder/orbit.txt"
run 0 convert --to ball --max-defect 1e-4 --k=-1 --J 6,4,2 --eps 0.5 --columns -,s,gamma1,gamma2,gamma3,M1,M2,M3 "$folder/leapfrog.csv" -o ball.csv
run 0 check --max 1e-3 ball.csv
if has gnuplot "a picture"; then run 0 plot --scene "$folder/scene.yaml" "$folder/orbit.txt" -o orbit.svg; fi
finish
