// The arguments of the kernels `primary` and `occlusion`, each described once. The kernels' parameter lists and
// the host's structs of arguments (host/plan/kernel_arguments.hpp) are made of these lists, in this order:
//
//   IN(type, name)     an array in device memory that is read
//   OUT(type, name)    one that is written
//   VALUE(type, name)  a value
//
//   __kernel void primary(BVH_PARAMS PRIMARY_ARGUMENTS(IN_PARAM, OUT_PARAM, VALUE_PARAM)) { ... positions[i] ... }
//
// The trees' arrays come before them (BVH_PARAMS); those of CUT_OUTS and INSTANCES are there in the programs that have them.
#ifndef NOOK_SHARED_ARGUMENTS_H
#define NOOK_SHARED_ARGUMENTS_H

#define TREE_ARGUMENTS(IN) IN(BvhNode, nodes) IN(TriangleLeaf, leaves)
#define CUT_OUT_ARGUMENTS(IN) IN(CutTriangle, cut_triangles) IN(OpacityMapPlace, opacity_maps) IN(uchar, opacity)
#define INSTANCE_ARGUMENTS(IN) IN(PlacedMesh, instances)

// What no option of a program reads is an array of one byte.
#define PRIMARY_ARGUMENTS(IN, OUT, VALUE)                                      \
  IN(float, positions)              /* 3 a vertex */                           \
  IN(nook_uint, triangles)          /* 3 vertices each */                      \
  IN(float, normals)                /* VERTEX_NORMALS: 3 each */               \
  IN(nook_uint, triangle_normals)   /* VERTEX_NORMALS: 3 normals each */       \
  IN(nook_uint, triangle_materials) /* MATERIALS: of each triangle */          \
  VALUE(CameraParams, camera)                                                  \
  VALUE(EstimatorParams, p)                                                    \
  IN(Task, tasks)                                                              \
  VALUE(nook_uint, task_count)                                                 \
  VALUE(nook_uint, tasks_per_item) /* of a work-item, at most */               \
  OUT(SurfacePoint, points)        /* p.samples a task */

#define OCCLUSION_ARGUMENTS(IN, OUT, VALUE)                                    \
  VALUE(EstimatorParams, p)                                                    \
  IN(Task, tasks)                                                              \
  VALUE(nook_uint, task_count)                                                 \
  VALUE(nook_uint, tasks_per_item) /* of a work-item, at most */               \
  IN(SurfacePoint, points)                                                     \
  OUT(TaskResult, results)       /* one a task */                              \
  IN(float, exponents)           /* EXPONENT_OF_MATERIAL: by material */       \
  IN(float, positions)           /* 3 a vertex */                              \
  IN(nook_uint, triangles)       /* 3 vertices each */                         \
  VALUE(CameraParams, camera)                                                  \
  OUT(nook_ulong, bent)          /* BENT: 3 a task */                          \
  IN(nook_uint, receivers)       /* RECEIVERS: a bit a triangle */             \
  IN(nook_uint, triangle_groups) /* ONLY_SELF: of each triangle */             \
  IN(nook_uint, first_of_group)  /* ONLY_SELF: each group's first node, leaf */ \
  IN(float, point_set)           /* SAMPLER_POINTS: 2 a direction */

#ifdef __OPENCL_C_VERSION__
#define IN_PARAM(type, name) , __global const type *name
#define OUT_PARAM(type, name) , __global type *name
#define VALUE_PARAM(type, name) , type name
#endif

#endif
