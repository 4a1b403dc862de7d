#!/bin/bash
# tests/implementations.sh NOOK [--keep DIR | --against DIR] [DEVICE]...: what each OpenCL implementation makes of the same scenes.
#
# Renders small pictures (distributions, samplers, RO, a stop rule, all effects, cut-outs) on each DEVICE, as --device has it
# (default: every device that `nook devices` lists), and compares them with those of the first; --keep writes the first's pictures to DIR, --against
# takes those of DIR instead, say of another machine. A row of Markdown for each device, as in docs/portability.md. Outside CI: only whoever
# has several implementations gains by it. Each row takes a few seconds; oclgrind and llvmpipe, minutes.
set -u
nook=$(realpath "$1")
shift
scenes=$(realpath "$(dirname "$0")/../scenes")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
against= keep=
case ${1:-} in
  --keep) keep=$(realpath -m "$2") && mkdir -p "$keep" && shift 2 ;;
  --against) against=$(realpath "$2") && shift 2 ;;
esac
size=${NOOK_SIZE:-64x48}
devices=("$@")
[ $# -gt 0 ] || mapfile -t devices < <("$nook" devices | sed -n 's/^\([0-9]*:[0-9]*\) .*/\1/p')
[ -e "$scenes/generated/cbox.obj" ] || { echo "build first: $scenes/generated has no meshes" >&2; exit 1; }

# What is rendered: NAME, scene, flags.
pictures() {
  cat <<END
ao_cosine cbox_ao_cosine.toml --spp 16
ao_hemisphere cbox_ao_hemisphere.toml --spp 16
ao_sphere cbox_ao_sphere.toml --spp 16
ro cbox_ro.toml --spp 16
independent cbox_ao_cosine.toml --spp 16 --sampler independent
stratified cbox_ao_cosine.toml --spp 16 --sampler stratified
halton cbox_ao_cosine.toml --spp 16 --sampler halton
zorder cbox_ao_cosine.toml --spp 16 --sampler zorder
error cbox_ao_cosine.toml --error .05
effects cbox_effects.toml --spp 4 --aov normal,position,depth,variance,samples,alpha
cutouts effects/cutouts.toml --spp 4
END
}

# The largest difference of any channel, "-" where the pictures cannot be compared.
difference() {
  "$nook" compare "$1" "$2" --json 2>/dev/null |
    sed -n 's/.*"max_abs": \([^,]*\),*/\1/p' | LC_ALL=C sort -g | tail -1 | grep . || echo -
}

first=
echo "| device | $(pictures | awk '{ printf "%s | ", $1 }')"
echo "|---|$(pictures | awk '{ printf "---|" }')"
bad=0
for device in "${devices[@]}"; do
  folder=$work/$device
  mkdir -p "$folder"
  name=$("$nook" devices | grep -A1 "^$device " | tr -s ' \n' ' ' | sed 's/^[0-9:]* *\([A-Za-z]*\) \(.*\); driver \([^;]*\);.*/\2, \3/')
  row="| ${name:-$device} |"
  while read -r picture scene flags; do
    # shellcheck disable=SC2086  # flags are words
    if "$nook" render "$scenes/$scene" --size "$size" $flags --device "$device" --no-png --quiet -o "$folder/$picture.exr" 2>"$work/log" </dev/null; then
      reference=${against:-${first:-$folder}}/$picture.exr
      found=$(difference "$reference" "$folder/$picture.exr")
      [ "$found" = 0.0 ] && found="the bits"
      [ -n "$against$first" ] || found="the reference"
      row="$row $found |"
      [ -z "$keep" ] || [ -n "$first" ] || cp "$folder/$picture.exr" "$keep/"
    else
      row="$row $(head -1 "$work/log" | cut -c1-80) |"
      bad=1
    fi
  done < <(pictures)
  echo "$row"
  first=${first:-$folder}
done
exit $bad
