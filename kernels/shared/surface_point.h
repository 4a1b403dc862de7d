// A point where occlusion is estimated: written by `primary` (one per camera ray) or by the host (probe, bake).
#ifndef NOOK_SHARED_SURFACE_POINT_H
#define NOOK_SHARED_SURFACE_POINT_H

#include "portable.h"

#define SURFACE_HIT 1u    // the camera ray hit something; otherwise nothing else below is meaningful
#define SURFACE_GIVEN 2u  // made by the host

typedef struct {
  float origin[3];            // where occlusion rays start: on the shading normal's side, off the surface by the error bound
  nook_uint flags;            // SURFACE_HIT, SURFACE_GIVEN
  float normal[3];            // shading normal, unit; directions are sampled around it
  nook_uint triangle;         // index into the mesh, or 0xffffffff
  float view[3];              // unit direction to the viewer; RO mirrors it about the shading normal
  float distance;             // along the camera ray, world units; of a point that the host made: how far the origin is off it
  float geometric_normal[3];  // unit, from the winding
  nook_uint material;         // index, or 0xffffffff
} SurfacePoint;

#endif
