#include "keys.hpp"

#include "device/device.hpp"
#include "jobs.hpp"
#include "scene/effect_keys.hpp"
#include "scene/help_text.hpp"
#include "scene/scene_keys.hpp"

namespace nook::python {
namespace {

template <class Owner>
void add(const Object& all, const char* of, std::span<const Key<Owner>> keys, const Owner& standard) {
  for (const Key<Owner>& key : keys) {
    const KeyInfo& info = key.info;
    if (info.name == "objfile" || info.name == "name") continue;
    std::vector<std::string> readers;
    for (const auto& [name, kind] : effect_names)
      if (info.readers.contains(kind)) readers.emplace_back(name);
    Object dict(PyDict_New());
    set(dict, "name", text(std::string(info.name)));
    set(dict, "of", text(of));
    set(dict, "readers", list(readers, text));
    const KeyValue value = key.field.get(standard);
    const bool none = std::holds_alternative<std::monostate>(value);
    set(dict, "default", none ? Object(Py_NewRef(Py_None)) : text(toml_text(value)));
    set(dict, "help", text(help_text(info)));
    if (PyList_Append(all.get(), dict.get()) != 0) throw ErrorIsSet();
  }
}

}  // namespace

Object keys() {
  Object all(PyList_New(0));
  const Scene scene;
  add(all, "renderer", renderer_keys(), scene);
  add(all, "effect", effect_keys(), default_effect(EffectKind::ao));
  add(all, "film", film_keys(), scene);
  add(all, "camera", camera_keys(), scene);
  add(all, "input", input_keys(), scene);
  add(all, "ground", ground_keys(), Ground());
  return all;
}

Object devices() {
  use_device();
  const std::vector<DeviceInfo> found = list_devices();
  return list(found, [](const DeviceInfo& d) {
    Object dict(PyDict_New());
    set(dict, "selector",
        text(std::string(std::to_string(d.platform_index))
                 .append(":")
                 .append(std::to_string(d.device_index))));
    set(dict, "type", text(d.is_cpu() ? "CPU" : d.type & CL_DEVICE_TYPE_GPU ? "GPU" : "accelerator"));
    set(dict, "name", text(d.name));
    set(dict, "platform", text(d.platform_name));
    set(dict, "driver", text(d.driver));
    set(dict, "compute_units", number(std::uint64_t(d.compute_units)));
    set(dict, "memory", number(d.memory));
    return dict;
  });
}

}  // namespace nook::python
