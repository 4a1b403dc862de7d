#!/bin/bash
# package_test.sh installed|subdirectory SOURCES BUILD: see CMakeLists.txt.
set -euo pipefail
way=$1 sources=$2 build=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$sources/examples/embed.cpp" "$folder"
{
  echo 'cmake_minimum_required(VERSION 3.25)'
  echo 'project(mine LANGUAGES C CXX)'
  if [ "$way" = installed ]; then
    echo 'find_package(nook 0.1 REQUIRED)'
  else
    echo "add_subdirectory($sources nook)"
    echo 'if(TARGET nook)'
    echo '  message(FATAL_ERROR "the program is built though nobody asked for it")'
    echo 'endif()'
  fi
  echo 'add_executable(embed embed.cpp)'
  echo 'target_link_libraries(embed PRIVATE nook::nook)'
} >"$folder/CMakeLists.txt"

prefix=$folder/prefix
type=Release
if [ "$way" = installed ]; then
  cmake --install "$build" --prefix "$prefix" >"$folder/install.log"
  ls "$prefix"/lib/*/libnook.so.0.1 >/dev/null 2>&1 || ls "$prefix"/lib/libnook.so.0.1 >/dev/null
  # Every symbol that the library gives away has the project's version, and none is of what it is made with.
  library=$(find "$prefix" -name 'libnook.so.*.*.*')
  symbols=$(nm -D --defined-only "$library" | awk '{print $3}')
  echo "$symbols" | grep -q '_ZN4nook13SceneRenderer.*@@NOOK_'
  if echo "$symbols" | grep -v '4nook.*@@NOOK_\|^NOOK_'; then
    echo "symbols of others, or without a version, are visible"
    exit 1
  fi
else
  type=None  # no optimisation: all of nook is compiled once more
fi
cmake -S "$folder" -B "$folder/build" -DCMAKE_BUILD_TYPE=$type -DCMAKE_PREFIX_PATH="$prefix" >"$folder/configure.log" ||
  { cat "$folder/configure.log"; exit 1; }
cmake --build "$folder/build" -j "$(nproc)" --target embed >"$folder/build.log" 2>&1 || { tail -40 "$folder/build.log"; exit 1; }
cd "$folder"
./build/embed 2>embed.err || { cat embed.err; exit 1; }
[ -s pyramid.exr ] && [ -s pyramid.png ]
# The same bits from either way: what the program makes of the same mesh.
{
  printf 'v %s\n' '-3 0 -3' '3 0 -3' '3 0 3' '-3 0 3' '-1 0 -1' '1 0 -1' '1 0 1' '-1 0 1' '0 1.5 0'
  printf 'f %s\n' '1 4 3' '1 3 2' '5 9 6' '6 9 7' '7 9 8' '8 9 5'
} >pyramid.obj
printf '%s\n' '[input]' 'objfile = "pyramid.obj"' '[camera]' 'frame = true' '[renderer]' 'type = "ao"' 'spp = 64' >pyramid.toml
"$build/bin/nook" render pyramid.toml --size 320x240 --quiet -o program.exr
"$build/bin/nook" compare pyramid.exr program.exr --fail 0 --hard-fail 0
