#!/bin/sh
# CPU seconds that one `#include <Eigen/Core>` takes by g++ -O2 now: the unit in which the cost of compiling is told.
#   sh bench/compile/unit.sh [N]    once, or N times
set -eu
object=$(mktemp)
trap 'rm -f "$object"' EXIT
for _ in $(seq "${1:-1}"); do
  # shellcheck disable=SC2046
  echo '#include <Eigen/Core>' | sh -c '"$@" || exit; times' sh \
    g++ -std=c++20 -O2 $(pkg-config --cflags eigen3) -x c++ -c - -o "$object" |
    awk 'NR == 2 { split($1 "m" $2, t, /[ms]+/); print 60 * t[1] + t[2] + 60 * t[3] + t[4] }'
done
