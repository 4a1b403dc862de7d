#include "errors.hpp"

#include <exception>
#include <new>

#include "base/error.hpp"

namespace nook::python {
namespace {

const char* class_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "UsageError";
    case ErrorKind::scene:
      return "SceneError";
    case ErrorKind::device:
      return "DeviceError";
    case ErrorKind::output:
      return "OutputError";
    case ErrorKind::incomplete:
      return "IncompleteError";
    default:
      return "InternalError";
  }
}

void raise(const char* class_name, const std::string& message, const Place& place) {
  const Object module(PyImport_ImportModule("nook._errors"));
  const Object type(PyObject_GetAttrString(module.get(), class_name));
  const Object error(PyObject_CallFunctionObjArgs(type.get(), text(message).get(), nullptr));
  const auto keep = [&](const char* name, Object value) {
    if (PyObject_SetAttrString(error.get(), name, value.get()) != 0) throw ErrorIsSet();
  };
  if (!place.file.empty()) keep("file", text(place.file));
  if (place.row) keep("row", number(place.row));
  if (place.column) keep("column", number(place.column));
  PyErr_SetObject(type.get(), error.get());
}

}  // namespace

void translate() try { throw; } catch (const ErrorIsSet&) {
} catch (const Error& e) {
  if (e.kind() == ErrorKind::interrupted) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    return;
  }
  try {
    raise(class_of(e.kind()), e.what(), e.place());
  } catch (const ErrorIsSet&) {
  }
} catch (const std::bad_alloc&) {
  PyErr_NoMemory();
} catch (const std::exception& e) {
  try {
    raise("InternalError", e.what(), {});
  } catch (const ErrorIsSet&) {
  }
}

}  // namespace nook::python
