#!/bin/bash
# tests/tools/oclgrind_kernels.sh BUILD: every variant of the kernels on a picture of 4x3 pixels, interpreted by oclgrind, with its checks for
# invalid accesses, data races and misuse of the API. A line a variant; exits 1 if any reports something or fails. Takes minutes.
set -u
nook=$(realpath "$1")/bin/nook
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export XDG_CACHE_HOME=$folder/cache OCLGRIND_CHECK_API=1 OCLGRIND_DATA_RACES=1
export OCLGRIND_BUILD_OPTIONS=-cl-opt-disable  # the interpreter lacks llvm.bitreverse
export NOOK_OPENCL=${NOOK_OPENCL:-/usr/lib/oclgrind/liboclgrind-rt.so}
printf 'newmtl shiny\nNs 30\n' >mesh.mtl
printf '%s\n' 'mtllib mesh.mtl' 'usemtl shiny' 'vn 0 0.1 1' 'v -2 -2 0' 'v 2 -2 0.1' 'v 2 2 0' 'v -2 2 -0.1' \
  'f 1//1 2//1 3//1 4//1' 'v -0.5 -0.5 0.4' 'v 0.5 -0.5 0.4' 'v 0.5 0.5 0.5' 'v -0.5 0.5 0.5' 'f 5 6 7 8' >mesh.obj
failed=0

# try NAME KEYS-OF-THE-RENDERER OPTIONS...
try() {
  local name=$1 keys=$2
  shift 2
  printf '[input]\nobjfile = "mesh.obj"\n[camera]\neye = [0.5, 0.3, 5.0]\nat = [0, 0, 0]\nup = [0, 1, 0]\nfov = 40\n' >scene.toml
  printf '[film]\nwidth = 4\nheight = 3\n[renderer]\nspp = 2\n%b\n' "$keys" >>scene.toml
  if "$nook" render scene.toml -o out.exr --no-png --quiet "$@" >log 2>&1 && [ ! -s log ]; then
    echo "clean: $name"
  else
    echo "NOT CLEAN: $name"
    head -20 log
    failed=1
  fi
}

for sampler in independent stratified halton sobol zorder; do
  try "sampler $sampler" 'type = "ao"' --sampler $sampler
  try "sampler $sampler, one camera ray" 'type = "ao"' --sampler $sampler --spp 1 --directions 40
done
for sampling in cosine hemisphere sphere; do try "ao $sampling" 'type = "ao"' --sampling $sampling; done
for sampling in lobe mixture cosine hemisphere sphere; do
  try "ro $sampling" 'type = "ro"\nexponent = 30' --sampling $sampling
done
try "exponent of the material" 'type = "ro"\nexponent = "material"'
try "falloff" 'type = "ao"\nmax_distance = 2\nfalloff = "smooth"'
try "least distance" 'type = "ao"\nmin_distance = 0.1'
try "cone" 'type = "ao"\ncone_angle = 40'
for side in inside viewer; do try "side $side" "type = \"ao\"\nside = \"$side\""; done
try "bent normals" 'type = "bent"'
try "bent normals in view space" 'type = "bent"\nspace = "view"'
try "channels of the surface" 'type = "ao"' --aov normal,position,depth
exit $failed
