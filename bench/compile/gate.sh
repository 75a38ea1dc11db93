#!/bin/sh
# Fails if the library instantiates more templates than `limits` allows: counts are the same on every machine and at
# every load, seconds are not. Some 20 s of CPU. Then the same of runtime chains (runtime.sh), and what is in registers
# (registers.sh).
#   sh bench/compile/gate.sh
#   sh bench/compile/gate.sh record      writes `limits` anew: what is counted now, and 10 %
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
CXX=g++  # by which the limits were counted
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
. "$root/bench/compile/chain.sh"
limits=$root/bench/compile/limits

# "functions classes" that a chain of $1 joints adds to those of the header; those of the header for no joints.
counted() {
  if [ "$1" = 0 ]; then
    instantiations header
  else
    serial "$1" >"$work/serial$1.cpp"
    counts=$(instantiations "serial$1")
    echo $((${counts% *} - ${of_header% *})) $((${counts#* } - ${of_header#* }))
  fi
}

failed=0
echo '#include <kte/kte.hpp>' >"$work/header.cpp"
grep '^#' "$limits" >"$work/limits"
printf '%-10s %22s %22s\n' joints 'functions (most)' 'classes (most)'
while read -r n most_functions most_classes; do
  case $n in '' | '#'*) continue ;; esac
  counts=$(counted "$n")
  if [ "$n" = 0 ]; then of_header=$counts; fi
  functions=${counts% *} classes=${counts#* }
  printf '%-10s %22s %22s\n' "$n" "$functions ($most_functions)" "$classes ($most_classes)"
  echo "$n $((functions * 11 / 10 + 5)) $((classes * 11 / 10 + 5))" >>"$work/limits"
  if [ "${1:-}" = record ]; then continue; fi
  if [ "$functions" -gt "$most_functions" ] || [ "$classes" -gt "$most_classes" ]; then
    echo "gate: a chain of $n joints instantiates more than bench/compile/limits allows, and will compile slowly" >&2
    failed=1
  fi
done <"$limits"

if [ "${1:-}" = record ]; then
  cp "$work/limits" "$limits"
elif [ "$failed" != 0 ]; then
  echo 'gate: find the change that did it; if it is worth it: sh bench/compile/gate.sh record' >&2
  exit 1
fi
sh "$root/bench/compile/runtime.sh" "$@"
sh "$root/bench/compile/docs.sh" "$@"
sh "$root/bench/compile/registers.sh" "$@"
