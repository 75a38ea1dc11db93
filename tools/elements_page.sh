#!/bin/sh
# Writes the tables of docs/elements.md from the ports and parameters of the elements in include/kte/elements/all.hpp.
# Units, descriptions and examples stay; an element without a section gets one at the end of the page. The test
# "docs/elements.md has the tables of the elements" fails if the page is out of date.
#   sh tools/elements_page.sh
set -eu
cd "$(dirname "$0")/.."
program=$(mktemp)
trap 'rm -f "$program"' EXIT
# shellcheck disable=SC2046
${CXX:-g++} -std=c++20 -O0 -DKTE_NO_FORCED_INLINE -Iinclude $(pkg-config --cflags eigen3) tools/elements_page/main.cpp -o "$program"
"$program" docs/elements.md
