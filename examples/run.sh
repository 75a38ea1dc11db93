#!/bin/sh
# Builds examples and runs them: in build/examples, for this machine, or as another preset builds them. Any directory.
#   sh examples/run.sh                  a pendulum and real arms, static and at run time, with speed and error
#   sh examples/run.sh all [PRESET]     all examples, and the program kte
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

preset=${2:-examples}
examples="pendulum arm"
targets="--target example_pendulum example_arm"
if [ "$1" = all ]; then
  examples="$examples swing reach cart_pole drop own_element pictures sweep"
  targets=
fi
echo "Building the examples in build/$preset: most of it is the library, once"
cmake --preset "$preset"
cmake --build --preset "$preset" $targets
for example in $examples; do
  echo "Running $example"
  (cd "build/$preset/examples" && ./$example)
done
if [ "$1" != all ]; then
  echo "All examples, and the program kte: sh examples/run.sh all"
  exit
fi
echo "Running kte: what its file says is odd, a table of dynamics, by a runtime chain and by a type compiled here, and a motion"
kte=build/$preset/bin/kte
robot=tests/data/robots/iiwa14.urdf
$kte check $robot
for how in "" --static; do
  $kte eval $robot examples/robots/iiwa14_states.csv $how | cut -c 1-120
done
(cd "build/$preset" && bin/kte simulate ../../$robot --time 2 --record motion.csv && bin/kte view ../../$robot motion.csv)
