#!/bin/sh
# Builds the examples and runs them: in build/examples, for this machine, or as another preset builds them. Any directory.
#   sh examples/run.sh [PRESET]
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

preset=${1:-examples}
echo "Building the examples in build/$preset"
cmake --preset "$preset"
cmake --build --preset "$preset"
for example in pendulum arm swing reach cart_pole drop own_element pictures sweep; do
  echo "Running $example"
  (cd "build/$preset/examples" && ./$example)
done
echo "Running kte: what its file says is odd, a table of dynamics, by a runtime chain and by a type compiled here, and a motion"
kte=build/$preset/bin/kte
robot=tests/data/robots/iiwa14.urdf
$kte check $robot
for how in "" --static; do
  $kte eval $robot examples/robots/iiwa14_states.csv $how | cut -c 1-120
done
(cd "build/$preset" && bin/kte simulate ../../$robot --time 2 --record motion.csv && bin/kte view ../../$robot motion.csv)
