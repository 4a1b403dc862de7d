"""write_meshes.py FOLDER reference|MODULE: an E of twelve corners, drawn out to a solid on a floor, as the library MODULE writes it.

Files are PROGRAM-KIND.EXTENSION; reference.obj is written here, its E as faces of twelve corners.
"""
import importlib
import os
import sys

folder = sys.argv[1]
E = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 2), (3, 2), (3, 3), (1, 3), (1, 4), (4, 4), (4, 5), (0, 5)]
vertices = [(x, y, z) for z in (0.0, 1.0) for x, y in E] + [(-9, 0, -9), (-9, 0, 9), (9, 0, 9), (9, 0, -9)]
vertices = [tuple(map(float, v)) for v in vertices]
faces = [list(range(11, -1, -1)), list(range(12, 24))]
faces += [[i, (i + 1) % 12, (i + 1) % 12 + 12, i + 12] for i in range(12)] + [[24, 25, 26, 27]]

# For libraries that have triangles alone: the E from its spine and three arms.
e_triangles = [(0, 3, 11), (3, 8, 11), (8, 10, 11), (8, 9, 10), (0, 1, 3), (1, 2, 3), (4, 5, 7), (5, 6, 7)]
triangles = [(a + 12, b + 12, c + 12) for a, b, c in e_triangles] + [(c, b, a) for a, b, c in e_triangles]
for face in faces[2:]:
    triangles += [(face[0], face[1], face[2]), (face[0], face[2], face[3])]


def path(name):
    return os.path.join(folder, name)


def reference():
    with open(path("reference.obj"), "w") as out:
        out.writelines("v %.9g %.9g %.9g\n" % v for v in vertices)
        out.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)


def with_trimesh(trimesh):
    mesh = trimesh.Trimesh(vertices, triangles, process=False)
    mesh.export(path("trimesh-text.obj"))
    mesh.export(path("trimesh-binary.ply"))
    mesh.export(path("trimesh-text.ply"), encoding="ascii")
    mesh.export(path("trimesh-binary.stl"))
    mesh.export(path("trimesh-text.stl"), file_type="stl_ascii")


def with_meshio(meshio):
    mesh = meshio.Mesh(vertices, [("triangle", triangles)])
    mesh.write(path("meshio-text.obj"))
    mesh.write(path("meshio-binary.ply"), binary=True)
    mesh.write(path("meshio-text.ply"), binary=False)
    mesh.write(path("meshio-binary.stl"), binary=True)
    mesh.write(path("meshio-text.stl"), binary=False)


def with_pymeshlab(pymeshlab):
    import numpy
    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(numpy.array(vertices), numpy.array(triangles)))
    meshes.save_current_mesh(path("meshlab-text.obj"), save_vertex_normal=False)  # they would smooth the edges
    for kind, binary in (("binary", True), ("text", False)):
        meshes.save_current_mesh(path(f"meshlab-{kind}.ply"), binary=binary)
        meshes.save_current_mesh(path(f"meshlab-{kind}.stl"), binary=binary)


def with_open3d(open3d):
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(vertices),
                                        open3d.utility.Vector3iVector(triangles))
    mesh.compute_vertex_normals()  # its STL needs them; they would smooth the edges
    open3d.io.write_triangle_mesh(path("open3d-binary.stl"), mesh)
    for kind, text in (("binary", False), ("text", True)):
        open3d.io.write_triangle_mesh(path(f"open3d-{kind}.ply"), mesh, write_ascii=text, write_vertex_normals=False)
    open3d.io.write_triangle_mesh(path("open3d-text.obj"), mesh, write_vertex_normals=False)


def with_blender(bpy):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    data = bpy.data.meshes.new("E")
    data.from_pydata(vertices, [], faces)
    scene_object = bpy.data.objects.new("E", data)
    bpy.context.collection.objects.link(scene_object)
    bpy.context.view_layer.objects.active = scene_object
    scene_object.select_set(True)
    axes = {"forward_axis": "Y", "up_axis": "Z"}
    bpy.ops.wm.obj_export(filepath=path("blender-text.obj"), **axes)
    for kind, text in (("binary", False), ("text", True)):
        bpy.ops.wm.ply_export(filepath=path(f"blender-{kind}.ply"), ascii_format=text, **axes)
        bpy.ops.wm.stl_export(filepath=path(f"blender-{kind}.stl"), ascii_format=text, **axes)


writers = {"trimesh": with_trimesh, "meshio": with_meshio, "pymeshlab": with_pymeshlab, "open3d": with_open3d,
           "bpy": with_blender}
if sys.argv[2] == "reference":
    reference()
else:
    writers[sys.argv[2]](importlib.import_module(sys.argv[2]))
