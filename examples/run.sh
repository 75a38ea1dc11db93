#!/bin/sh
# Builds the examples for this machine, in build/examples, and runs them. No arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

echo "Building the examples in build/examples"
cmake --preset examples
cmake --build --preset examples
for example in pendulum arm swing reach own_element; do
  echo "Running $example"
  (cd build/examples/examples && ./$example)
done
