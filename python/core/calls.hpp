#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bakes.hpp"
#include "estimates.hpp"
#include "jobs.hpp"
#include "object.hpp"

namespace nook::python {

/// What Python holds is a capsule of a shared_ptr: a job that goes on alone keeps what it uses.
template <class T>
struct Held {
  static const char* const name;  // in calls.cpp
  static Object hold(std::shared_ptr<T> value) {
    return Object(PyCapsule_New(new std::shared_ptr<T>(std::move(value)), name, [](PyObject* capsule) {
      auto* held = static_cast<std::shared_ptr<T>*>(PyCapsule_GetPointer(capsule, name));
      if (!is_forked()) delete held;
    }));
  }
  static std::shared_ptr<T> of(PyObject* capsule) {
    auto* held = static_cast<std::shared_ptr<T>*>(PyCapsule_GetPointer(capsule, name));
    if (!held) throw ErrorIsSet();
    return *held;
  }
};

template <>
const char* const Held<Workspace>::name;
template <>
const char* const Held<Picture>::name;
template <>
const char* const Held<Bake>::name;

/// PyArg_ParseTuple().
template <class... Places>
void parse(PyObject* arguments, const char* format, Places... places) {
  if (!PyArg_ParseTuple(arguments, format, places...)) throw ErrorIsSet();
}

/// A file's name by os.fspath() and os.fsencode(); empty of None.
std::filesystem::path path_of(PyObject* object);
/// Of words with blanks between them.
std::vector<std::string> words_of(const std::string& text);
/// Names, and the names of their channels.
Object list_of(const std::vector<Layer>& layers);
/// A picture as a dict: its size, whether it is complete, channels, layers, and what save() takes.
Object result_of(Picture made);

// Methods of the module, each with its arguments.

/// bake(workspace, "vertices" or "corners", settings, progress): a dict.
PyObject* bake_onto_mesh(PyObject*, PyObject* arguments);
/// bake_texture(workspace, size, dilation, aovs, settings, progress): a dict of a picture.
PyObject* bake_into_texture(PyObject*, PyObject* arguments);
/// save_bake(bake, file)
PyObject* save_bake(PyObject*, PyObject* arguments);
/// plan(workspace), info(workspace): JSON.
PyObject* plan_of(PyObject*, PyObject* workspace);
PyObject* info_of(PyObject*, PyObject* workspace);
/// study(workspace, settings, budget, samplers, samplings, max_spp, own_size, folder or None, reference or
/// None, gallery, name, progress): the texts of study.json and study.csv.
PyObject* make_study(PyObject*, PyObject* arguments);

}  // namespace nook::python
