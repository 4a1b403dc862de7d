#pragma once

namespace nook {

/// Processors that this process may use: those of its affinity mask (taskset), or fewer where a control
/// group's quota is of fewer (rounded up). At least 1; as it was when first asked.
unsigned processors_allowed();

/// Threads that a pool of this process may have: `asked`, or where that is 0 the limit set below, or else the
/// processors that it may use. At least 1.
unsigned threads_to_use(unsigned asked = 0);

/// The limit for what is not asked for by number (0: none). Set once, when the options are known.
void limit_own_threads(unsigned threads);

}  // namespace nook
