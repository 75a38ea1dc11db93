#!/bin/sh
# versions.sh VERSION: the version of CMakeLists.txt stands in all files that state one, and recipes of packages state the
# licence. Run it in the folder of kte.
set -e
version=$1
fail() {
  echo "$1 does not state $2" >&2
  exit 1
}
# states FILE WORDS: it has a line with these words
states() {
  grep -qF -- "$2" "$1" || fail "$1" "$2"
}
stated=$(sed -n 's/^#define KTE_VERSION_[A-Z]* //p' include/kte/version.hpp | paste -s -d .)
[ "$stated" = "$version" ] || fail include/kte/version.hpp "$version"
states CITATION.cff "version: $version"
states pyproject.toml "version = \"$version\""
states CHANGELOG.md "## [$version]"
states share/man/man1/kte.1 "\"kte $version\""
states packaging/vcpkg/kte/vcpkg.json "\"version-semver\": \"$version\""
states packaging/vcpkg/kte/vcpkg.json '"license": "MIT"'
states packaging/conan/conanfile.py "version = \"$version\""
states packaging/conan/conanfile.py 'license = "MIT"'
states packaging/conda/meta.yaml "set version = \"$version\""
states packaging/conda/meta.yaml 'license: MIT'
states packaging/ros/package.xml "<version>$version</version>"
states packaging/ros/package.xml '<license file="LICENSE">MIT</license>'
