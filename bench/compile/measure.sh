#!/bin/sh
# Compile time and memory, user + system seconds and peak MB of one compiler run each, and the template instantiations
# that gate.sh counts.
#   CXX=clang++ CXXFLAGS="-O2 -I/opt/eigen" bench/compile/measure.sh
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
: "${CXX:=g++}" "${CXXFLAGS:=-O2 -isystem /usr/include/eigen3}"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. "$root/bench/compile/chain.sh"

measure() {
  if command time -f '%U %S %M' -o "$work/cost" $CXX -std=c++20 $CXXFLAGS -I"$root/include" -I"$root/examples" \
      -c "$work/$1.cpp" -o "$work/$1.o" 2>"$work/errors"; then
    awk -v what="$1" -v count="$(instantiations "$1")" '{
      split(count, n)
      printf "%-12s %8.2f %8.0f %10d %8d\n", what, $1 + $2, $3 / 1024, n[1], n[2] }' "$work/cost"
  else
    printf '%-12s   failed\n' "$1"
    head -n 5 "$work/errors"
  fi
}

echo '#include <kte/kte.hpp>' >"$work/header.cpp"
{
  echo '#include "robots/iiwa14.hpp"'
  use robots::iiwa14 7
} >"$work/iiwa14.cpp"

echo "$CXX $CXXFLAGS"
printf '%-12s %8s %8s %10s %8s\n' what s MB functions classes
measure header
measure iiwa14
for n in ${JOINTS:-7 30 100}; do
  serial "$n" >"$work/serial$n.cpp"
  measure "serial$n"
done
