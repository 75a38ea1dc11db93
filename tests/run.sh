#!/bin/sh
# Builds and runs the tests in build/tests, by clang++, or by g++, which takes twice as long, where there is no clang++. No
# arguments; any directory.
set -e
cd "$(dirname "$0")/.."
. .ci/packages.sh
install_packages python3-dev pybind11-dev python3-numpy python3-scipy python3-pandas python3-matplotlib python3-pip \
  python3-pytest python3-hypothesis python3-distributed python3-xarray mypy lld
install_optional clang libclang-rt-14-dev || true

compiler=
if ! command -v clang++ >/dev/null 2>&1; then
  echo "No clang++ here, so by g++"
  compiler="-D CMAKE_CXX_COMPILER=g++ -D CMAKE_COMPILE_WARNING_AS_ERROR=OFF"
fi
cmake --preset tests $compiler
cmake --build --preset tests
ctest --preset tests --output-log build/tests/ctest.log
