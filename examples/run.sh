#!/bin/sh
# Builds the examples for this machine, in build/examples, and runs them. No arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

echo "Building the examples in build/examples"
cmake --preset examples
cmake --build --preset examples
for example in pendulum arm swing reach cart_pole own_element; do
  echo "Running $example"
  (cd build/examples/examples && ./$example)
done
echo "Running evaluate: what its file says is odd, then a table of dynamics, by a runtime chain and by a type compiled here"
robot=tests/data/robots/iiwa14.urdf
build/examples/examples/evaluate --check $robot
for how in "" --static; do
  build/examples/examples/evaluate $robot examples/evaluate/iiwa14.csv $how | cut -c 1-120
done
echo "Testing evaluate as a program: arguments, files, the programs that it keeps"
sh tests/programs/evaluate.sh build/examples/examples/evaluate
