#!/bin/sh
# versions.sh VERSION: the version of CMakeLists.txt stands in all files that state one. Run it in the folder of kte.
set -e
version=$1
fail() {
  echo "$1 does not state version $version" >&2
  exit 1
}
stated=$(sed -n 's/^#define KTE_VERSION_[A-Z]* //p' include/kte/version.hpp | paste -s -d .)
[ "$stated" = "$version" ] || fail include/kte/version.hpp
grep -qx "version: $version" CITATION.cff || fail CITATION.cff
grep -qx "version = \"$version\"" pyproject.toml || fail pyproject.toml
grep -qF "## [$version]" CHANGELOG.md || fail CHANGELOG.md
grep -qF "\"kte $version\"" share/man/man1/kte.1 || fail share/man/man1/kte.1
