#!/bin/sh
# What the builds below build/ cost: the twenty dearest units and the sum of each build, in seconds, in units of one
# `#include <Eigen/Core>` (g++ -O2) on this machine, and in MB.
#   sh bench/compile/costs.sh                by the logs of ninja: seconds by the clock, no MB
#   sh bench/compile/costs.sh FILE UNITS     by what .ci/run has GNU time write into FILE: CPU seconds, peak memory; and
#                                            by what unit.sh printed from time to time meanwhile, in UNITS
set -eu
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [ $# -gt 1 ]; then cp "$2" "$work/units"; else sh bench/compile/unit.sh 3 >"$work/units"; fi
unit=$(awk '{ s += $1 } END { print s / NR }' "$work/units")
sort -n "$work/units" | awk -v unit="$unit" '
  { s[NR] = $1 } END { printf "One #include <Eigen/Core>: %.2f s, mean of %d, from %.2f to %.2f\n", unit, NR, s[1], s[NR] }'

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
