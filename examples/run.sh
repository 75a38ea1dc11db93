#!/bin/sh
# Builds the examples for this machine, in build/examples, and runs them. No arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

echo "Building the examples in build/examples"
cmake --preset examples
cmake --build --preset examples
for example in pendulum arm swing reach cart_pole own_element pictures sweep; do
  echo "Running $example"
  (cd build/examples/examples && ./$example)
done
echo "Running kte: what its file says is odd, a table of dynamics, by a runtime chain and by a type compiled here, and a motion"
kte=build/examples/bin/kte
robot=tests/data/robots/iiwa14.urdf
$kte check $robot
for how in "" --static; do
  $kte eval $robot examples/robots/iiwa14_states.csv $how | cut -c 1-120
done
(cd build/examples && bin/kte simulate ../../$robot --time 2 --record motion.csv && bin/kte view ../../$robot motion.csv)
echo "Testing kte as a program: arguments, files, the programs that it keeps"
sh tests/programs/kte_eval.sh $kte
sh tests/programs/kte.sh $kte
sh tests/programs/kte_live.sh $kte
