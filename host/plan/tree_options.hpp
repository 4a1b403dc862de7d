#pragma once

#include "bvh/bvh.hpp"
#include "device/device.hpp"
#include "plan/plan.hpp"

namespace nook {

/// The children a node of the trees that are best for a device: as many as a vector has floats, 8 or 16,
/// where rays go through the tree in streams. Elsewhere 16: a ray by itself reads the children one after
/// another, and of wide nodes it visits fewer. 16 everywhere for a plan that asks what is in reach: what the
/// first visits tell of that depends on the tree, and pictures to an error on it.
unsigned tree_width(const DeviceInfo& device, const Plan& plan);

/// Occlusion rays that a plan traces, at most: a rule may stop pixels sooner.
double planned_rays(const Plan& plan);

/// The trees that are best for this number of rays of a plan: of tree_width(), and refined where the rays
/// save more than that takes; never for a plan that asks what is in reach, see tree_width(), nor for one with
/// instances, where each mesh's tree would be refined. A plan with a stop rule counts the most that the rule
/// allows, so it is refined as a rule. What rays hit does not depend on it.
BvhOptions tree_options(const DeviceInfo& device, const Plan& plan, double rays, unsigned threads);

}  // namespace nook
