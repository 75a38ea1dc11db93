#!/bin/sh
# Fails if two parts of include/kte/compiled.hpp compile the same header of functions, which a part does if it does not
# include the part that has the header. Headers that a part reads in its own right, after kte/detail/compiled_here.hpp,
# are those that the whole has and the parts before have not.
#   sh tests/build/compiled_parts.sh CXX FLAGS...
set -eu
cd "$(dirname "$0")/../../include"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Those of the headers that a source includes which have functions or instantiations of kte::compiled.
headers() {
  "$@" -std=c++20 -DKTE_COMPILED -I. -M -x c++ - | tr -s ' \\' '\n' | sed -n 's|^\(\./\)*\(kte/.*\.hpp\)$|\2|p' |
    xargs grep -lE 'KTE_FUNCTION|KTE_EXTERN' | LC_ALL=C sort -u
}
for part in $(sed -n 's|^#include <\(kte/compiled/.*\)>.*|\1|p' kte/compiled.hpp); do
  grep '^#include <kte/compiled/' "$part" >"$work/before" || true
  headers "$@" <"$work/before" >"$work/used" || true
  { cat "$work/before"; printf '#include <kte/detail/compiled_here.hpp>\n#include <%s>\n' "$part"; } >"$work/source"
  headers "$@" <"$work/source" >"$work/all"
  LC_ALL=C comm -13 "$work/used" "$work/all" | grep -v '^kte/detail/' | sed "s|\$| in $part|" >>"$work/owned"
done
LC_ALL=C sort "$work/owned" | awk '$1 == header { print "kte: " $1 " is compiled" where " and in " $3; bad = 1 }
  { header = $1; where = " in " $3 }
  END { exit bad }'
