// A target under libFuzzer or AFL++ (whose compiler brings a driver for the same function): NOOK_FUZZ_TARGET
// names it.
#include <cstdint>
#include <stdexcept>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const nook::fuzz::Target& target = [&]() -> const nook::fuzz::Target& {
    for (const auto& each : nook::fuzz::targets())
      if (std::string(each.name) == NOOK_FUZZ_TARGET) return each;
    throw std::logic_error("no target " NOOK_FUZZ_TARGET);
  }();
  nook::fuzz::run_once(target, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
