#!/bin/sh
# Fails if a program of README or docs, a block with `int main()`, instantiates more templates with kte::compiled than
# `docs_limits` allows. gate.sh calls it. Programs that use the same functions as one in that list are left out of it.
#   sh bench/compile/docs.sh
#   sh bench/compile/docs.sh record      writes `docs_limits` anew: what is counted now, and 5 %
#   sh bench/compile/docs.sh time        CPU seconds of g++ -O2 in units of #include <Eigen/Core>: docs/build.md
set -eu
. "$(dirname "$0")/limits.sh"

# Each program as a file; its name is that of the page and the line.
cd "$root"
for page in README.md docs/*.md; do
  case $page in docs/tutorial_*) continue ;; esac
  awk -v work="$work" -v page="$(basename "$page" .md)" '
    function finish() {
      if (program) { file = work "/" page "_" ++count ".cpp"; printf "#define KTE_COMPILED\n%s", text >file; close(file) }
      text = ""; program = within = 0
    }
    within && /^```/ { finish(); next }
    within { text = text $0 "\n"; if (/^int main\(/) program = 1; next }
    /^```cpp/ { within = 1 }' "$page"
done

if [ "$record" = time ]; then
  unit=$(sh bench/compile/unit.sh 3 | sort -n | sed -n 2p)
  for program in "$work"/*.cpp; do
    sh -c '"$@"; times' sh $CXX -std=c++20 -O2 -isystem /usr/include/eigen3 -Iinclude -Iexamples -c "$program" -o "$work/o" |
      awk -v unit="$unit" -v name="$(basename "$program" .cpp)" 'NR == 2 {
        split($1 "m" $2, t, /[ms]+/); s = 60 * t[1] + t[2] + 60 * t[3] + t[4]
        printf "%-14s %5.1f s %5.1f units\n", name, s, s / unit }'
  done
  exit
fi

limits_of docs_limits program functions classes
for name in $(sed -n 's/^\([^# ]*\) .*/\1/p' "$limits"); do
  [ -f "$work/$name.cpp" ] || { echo "$0: no program $name in README or docs any more" >&2; exit 1; }
  compare "$name" "$(instantiations "$name")" "$(sed -n "s/^$name //p" "$limits")"
done
finish
