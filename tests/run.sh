#!/bin/sh
# Builds and runs all tests: unit tests under sanitizers first, then everything. No arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages

echo "Unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, in build/asan"
cmake --preset asan
cmake --build --preset asan
ctest --preset asan

echo "All tests, in build/tests"
cmake --preset tests
cmake --build --preset tests
ctest --preset tests --output-log build/tests/ctest.log
