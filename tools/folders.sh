#!/bin/sh
# Draws which folder of include/kte includes which, from the #include lines, as docs/pictures/folders.svg.
#   sh tools/folders.sh          writes the picture
#   sh tools/folders.sh check    fails if the picture is out of date, or if folders include each other
# An arrow is left out if a longer path implies it.
set -eu
cd "$(dirname "$0")/.."
picture=docs/pictures/folders.svg
drawn=$(mktemp)
trap 'rm -f "$drawn"' EXIT

find include/kte -mindepth 2 -name '*.hpp' | LC_ALL=C sort |
  xargs awk '
    # FOLDER INCLUDED HEADER, a line for each folder that another includes.
    /^#[ ]*include <kte\/[a-z_]+\// {
      split(FILENAME, own, "/"); split($0, other, "/")
      if (own[3] != other[2] && !((own[3], other[2]) in seen)) {
        seen[own[3], other[2]] = 1
        print own[3], other[2], FILENAME
      }
    }' | LC_ALL=C sort | awk -f tools/folders.awk >"$drawn"

if [ "${1-}" = check ]; then
  if ! cmp -s "$drawn" "$picture"; then
    echo "kte: $picture does not show the present #include lines: run sh tools/folders.sh" >&2
    exit 1
  fi
else
  cp "$drawn" "$picture"
fi
