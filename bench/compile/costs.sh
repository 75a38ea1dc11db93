#!/bin/sh
# What the builds below build/ cost: the twenty dearest units and the sum of each build, in seconds, in units of one
# `#include <Eigen/Core>` (g++ -O2) on this machine now, and in MB.
#   sh bench/compile/costs.sh          by the logs of ninja: seconds by the clock, no MB
#   sh bench/compile/costs.sh FILE     by what .ci/run has GNU time write into FILE: CPU seconds, peak memory
set -eu
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# CPU seconds of $@, user and system.
seconds() {
  sh -c '"$@" || exit; times' sh "$@" | awk 'NR == 2 { split($1 "m" $2, t, /[ms]+/); print 60 * t[1] + t[2] + 60 * t[3] + t[4] }'
}
echo '#include <Eigen/Core>' >"$work/unit.cpp"
unit=$(for _ in 1 2 3; do
  # shellcheck disable=SC2046
  seconds g++ -std=c++20 -O2 $(pkg-config --cflags eigen3) -c "$work/unit.cpp" -o "$work/unit.o"
done | sort -n | sed -n 2p)
echo "One #include <Eigen/Core>: $unit s"

# "seconds MB output" of every unit
if [ $# -gt 0 ]; then
  awk '{ for (i = 4; i < NF; ++i) if ($i == "-o") print $1 + $2, $3 / 1024, $(i + 1) }' "$1"
else
  for log in build/*/.ninja_log; do
    awk -F '\t' -v build="$(dirname "$log")" 'NR > 1 { print ($2 - $1) / 1000, 0, build "/" $4 }' "$log"
  done
fi >"$work/costs"
echo "     s  units    MB  of the twenty dearest"
sort -rn "$work/costs" | head -n 20 | awk -v unit="$unit" '{ printf "%6.1f %6.0f %5.0f  %s\n", $1, $1 / unit, $2, $3 }'
awk -v unit="$unit" '{ s += $1 } END { printf "All %d units: %.0f s, %.0f units\n", NR, s, s / unit }' "$work/costs"
