#!/bin/sh
# Makes kte.wasm, which is checked in, by Debian's clang for WebAssembly:
#   apt-get install clang-14 lld-14 llvm-14 wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32 libeigen3-dev libboost-dev
set -e
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=$(sh sources.sh)

compile() {
  clang++-14 --target=wasm32-wasi -std=c++20 ${OPTIMISE:--Os} -DNDEBUG -fwasm-exceptions -ffunction-sections -fdata-sections \
    -Wall -Wextra -Ilibrary/include -I../../../include -isystem /usr/include/eigen3 \
    -DKTE_NO_FORCED_INLINE -DEIGEN_DONT_VECTORIZE "-DKTE_PAGE_VERSION=\"$version\"" "$@"
}
compile -c engine.cpp -o "$work/engine.o"
compile -c library/exceptions.cpp -o "$work/exceptions.o"
clang++-14 --target=wasm32-wasi -mexec-model=reactor -nodefaultlibs "$work/engine.o" "$work/exceptions.o" -o kte.wasm \
  -lc++ -lc++abi -lc /usr/lib/llvm-14/lib/clang/14.0.6/lib/wasi/libclang_rt.builtins-wasm32.a \
  -Wl,--gc-sections,--strip-all,-O2,-z,stack-size=1048576,--stack-first,--max-memory=1073741824
sum=$(sh sources.sh)
[ "$sum" = "$version" ] || echo "build.sh: the sources have changed meanwhile" >&2
ls -l kte.wasm
