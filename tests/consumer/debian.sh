#!/bin/sh
# debian.sh BUILD WORK CXX: makes the Debian packages of a build, unpacks them in an empty root, and compiles and runs with
# what is there.
set -e
build=$1 work=$2 cxx=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work/root"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
for package in "$work"/*.deb; do
  dpkg-deb --field "$package" Package Version Depends
  dpkg-deb -x "$package" "$work/root"
done
"$work/root/usr/bin/kte" --version
flags() {
  PKG_CONFIG_PATH=$work/root/usr/share/pkgconfig pkg-config "$@"
}
# shellcheck disable=SC2046
"$cxx" -std=c++20 $(flags --cflags kte) "$here/main.cpp" -o "$work/main"
# shellcheck disable=SC2046
"$cxx" -std=c++20 $(flags --cflags kte-compiled) "$here/compiled.cpp" -o "$work/compiled" $(flags --libs kte-compiled)
"$work/main"
"$work/compiled"
