// Every macro a kernel may be specialised by: its values, its default, its check. The host sets them (render/kernel_plan).
// Structural choices are macros, continuous values (radius, exponent) are kernel arguments. Bodies say `if (MACRO)`, so
// that a branch that is off is still parsed.
#ifndef NOOK_CONFIG_H
#define NOOK_CONFIG_H

// What the occlusion kernel estimates.
#define EFFECT_AMBIENT 0
#define EFFECT_REFLECTION 1
#ifndef EFFECT
#define EFFECT EFFECT_AMBIENT
#endif
#if EFFECT < 0 || EFFECT > 1
#error "EFFECT: 0 ambient, 1 reflection"
#endif

// The distribution directions are drawn from; the order of nook::Sampling.
#define SAMPLING_COSINE 0
#define SAMPLING_HEMISPHERE 1
#define SAMPLING_SPHERE 2
#define SAMPLING_LOBE 3
#define SAMPLING_MIXTURE 4
#ifndef SAMPLING
#define SAMPLING SAMPLING_COSINE
#endif
#if SAMPLING < 0 || SAMPLING > 4
#error "SAMPLING: 0 cosine, 1 hemisphere, 2 sphere, 3 lobe, 4 mixture"
#endif
#if EFFECT == EFFECT_AMBIENT && SAMPLING > SAMPLING_SPHERE
#error "SAMPLING: lobe and mixture need EFFECT_REFLECTION"
#endif

// What an open direction of ambient occlusion counts; see ambient.cl.
#define WEIGHT_COSINE 0
#define WEIGHT_UNIFORM 1
#ifndef WEIGHT
#define WEIGHT WEIGHT_COSINE
#endif
#if WEIGHT < 0 || WEIGHT > 1
#error "WEIGHT: 0 cosine, 1 uniform"
#endif
#if WEIGHT == WEIGHT_UNIFORM && (EFFECT != EFFECT_AMBIENT || SAMPLING == SAMPLING_COSINE)
#error "WEIGHT uniform needs EFFECT_AMBIENT and SAMPLING hemisphere or sphere"
#endif

// The point sequence; the order of nook::Sampler.
#define SAMPLER_INDEPENDENT 0
#define SAMPLER_STRATIFIED 1
#define SAMPLER_HALTON 2
#define SAMPLER_SOBOL 3
#define SAMPLER_ZORDER 4
#define SAMPLER_POINTS 5  // given ones: Plan::point_set
#ifndef SAMPLER
#define SAMPLER SAMPLER_SOBOL
#endif
#if SAMPLER < 0 || SAMPLER > 5
#error "SAMPLER: 0 independent, 1 stratified, 2 halton, 3 sobol, 4 zorder, 5 points"
#endif

// 1: the points that were given are not shifted, so that all rows have the same.
#ifndef POINTS_AS_THEY_ARE
#define POINTS_AS_THEY_ARE 0
#endif
#if POINTS_AS_THEY_ARE && SAMPLER != SAMPLER_POINTS
#error "POINTS_AS_THEY_ARE needs SAMPLER_POINTS"
#endif

// 1: the spread of the estimate is measured between directions (one camera ray a pixel, point lists);
// 0: between camera rays.
#ifndef REPLICATE_DIRECTIONS
#define REPLICATE_DIRECTIONS 0
#endif

// 1: the mesh has vertex normals, and they are bound.
#ifndef VERTEX_NORMALS
#define VERTEX_NORMALS 0
#endif

// 1: each triangle's material is bound, and surface points know theirs.
#ifndef MATERIALS
#define MATERIALS 0
#endif

// 1: RO takes the exponent of the surface's material; a surface without a lobe traces nothing.
#ifndef EXPONENT_OF_MATERIAL
#define EXPONENT_OF_MATERIAL 0
#endif
#if EXPONENT_OF_MATERIAL && EFFECT != EFFECT_REFLECTION
#error "EXPONENT_OF_MATERIAL needs EFFECT_REFLECTION"
#endif

// How an occluder's distance counts; the order of nook::Falloff. See visibility.cl.
#define FALLOFF_NONE 0
#define FALLOFF_LINEAR 1
#define FALLOFF_SMOOTH 2
#define FALLOFF_EXPONENTIAL 3
#ifndef FALLOFF
#define FALLOFF FALLOFF_NONE
#endif
#if FALLOFF < 0 || FALLOFF > 3
#error "FALLOFF: 0 none, 1 linear, 2 smooth, 3 exponential"
#endif

// 1: occluders nearer than min_distance do not count.
#ifndef MIN_DISTANCE
#define MIN_DISTANCE 0
#endif

// 1: AO looks into a cone about the normal. See cone.cl.
#ifndef CONE
#define CONE 0
#endif
#if CONE && (EFFECT != EFFECT_AMBIENT || SAMPLING == SAMPLING_SPHERE)
#error "CONE needs EFFECT_AMBIENT and SAMPLING cosine or hemisphere"
#endif

// The side of the surface that occlusion looks to; the order of nook::Side. See side.cl.
#define SIDE_NORMAL 0
#define SIDE_INSIDE 1
#define SIDE_VIEWER 2
#ifndef SIDE
#define SIDE SIDE_NORMAL
#endif
#if SIDE < 0 || SIDE > 2
#error "SIDE: 0 normal, 1 inside, 2 viewer"
#endif

// 1: the weighted directions are summed too, for bent normals; BENT_VIEW: in view space instead of world space.
#ifndef BENT
#define BENT 0
#endif
#ifndef BENT_VIEW
#define BENT_VIEW 0
#endif
#if BENT && EFFECT != EFFECT_AMBIENT
#error "BENT needs EFFECT_AMBIENT"
#endif

// 1: the effect is estimated on some triangles alone; see sets.cl.
#ifndef RECEIVERS
#define RECEIVERS 0
#endif

// 1: nothing occludes a surface but its own group: a tree for each; see sets.cl.
#ifndef ONLY_SELF
#define ONLY_SELF 0
#endif

// 1: opacity maps cut holes into triangles; see cut_out.cl.
#ifndef CUT_OUTS
#define CUT_OUTS 0
#endif

// 1: the trees are those of meshes that are placed many times, with a tree over their places on top; see placed_tree.cl.
#ifndef INSTANCES
#define INSTANCES 0
#endif
#if INSTANCES && ONLY_SELF
#error "INSTANCES: ONLY_SELF needs a tree of copies for each group"
#endif

// 1: a point with nothing in reach traces nothing; see reach.cl.
#ifndef REACH
#define REACH 0
#endif

// Children of a node of the tree: the lanes of a vector. The buffers must hold such a tree.
#ifndef BVH_WIDTH
#define BVH_WIDTH 16
#endif
#if BVH_WIDTH != 8 && BVH_WIDTH != 16
#error "BVH_WIDTH: 8 or 16"
#endif

// 1: one ray at a time, for GPUs; 0: streams of rays over vectors of boxes and triangles, for CPUs. The same bits.
#ifndef TRAVERSAL_SCALAR
#define TRAVERSAL_SCALAR 0
#endif

// 1: no builtins of a processor, even where it has them.
#ifndef TRAVERSAL_PORTABLE
#define TRAVERSAL_PORTABLE 0
#endif

#endif
