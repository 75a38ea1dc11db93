#!/bin/sh
# Fails if the library instantiates more templates than `limits` allows: counts are the same on every machine and at
# every load, seconds are not. Some 20 s of CPU. Then the same of runtime chains (runtime.sh) and of the programs of the
# documentation (docs.sh), and what is in registers (registers.sh).
#   sh bench/compile/gate.sh
#   sh bench/compile/gate.sh record      writes `limits` anew: what is counted now, and 10 %
set -eu
. /work/hC/bench/compile/limits.sh
allowed() { echo $(($1 * 11 / 10 + 5)); }

# Functions and classes that a chain of N joints adds to those of the header; those of the header for N = 0.
limits_of limits joints functions classes
echo '#include <kte/kte.hpp>' >"$work/header.cpp"
of_header=$(instantiations header)
while read -r n most; do
  case $n in '' | '#'*) continue ;; esac
  if [ "$n" = 0 ]; then
    compare 0 "$of_header" "$most"
  else
    serial "$n" >"$work/serial$n.cpp"
    counts=$(instantiations "serial$n")
    compare "$n" "$((${counts% *} - ${of_header% *})) $((${counts#* } - ${of_header#* }))" "$most"
  fi
done <"$limits"
finish

