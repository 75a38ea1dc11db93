#!/bin/sh
# single_header.sh WORK CXX OPTIONS: README's first program compiles with the single header alone, and runs. In the folder of
# kte.
set -e
work=$1
shift
mkdir -p "$work"
python3 tools/single_header.py "$work/kte_static.hpp" "$@"
awk '/^```cpp$/ { ++n; next } /^```$/ && n == 1 { exit } n == 1' README.md | sed 's#<kte/kte.hpp>#"kte_static.hpp"#' >"$work/main.cpp"
grep -q kte_static.hpp "$work/main.cpp"
"$@" -std=c++20 -O0 "$work/main.cpp" -o "$work/main"
"$work/main" | grep -q 'rad/s^2, tip at'
