#!/bin/sh
# ./nook on a project of one file: builds on first use, runs at once later, builds again after a change, keeps the
# caller's folder and arguments and the program's exit code, and shows why a build failed.
# Usage: nook_script_test.sh REPOSITORY
set -eu
repository=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export NOOK_NO_INSTALL=1 NOOK_JOBS=1
root="$folder/a clone"  # a space in the path
mkdir -p "$root/.ci" "$root/host" "$root/cmake" "$root/kernels" "$root/glsl" "$root/scenes" "$folder/elsewhere"
cp "$repository/nook" "$root/"
cp "$repository/.ci/packages" "$root/.ci/"
cat >"$root/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(fake C)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
add_executable(nook host/main.c)
add_custom_target(nook_scenes)
END
program() {
  printf '#include <stdio.h>\n#include <unistd.h>\nint main(int n, char** a) { char cwd[4096]; getcwd(cwd, 4096);'
  printf 'printf("%s:%%s:%%s:%%d", cwd, a[1], n); return 7; }\n' "$1"
}
failures=0
expect() { # WHAT GOT WANTED
  if [ "$2" != "$3" ]; then
    printf '%s: got "%s", wanted "%s"\n' "$1" "$2" "$3"
    failures=$((failures + 1))
  fi
}
run() { # runs ./nook; leaves $out, $err and $code
  code=0
  out=$(cd "$folder/elsewhere" && "$root/nook" "$@" 2>"$folder/err") || code=$?
  err=$(cat "$folder/err")
}

program one >"$root/host/main.c"
run 'an argument' b
expect 'first use' "$out" "one:$folder/elsewhere:an argument:3"
expect "the program's exit code" "$code" 7
expect 'it says that it builds' "${err%% in *}" 'nook: building'

run x
expect 'second use' "$out $err" "one:$folder/elsewhere:x:2 "

mkdir -p "$folder/bin" && ln -s "$root/nook" "$folder/bin/nook-link"
out=$(cd "$folder/elsewhere" && "$folder/bin/nook-link" x 2>&1) || :
expect 'through a link' "$out" "one:$folder/elsewhere:x:2"

sleep 0.01
program two >"$root/host/main.c"
run x
expect 'after a change' "$out" "two:$folder/elsewhere:x:2"

sleep 0.01
echo 'broken' >"$root/host/main.c"
run x
expect 'a build that fails: exit code' "$code" 1
expect 'a build that fails: no run' "$out" ''
case $err in *"main.c:1"*"nook: building failed; the whole log is $root/build/nook-build.log"*) ;; *)
  expect 'a build that fails: says why' "$err" 'the compiler message and where the log is' ;;
esac

program three >"$root/host/main.c"
run x
expect 'mended' "$out" "three:$folder/elsewhere:x:2"

mv "$root" "$folder/moved"
root="$folder/moved"
rm "$root/build/.nook-built"
run x
expect 'after the folder moved' "$out" "three:$folder/elsewhere:x:2"
exit $failures
