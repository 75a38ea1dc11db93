#!/bin/sh
# Evaluations a second and core of batches, and the gain by threads: sh bench/threads.sh [compiler options]
set -e
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
${CXX:-g++} -std=c++20 -O3 -march=native -fno-math-errno -DNDEBUG "$@" -Iinclude -Ibench -Iexamples \
  -I/usr/include/eigen3 bench/threads.cpp -o "$folder/threads" -pthread
"$folder/threads"
