#!/bin/sh
# Builds and runs all tests: unit tests under sanitizers first, by clang++ if there is one, then everything by g++. No
# arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages python3-dev pybind11-dev python3-numpy python3-scipy python3-pandas python3-matplotlib python3-pip \
  python3-pytest python3-hypothesis python3-distributed mypy lld

export CXX=g++ warnings_fail=OFF
if echo 'int main() {}' | clang++ -x c++ - -fsanitize=address,undefined -o /dev/null 2>/dev/null; then
  CXX=clang++ warnings_fail=ON
fi
echo "Unit tests under AddressSanitizer and UndefinedBehaviorSanitizer by $CXX, in build/asan"
cmake --preset asan -D CMAKE_COMPILE_WARNING_AS_ERROR=$warnings_fail
cmake --build --preset asan
ctest --preset asan

export CXX=g++
echo "All tests by $CXX, in build/tests"
cmake --preset tests
cmake --build --preset tests
ctest --preset tests --output-log build/tests/ctest.log
