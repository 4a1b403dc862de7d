#!/bin/bash
# tests/tools/oclgrind_kernels.sh BUILD [FILTER]: every specialisation of the kernels with every traversal, on pictures of 4x3 pixels
# (tests/render/kernel_variants_test.cpp), interpreted by oclgrind with its checks for invalid accesses, data races and
# misuse of the API; then the program itself. A line each; exits 1 if any reports something or fails. Takes minutes.
set -u
build=$(realpath "$1")
filter=${2:-Scenes/KernelVariants.*}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export XDG_CACHE_HOME=$folder/cache OCLGRIND_CHECK_API=1 OCLGRIND_DATA_RACES=1
export OCLGRIND_BUILD_OPTIONS=-cl-opt-disable  # the interpreter lacks llvm.bitreverse
export NOOK_OPENCL=${NOOK_OPENCL:-/usr/lib/oclgrind/liboclgrind-rt.so}
failed=0

# clean NAME COMMAND...: the command succeeds, and nothing is on stderr.
clean() {
  local name=$1
  shift
  if "$@" >out 2>log && [ ! -s log ]; then
    echo "clean: $name"
  else
    echo "NOT CLEAN: $name"
    tail -20 out
    head -20 log
    failed=1
  fi
}

for name in $("$build/bin/nook_render_tests" --gtest_list_tests --gtest_filter="$filter" | sed -n 's/^  \([^ ]*\).*/\1/p'); do
  clean "$name" "$build/bin/nook_render_tests" --gtest_filter="*KernelVariants.$name"
done
# A wavy floor under a plate: triangles enough for a tree of two levels.
awk 'BEGIN { n = 12
  for (y = 0; y <= n; ++y) for (x = 0; x <= n; ++x) print "v", 4 * x / n - 2, 4 * y / n - 2, 0.05 * sin(1.7 * x) * cos(1.3 * y)
  for (y = 0; y < n; ++y) for (x = 0; x < n; ++x) { c = y * (n + 1) + x + 1; print "f", c, c + 1, c + n + 2, c + n + 1 } }' >mesh.obj
printf '%s\n' 'v -0.5 -0.5 0.4' 'v 0.5 -0.5 0.4' 'v 0.5 0.5 0.5' 'v -0.5 0.5 0.5' 'f -4 -3 -2 -1' >>mesh.obj
printf '[input]\nobjfile = "mesh.obj"\n[camera]\neye = [0.5, 0.3, 5.0]\nat = [0, 0, 0]\nup = [0, 1, 0]\nfov = 40\n' >scene.toml
printf '[film]\nwidth = 4\nheight = 3\n[renderer]\nspp = 2\ntype = "ao"\n' >>scene.toml
clean "nook render" "$build/bin/nook" render scene.toml -o out.exr --no-png --quiet --aov normal,position,depth
printf '0,0,1,0,0,1\n' >points.csv
clean "nook probe" "$build/bin/nook" probe scene.toml --points points.csv --samples 8
exit $failed
