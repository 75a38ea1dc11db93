#!/bin/sh
# clang-tidy with .clang-tidy over the headers of include/kte, in one translation unit: a minute or two. Fails if it finds
# something. No arguments; any directory. Needs clang-tidy and what the headers include.
set -e
cd "$(dirname "$0")/../.."
mkdir -p build/tidy
find include/kte -name '*.hpp' ! -path '*/detail/*' ! -name compiled.hpp ! -path '*/compiled/*' | sort |
  sed 's|^include/\(.*\)$|#include <\1>|' >build/tidy/headers.cpp
clang-tidy --quiet build/tidy/headers.cpp -- -std=c++20 -DKTE_NO_FORCED_INLINE -Iinclude \
  $(pkg-config --cflags eigen3 tinyxml2 | sed 's/-I/-isystem /g') >build/tidy/found 2>build/tidy/errors || true
if grep -E '(warning|error): ' build/tidy/found; then exit 1; fi
if grep -E 'error: ' build/tidy/errors; then exit 1; fi
