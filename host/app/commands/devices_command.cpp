// nook devices: what OpenCL offers here.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "device/device.hpp"
#include "plan/tree_options.hpp"

namespace nook {
namespace {

const char* type_name(const DeviceInfo& device) {
  return device.is_cpu() ? "CPU" : device.type & CL_DEVICE_TYPE_GPU ? "GPU" : "accelerator";
}

int print_devices() {
  const std::vector<DeviceInfo> devices = list_devices();
  if (devices.empty())
    throw Error(ErrorKind::device, "no OpenCL device found; `nook doctor` says what is missing");
  for (const DeviceInfo& d : devices)
    fmt::print(
        "{}:{}  {}  {}\n     {}; driver {}; {}, vectors of {}, {:.1f} GiB (at most "
        "{:.1f} GiB a buffer), {} children a node of the tree\n",
        d.platform_index, d.device_index, type_name(d), d.name, d.platform_name, d.driver,
        counted(d.compute_units, "compute unit"), counted(d.native_float_width, "float"),
        double(d.memory) / (1u << 30), double(d.max_allocation) / (1u << 30), tree_width(d, {}));
  return 0;
}

}  // namespace

void add_devices_command(CLI::App& app, Command& chosen) {
  app.add_subcommand("devices", "List OpenCL platforms and devices")->callback([&chosen] {
    chosen = print_devices;
  });
}

}  // namespace nook
