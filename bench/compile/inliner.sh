#!/bin/sh
# Fails if g++ spends 5 % of its time in the inliner on a source of the library: then forced-inline code calls many
# functions that are not (include/kte/detail/inline.hpp), which costs a time that is quadratic in the number of calls.
# Shares hardly depend on the load of the machine. It compiles every source once.
#   sh bench/compile/inliner.sh src/*.cpp
#   sh bench/compile/inliner.sh      the parts in include/kte/compiled, each as a source of its own
set -eu
. "$(dirname "$0")/limits.sh"

if [ $# = 0 ]; then
  for part in "$root"/include/kte/compiled/*.hpp; do
    source=$work/$(basename "$part" .hpp).cpp
    grep '^#include <kte/compiled/' "$part" >"$source" || true
    printf '#include <kte/detail/compiled_here.hpp>\n#include <kte/compiled/%s>\n' "$(basename "$part")" >>"$source"
    set -- "$@" "$source"
  done
fi
slow=""
printf '%-32s %20s %20s\n' source 's of the inliner' 'share, % (below 5)'
for source; do
  $CXX -std=c++20 -O2 -DKTE_COMPILED -isystem /usr/include/eigen3 -I"$root/include" -ftime-report \
    -c "$source" -o "$work/o" 2>"$work/report" || { cat "$work/report" >&2; exit 1; }
  row=$(awk -F: '
    / ipa inlining heuristics/ { split($2, of_inliner, " ") }
    / TOTAL/ { split($2, of_all, " "); printf "%20.1f %20.1f", of_inliner[1], 100 * of_inliner[1] / of_all[1] }' "$work/report")
  printf '%-32s %s\n' "$(basename "$source")" "$row"
  if awk -v row="$row" 'BEGIN { split(row, x); exit x[2] < 5 }'; then slow="$slow$source, "; fi
done
if [ "$slow" ]; then
  echo "$0: too much inlining in ${slow%, }" >&2
  exit 1
fi
