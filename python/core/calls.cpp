#include "calls.hpp"

#include <utility>
#include <variant>

namespace nook::python {

template <>
const char* const Held<Workspace>::name = "nook.workspace";
template <>
const char* const Held<Picture>::name = "nook.picture";
template <>
const char* const Held<Bake>::name = "nook.bake";

std::filesystem::path path_of(PyObject* object) {
  if (object == Py_None) return {};
  PyObject* encoded = nullptr;
  if (!PyUnicode_FSConverter(object, &encoded)) throw ErrorIsSet();
  const Object bytes(encoded);
  return std::string(PyBytes_AsString(bytes.get()), std::size_t(PyBytes_Size(bytes.get())));
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text + ' ') {
    if (c != ' ') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

namespace {

Object channel_of(const Channel& channel) {
  return std::visit(
      [&](const auto& values) {
        const bool whole = std::is_same_v<decltype(values), const std::vector<std::uint32_t>&>;
        return tuple(text(channel.name), text(whole ? "uint32" : "float32"), bytes_of(values));
      },
      channel.values);
}

}  // namespace

Object list_of(const std::vector<Layer>& layers) {
  return list(layers, [](const Layer& layer) { return tuple(text(layer.name), list(layer.channels, text)); });
}

Object result_of(Picture made) {
  Object dict(PyDict_New());
  set(dict, "width", number(std::uint64_t(made.image.width)));
  set(dict, "height", number(std::uint64_t(made.image.height)));
  set(dict, "complete", Object(PyBool_FromLong(made.complete)));
  set(dict, "channels", list(made.image.channels, channel_of));
  set(dict, "layers", list_of(made.layers));
  set(dict, "picture", Held<Picture>::hold(std::make_shared<Picture>(std::move(made))));
  return dict;
}

}  // namespace nook::python
