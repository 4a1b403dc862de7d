#include "plan/kernel_arguments.hpp"

namespace nook {

std::vector<std::string> argument_names(const Plan& plan, const std::string& kernel) {
  std::vector<std::string> names;
#define NOOK_NAME(type, name) names.push_back(#name);
  TREE_ARGUMENTS(NOOK_NAME)
  if (plan.cutouts) {
    CUT_OUT_ARGUMENTS(NOOK_NAME)
  }
  if (plan.instances) {
    INSTANCE_ARGUMENTS(NOOK_NAME)
  }
  if (kernel == "primary") {
    PRIMARY_ARGUMENTS(NOOK_NAME, NOOK_NAME, NOOK_NAME)
  } else {
    OCCLUSION_ARGUMENTS(NOOK_NAME, NOOK_NAME, NOOK_NAME)
  }
#undef NOOK_NAME
  return names;
}

}  // namespace nook
