#!/bin/sh
# What kte.wasm is made of, as it says itself: the version of kte, and sums of the engine's sources and of the headers.
set -e
cd "$(dirname "$0")"
root=../../..
sum() { LC_ALL=C sort | xargs sha256sum | sha256sum | cut -c1-12; }
version=$(sed -n 's/^project(kte VERSION \([0-9.]*\).*/\1/p' $root/CMakeLists.txt)
engine=$(find . -name '*.cpp' -o -name '*.hpp' -o -path './library/include/*' -o -name '*.sh' | sum)
headers=$(cd $root/include && find kte -name '*.hpp' | sum)
echo "kte $version, engine $engine, headers $headers"
