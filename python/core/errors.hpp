#pragma once

#include "object.hpp"

namespace nook::python {

/// Sets Python's error to what is being caught: the class of nook._errors for an Error's kind, with its file,
/// row and column; KeyboardInterrupt for interrupted; MemoryError. To be called in a catch block.
void translate();

/// What `f` returns, or null with Python's error set.
template <class F>
PyObject* guarded(F f) {
  try {
    return Object(f()).release();
  } catch (...) {
    translate();
    return nullptr;
  }
}

}  // namespace nook::python
