#pragma once

// The stable ABI of Python 3.11, the first whose limited API has the buffer protocol: one binary for 3.11 and
// everything after it.
#define Py_LIMITED_API 0x030b0000
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace nook::python {

/// Python has an error set; translate() leaves it as it is.
struct ErrorIsSet {};

/// An owned reference. Made of null, it throws ErrorIsSet.
class Object {
 public:
  explicit Object(PyObject* owned) : object_(owned) {
    if (!object_) throw ErrorIsSet();
  }
  Object(Object&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Object(const Object&) = delete;
  Object& operator=(Object&&) = delete;
  ~Object() { Py_XDECREF(object_); }

  PyObject* get() const { return object_; }
  PyObject* release() { return std::exchange(object_, nullptr); }

 private:
  PyObject* object_;
};

/// Other threads of Python run while this exists.
class WithoutGil {
 public:
  WithoutGil() : state_(PyEval_SaveThread()) {}
  WithoutGil(const WithoutGil&) = delete;
  ~WithoutGil() { PyEval_RestoreThread(state_); }

 private:
  PyThreadState* state_;
};

/// Texts of nook may hold file names, whose bytes need be no UTF-8: as os.fsdecode() has them.
inline Object text(const std::string& value) {
  return Object(PyUnicode_DecodeFSDefaultAndSize(value.data(), Py_ssize_t(value.size())));
}

inline Object number(std::uint64_t value) {
  return Object(PyLong_FromUnsignedLongLong(value));
}

inline Object number(double value) {
  return Object(PyFloat_FromDouble(value));
}

/// A tuple of what is given.
template <class... Objects>
Object tuple(Objects... objects) {
  Object made(PyTuple_New(sizeof...(objects)));
  Py_ssize_t i = 0;
  (PyTuple_SetItem(made.get(), i++, objects.release()), ...);
  return made;
}

/// A list of what `make` gives for each.
template <class Range, class Make>
Object list(const Range& range, Make make) {
  Object made(PyList_New(0));
  for (const auto& each : range)
    if (PyList_Append(made.get(), Object(make(each)).get()) != 0) throw ErrorIsSet();
  return made;
}

inline void set(const Object& dict, const char* key, Object value) {
  if (PyDict_SetItemString(dict.get(), key, value.get()) != 0) throw ErrorIsSet();
}

/// The values as a bytearray: what NumPy takes without a copy.
template <class T>
Object bytes_of(const std::vector<T>& values) {
  Object made(PyByteArray_FromStringAndSize(nullptr, Py_ssize_t(values.size() * sizeof(T))));
  if (!values.empty())
    std::memcpy(PyByteArray_AsString(made.get()), values.data(), values.size() * sizeof(T));
  return made;
}

/// What an object with the buffer protocol holds, in one piece, of numbers of `item` bytes each.
class Buffer {
 public:
  explicit Buffer(PyObject* of) {
    if (PyObject_GetBuffer(of, &view_, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) throw ErrorIsSet();
  }
  Buffer(const Buffer&) = delete;
  ~Buffer() { PyBuffer_Release(&view_); }

  /// Whether its numbers are of this type, by struct's letter: f, d, I.
  bool is(char letter) const { return view_.format && view_.format[0] == letter && view_.format[1] == '\0'; }
  template <class T>
  std::span<const T> as() const {
    return {static_cast<const T*>(view_.buf), std::size_t(view_.len) / sizeof(T)};
  }

 private:
  Py_buffer view_;
};

/// The numbers of an array of doubles, or none of None. The caller must not trust shapes: they are Python's
/// to check.
std::vector<double> doubles(PyObject* array, const char* name);

}  // namespace nook::python
