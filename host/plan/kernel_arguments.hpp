#pragma once

#include <string>
#include <vector>

#include "device/kernel_call.hpp"
#include "kernels/shared/arguments.h"
#include "kernels/shared/camera.h"
#include "kernels/shared/task.h"
#include "plan/kernel_plan.hpp"
#include "plan/plan.hpp"

namespace nook {

// A member for each argument of kernels/shared/arguments.h: a buffer that must be set, or a value.
#define NOOK_BUFFER_MEMBER(type, name) cl_mem name = nullptr;
#define NOOK_VALUE_MEMBER(type, name) type name{};
#define NOOK_ADD_ARGUMENT(type, name) call.add(#name, arguments.name);

/// A tree as kernels take it, with what they look up of cut-outs and of instances where the plan has them.
struct TreeArguments {
  TREE_ARGUMENTS(NOOK_BUFFER_MEMBER)
  CUT_OUT_ARGUMENTS(NOOK_BUFFER_MEMBER)
  INSTANCE_ARGUMENTS(NOOK_BUFFER_MEMBER)
};

/// The other arguments of kernels/stage/primary.cl and occlusion.cl, by name.
struct PrimaryArguments {
  PRIMARY_ARGUMENTS(NOOK_BUFFER_MEMBER, NOOK_BUFFER_MEMBER, NOOK_VALUE_MEMBER)
};
struct OcclusionArguments {
  OCCLUSION_ARGUMENTS(NOOK_BUFFER_MEMBER, NOOK_BUFFER_MEMBER, NOOK_VALUE_MEMBER)
};

#undef NOOK_BUFFER_MEMBER
#undef NOOK_VALUE_MEMBER

/// Adds the arguments in the kernel's order. Throws Error(internal) that names one that is missing.
inline void add_arguments(KernelCall& call, const Plan& plan, const TreeArguments& arguments) {
  TREE_ARGUMENTS(NOOK_ADD_ARGUMENT)
  if (plan.cutouts) {
    CUT_OUT_ARGUMENTS(NOOK_ADD_ARGUMENT)
  }
  if (plan.instances) {
    INSTANCE_ARGUMENTS(NOOK_ADD_ARGUMENT)
  }
}
inline void add_arguments(KernelCall& call, const PrimaryArguments& arguments) {
  PRIMARY_ARGUMENTS(NOOK_ADD_ARGUMENT, NOOK_ADD_ARGUMENT, NOOK_ADD_ARGUMENT)
}
inline void add_arguments(KernelCall& call, const OcclusionArguments& arguments) {
  OCCLUSION_ARGUMENTS(NOOK_ADD_ARGUMENT, NOOK_ADD_ARGUMENT, NOOK_ADD_ARGUMENT)
}

#undef NOOK_ADD_ARGUMENT

/// The names of a kernel's arguments in its order: `kernel` is "primary" or "occlusion".
std::vector<std::string> argument_names(const Plan& plan, const std::string& kernel);

}  // namespace nook
