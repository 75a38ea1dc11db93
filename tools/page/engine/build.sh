#!/bin/sh
# Makes kte.wasm, which is checked in, by Debian's clang for WebAssembly:
#   apt-get install clang-14 lld-14 binaryen wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 \
#     libclang-rt-14-dev-wasm32 libeigen3-dev libboost-dev
set -e
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(sh sources.sh)

compile() {
  clang++-14 --target=wasm32-wasi -std=c++20 -Os -DNDEBUG -fwasm-exceptions -ffunction-sections -fdata-sections \
    -Wall -Wextra -Ilibrary/include -I../../../include -isystem /usr/include/eigen3 \
    -DKTE_NO_FORCED_INLINE -DKTE_NO_XSIMD -DEIGEN_DONT_VECTORIZE "-DKTE_PAGE_VERSION=\"$version\"" -c "$1" -o "$work/$(basename "$1").o"
}
for source in engine.cpp library/exceptions.cpp library/no_output.cpp; do compile $source; done
# Memory: 16 MiB to 1 GiB, 1 MiB of it the stack, at its start, so that what overflows it fails.
clang++-14 --target=wasm32-wasi -mexec-model=reactor -nodefaultlibs "$work"/*.o -o "$work/linked.wasm" -lc++ -lc++abi -lc \
  "$(clang++-14 -print-resource-dir)/lib/wasi/libclang_rt.builtins-wasm32.a" \
  -Wl,--gc-sections,--strip-all,-O2,-z,stack-size=1048576,--stack-first,--initial-memory=16777216,--max-memory=1073741824
wasm-opt -Oz --enable-exception-handling --strip-producers "$work/linked.wasm" -o "$work/kte.wasm"
if [ "$(sh sources.sh)" != "$version" ]; then
  echo "build.sh: sources have changed meanwhile; once more, please" >&2
  exit 1
fi
cp "$work/kte.wasm" kte.wasm
echo "kte.wasm: $version, $(wc -c <kte.wasm) bytes, $(gzip -9c kte.wasm | wc -c) gzipped"
