#!/bin/bash
# bench/gpu.sh [BUILD] [DEVICE]: what a GPU makes of nook, in under five minutes. Prints Markdown for docs/portability.md; runs to its end on PoCL too
# (DEVICE cpu), where it compares a device with itself.
#
# BUILD (default build) has nook and, where tests are built, the kernel and statistics suites. DEVICE (default gpu) is as --device has it. The pictures
# are compared with those of the first processor (cpu), if there is one. Every step has a time of its own, and a step that fails does not stop the others; the
# exit code is 1 then.
set -u
build=$(realpath "${1:-build}")
device=${2:-gpu}
nook=$build/bin/nook
scenes=$(realpath "$(dirname "$0")/../scenes")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_CACHE_HOME=${XDG_CACHE_HOME:-$build/cache}
bad=0

number() { sed -n "s/.*\"$2\": \([0-9.e+-]*\).*/\1/p" "$1" | head -1; }  # of a file of JSON lines

echo "## $("$nook" devices | grep -c '^[0-9]*:[0-9]*') devices"
"$nook" devices || exit 1

# suite PROGRAM SECONDS FILTER: a test program on the device.
suite() {
  [ -x "$build/bin/$1" ] || { echo "- $1: not built"; return; }
  NOOK_TEST_DEVICE=$device timeout "$2" "$build/bin/$1" --gtest_filter="$3" >"$work/$1.log" 2>&1
  code=$?
  passed=$(grep -c '^\[       OK' "$work/$1.log") failed=$(grep -c '^\[  FAILED  \].*(' "$work/$1.log")
  echo "- $1: $passed passed, $failed failed$([ $code = 124 ] && echo ", the rest not reached in $2 s")"
  grep '^\[  FAILED  \].*(' "$work/$1.log" | head -20
  [ "$failed" = 0 ] && [ $code != 139 ] && [ $code != 134 ] || bad=1
}
echo
echo "## Suites"
# Machine code and LLVM's own caches are PoCL's alone; Embree's ten million rays and the study take longer than this has.
suite nook_kernels_tests 70 '-Embree.*:*MachineCode*:*LaneLists*'
suite nook_statistics_tests 60 '-*Coverage*:*Study*'

# picture DEVICE SCENE NAME FLAGS...
picture() {
  local on=$1 scene=$2 name=$3
  shift 3
  timeout 40 "$nook" render "$scenes/$scene" --device "$on" --no-png --quiet -o "$work/$name.exr" --stats "$work/$name.json" "$@" 2>"$work/log" </dev/null ||
    { echo "| $name | $(head -1 "$work/log") | |"; bad=1; return 1; }
}
echo
echo "## Pictures against the processor's"
echo "| picture | largest difference | RMSE |"
echo "|---|---|---|"
for row in cbox_ao_cosine.toml cbox_ao_hemisphere.toml cbox_ro.toml cbox_effects.toml effects/cutouts.toml; do
  name=$(basename "$row" .toml)
  picture "$device" "$row" "$name" --size 160x120 --spp 16 || continue
  picture cpu "$row" "${name}_cpu" --size 160x120 --spp 16 || continue
  "$nook" compare "$work/${name}_cpu.exr" "$work/$name.exr" --json >"$work/compare.json" 2>/dev/null
  largest=$(sed -n 's/.*"max_abs": \([^,]*\),*/\1/p' "$work/compare.json" | LC_ALL=C sort -g | tail -1)
  rmse=$(sed -n 's/.*"rmse": \([^,]*\),*/\1/p' "$work/compare.json" | LC_ALL=C sort -g | tail -1)
  [ "$largest" = 0.0 ] && largest="the bits"
  echo "| $name | ${largest:-cannot be compared} | $rmse |"
done

echo
echo "## Rays a second"
echo "| scene | traversal | million rays a second in kernels | of the whole render |"
echo "|---|---|---|---|"
for scene in cbox_ao_cosine.toml bunny_ao.toml room_ao.toml; do
  for traversal in scalar stream portable; do
    name=$(basename "$scene" .toml)_$traversal
    # The first run compiles, the second is measured.
    NOOK_TRAVERSAL=$traversal picture "$device" "$scene" "$name" --size 512x512 --spp 1 --directions 16 || continue
    NOOK_TRAVERSAL=$traversal picture "$device" "$scene" "$name" --size 512x512 --spp 1 --directions 16 || continue
    camera=$(number "$work/$name.json" camera) occlusion=$(number "$work/$name.json" occlusion)
    kernels=$(number "$work/$name.json" seconds_on_device) whole=$(number "$work/$name.json" render)
    awk -v s="$(basename "$scene" .toml)" -v t=$traversal -v r="$((camera + occlusion))" -v k="$kernels" -v w="$whole" \
      'BEGIN { printf "| %s | %s | %s | %.1f |\n", s, t, (k > 0 ? sprintf("%.1f", r / k / 1e6) : "not told"), r / w / 1e6 }'
  done
done
exit $bad
