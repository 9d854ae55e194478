#!/bin/sh
# SPDX-License-Identifier: MIT
# The main job on a file that this project makes itself: look at it, check it, place it in the
# world, convert it, compare. Run by `make demo`.
set -eu

bin=$(cd "$1" && pwd)
examples=$(cd examples && pwd)
out=$2
mkdir -p "$out"
say() { printf '\n== %s\n' "$*"; }
run() {
  echo "\$ kinefile $*"
  "$bin/kinefile" "$@"
}
# A difference or a fault is what these steps are there to show; every other failure ends the demo.
run_that_may_end_in_1() {
  run "$@" && return
  code=$?
  [ "$code" -eq 1 ] || return "$code"
  echo "(exit code 1)"
}

say "A walk of 10 seconds, made by examples/make_walk"
"$bin/make_walk" "$out/walk.bvh" 600 60
cd "$out"
ls -s --block-size=1 walk.bvh

say "What is in it?"
run info walk.bvh

say "Is anything wrong with it?"
run check walk.bvh

say "Where is every joint, in every frame?"
run fk walk.bvh --tips -o walk_world.csv --force
echo "$(($(wc -l <walk_world.csv) - 1)) rows in walk_world.csv, among them:"
grep -m 3 -E '^300,.*(Hips|Head|LeftToe),' walk_world.csv

say "Other rotation orders move the same; other tools read CSV and JSON"
run convert walk.bvh walk_xyz.bvh --order XYZ --force
run diff walk.bvh walk_xyz.bvh --tolerance 1e-9
run convert walk.bvh walk.csv --force
run convert walk.bvh walk.json --force

say "The same walk as Acclaim's skeleton and motion, and back: every joint in its place"
run convert walk.bvh walk.amc --force
run info walk.amc --quiet
run convert walk.amc walk_again.bvh --quiet --force
run diff walk.bvh walk_again.bvh --tolerance 1e-9
echo "The skeleton is the same: the helper bones that ASF needs, *_kf_helper, are taken out on the way back. Offsets"
echo "may differ in their last digit, and the root's OFFSET, which its position channels replace, is 0:"
diff walk.bvh walk_again.bvh | grep OFFSET || [ $? -eq 1 ]

say "Time warping: what frame 150 showed, frame 160 shall show"
run warp walk.amc --key 150:160 --quiet -o walk_later.amc --force
echo '$ kinefile warp walk.amc --key 150:160 --table'
"$bin/kinefile" warp walk.amc --key 150:160 --table --quiet | sed -n '1,4p;160,162p'
run fk walk.amc --quiet --frames 150:151 --joints LeftFoot
run fk walk_later.amc --quiet --frames 160:161 --joints LeftFoot

say "Other rates, mirrors, loops"
run resample walk.amc --fps 30 --quiet -o walk_30.bvh --force
run edit walk_30.bvh mirror trim=:60 loop=3,blend=10 in-place -o walk_loop.bvh --force
run info walk_loop.bvh

say "The same walk as Choreonoid's body motion: each joint a link, in metres, z up"
run convert walk.bvh walk.seq --quiet --force
run info walk.seq
run fk walk.seq --frames 300:301 --joints link0

say "A robot of 19 links bows: poses at times of their own become 50 frames a second"
cp -f "$examples/robot.body" "$examples/robot.urdf" "$examples/bow.seq" .
run info robot.body --quiet
run convert bow.seq bow_50.seq --timed-rounding slerp --quiet --force
run info bow_50.seq
run fk bow_50.seq --skeleton robot.body --frames 40:41 --joints PELVIS,LEG_L_ANKLE_R,HEAD_P
run fk bow_50.seq --skeleton robot.urdf --frames 40:41 --joints PELVIS,LEG_L_ANKLE_R,HEAD_P
run convert bow_50.seq bow.bvh --skeleton robot.body --quiet --force

say "A hobby robot waves: its RobovieMaker motion is a program with a loop"
cp -f "$examples/wave.txt" "$examples/servos.yaml" .
run info wave.txt
run check wave.txt
run run wave.txt --loops 2 --trace
run run wave.txt --loops 2 --servo-map servos.yaml --skeleton robot.body -o wave.seq --force
run info wave.seq

say "The bow as a motion of servo poses: at most eight, as close as can be, and how it plays back"
run keyframe bow_50.seq --servo-map servos.yaml --skeleton robot.body --poses 8 -o bow.txt --force
run check bow.txt
run run bow.txt --servo-map servos.yaml --skeleton robot.body -o bow_played.bvh --quiet --force
run info bow_played.bvh

say "A file that was cut off is told with its place"
head -c 20000 walk.bvh >cut.bvh
run_that_may_end_in_1 check cut.bvh

say "Look at it: the walk in yellow, and in blue its warp, in a page that needs no network"
if run view walk.amc walk_later.amc -o walk.html --quiet --force; then
  echo "Open build/demo/walk.html in a browser."
else
  echo "(This build has no page; make web builds it.)"
fi

say "The files are in $out; the command is $1/kinefile"
