#pragma once

namespace nook {

/// Threads that a pool of this process may have: `asked`, or where that is 0 the limit set below, or else the
/// processors there are. At least 1.
unsigned threads_to_use(unsigned asked = 0);

/// The limit for what is not asked for by number (0: none). Set once, when the options are known.
void limit_own_threads(unsigned threads);

}  // namespace nook
