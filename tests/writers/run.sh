#!/bin/bash
# tests/writers/run.sh NOOK [FOLDER]: one solid, written by Blender, MeshLab, Open3D, trimesh and meshio in each format that they have
# and nook reads, has the same AO from every file. Outside CI: it installs the programs from PyPI (a gigabyte) into FOLDER/venv.
# A program that cannot be had here is left out, and said to be. Exit code 1: some file has another AO, or none was written.
set -u
here=$(cd "$(dirname "$0")" && pwd)
nook=$(realpath "$1")
folder=${2:-$(mktemp -d)}
mkdir -p "$folder/meshes"
cd "$folder" || exit 1
[ -d venv ] || python3 -m venv venv || exit 1
for package in numpy trimesh==5.2.0 meshio==5.3.5 pymeshlab==2025.7.post1 open3d-cpu==0.20.0 bpy==5.0.1; do
  name=${package%%[=-]*}
  venv/bin/python -c "import $name" 2>/dev/null || venv/bin/pip install -q "$package" 2>pip.log || echo "left out: $package cannot be installed"
done
venv/bin/python "$here/write_meshes.py" meshes reference || exit 1
for module in trimesh meshio pymeshlab open3d bpy; do  # a process each: bpy and open3d bring two versions of Embree
  venv/bin/python "$here/write_meshes.py" meshes $module >$module.log 2>&1 || echo "left out: $module, see $folder/$module.log"
done

picture() {  # MESH EXR
  cat >scene.toml <<TOML
[input]
objfile = "$1"
[camera]
eye = [7, 6, 14]
at = [2, 2.5, 0.5]
fov = 40
[film]
width = 96
height = 72
[renderer]
type = "ao"
spp = 64
max_distance = 4
TOML
  "$nook" render scene.toml --quiet --no-png -o "$2"
}

picture meshes/reference.obj reference.exr || exit 1
bad=0
count=0
for mesh in meshes/*-*.obj meshes/*-*.ply meshes/*-*.stl; do
  count=$((count + 1))
  # triangles may differ, and with them the last bits of where rays hit: at edges, in few pixels, some of 64 rays see another side
  if picture "$mesh" other.exr && "$nook" compare reference.exr other.exr --fail 0.04 --fail-percent 1 --hard-fail 0.2 --warn 1 -q; then
    echo "same AO: $mesh"
  else
    echo "OTHER AO: $mesh"
    bad=1
  fi
done
[ "$count" -gt 0 ] || bad=1
exit $bad
