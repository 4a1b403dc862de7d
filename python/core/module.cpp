// nook._core: the front door of libnook for the package nook, which checks shapes and types before it calls.
#include <cctype>
#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "errors.hpp"
#include "estimates.hpp"
#include "image/exr.hpp"
#include "image/png.hpp"
#include "jobs.hpp"
#include "keys.hpp"
#include "mesh/mesh_of_arrays.hpp"
#include "scene/names.hpp"
#include "scene/scene_writer.hpp"
#include "workspace.hpp"

namespace nook::python {

std::vector<double> doubles(PyObject* array, const char* name) {
  if (array == Py_None) return {};
  const Buffer buffer(array);
  if (!buffer.is('d')) {
    PyErr_Format(PyExc_TypeError, "%s: an array of doubles is needed", name);
    throw ErrorIsSet();
  }
  const auto values = buffer.as<double>();
  return {values.begin(), values.end()};
}

namespace {

// What Python holds is a capsule of a shared_ptr: a job that goes on alone keeps what it uses.
template <class T>
struct Held {
  static const char* name;
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
const char* Held<Workspace>::name = "nook.workspace";
template <>
const char* Held<Picture>::name = "nook.picture";

template <class... Places>
void parse(PyObject* arguments, const char* format, Places... places) {
  if (!PyArg_ParseTuple(arguments, format, places...)) throw ErrorIsSet();
}

// A file's name by os.fspath() and os.fsencode().
std::filesystem::path path_of(PyObject* object) {
  PyObject* encoded = nullptr;
  if (!PyUnicode_FSConverter(object, &encoded)) throw ErrorIsSet();
  const Object bytes(encoded);
  return std::string(PyBytes_AsString(bytes.get()), std::size_t(PyBytes_Size(bytes.get())));
}

TriangleMesh mesh_of(PyObject* vertices, PyObject* faces, PyObject* normals) {
  const Buffer v(vertices), f(faces);
  std::vector<float> n;
  if (normals != Py_None) {
    const Buffer buffer(normals);
    n.assign(buffer.as<float>().begin(), buffer.as<float>().end());
  }
  const auto triangles = f.as<std::uint32_t>();
  return v.is('d') ? mesh_of_arrays(v.as<double>(), triangles, n)
                   : mesh_of_arrays(v.as<float>(), triangles, n);
}

// open(file or None, vertices, faces, normals, settings, device): a workspace.
PyObject* open(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *file, *vertices, *faces, *normals;
    const char *settings, *device;
    parse(arguments, "OOOOss", &file, &vertices, &faces, &normals, &settings, &device);
    struct Request {
      std::filesystem::path file;
      TriangleMesh mesh;
      std::string settings, device;
      std::shared_ptr<Workspace> made;
    };
    const auto request = std::make_shared<Request>(Request{{}, {}, settings, device, nullptr});
    if (file != Py_None)
      request->file = path_of(file);
    else
      request->mesh = mesh_of(vertices, faces, normals);
    run_job(Py_None, [request, of_file = file != Py_None](RunObserver&) {
      request->made =
          of_file ? std::make_shared<Workspace>(request->file, request->settings, request->device)
                  : std::make_shared<Workspace>(std::move(request->mesh), request->settings, request->device);
    });
    warn(request->made->take_warnings());
    return Held<Workspace>::hold(request->made);
  });
}

// estimate(workspace, type, points, normals, views or None, samples, settings, progress): a dict of
// bytearrays.
PyObject* estimate_at_points(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *points, *normals, *views, *progress;
    const char *type, *settings;
    unsigned samples;
    parse(arguments, "OsOOOIsO", &capsule, &type, &points, &normals, &views, &samples, &settings, &progress);
    check_fork();
    struct Call {
      std::shared_ptr<Workspace> workspace;
      PointRequest request;
      Estimates made;
    };
    const auto call = std::make_shared<Call>();
    call->workspace = Held<Workspace>::of(capsule);
    call->request = {*value_of<EffectKind>(effect_names, type),
                     doubles(points, "points"),
                     doubles(normals, "normals"),
                     doubles(views, "views"),
                     samples,
                     settings};
    run_job(progress, [call](RunObserver& observer) {
      call->made = estimate(*call->workspace, call->request, observer);
    });
    const Estimates& e = call->made;
    Object dict(PyDict_New());
    set(dict, "value", bytes_of(e.value));
    set(dict, "standard_error", bytes_of(e.standard_error));
    set(dict, "samples", bytes_of(e.samples));
    set(dict, "direction", bytes_of(e.direction));
    set(dict, "half_angle", bytes_of(e.half_angle));
    return dict;
  });
}

Object channel_of(const Channel& channel) {
  return std::visit(
      [&](const auto& values) {
        const bool whole = std::is_same_v<decltype(values), const std::vector<std::uint32_t>&>;
        return tuple(text(channel.name), text(whole ? "uint32" : "float32"), bytes_of(values));
      },
      channel.values);
}

Object result_of(Picture made) {
  Object dict(PyDict_New());
  set(dict, "width", number(std::uint64_t(made.image.width)));
  set(dict, "height", number(std::uint64_t(made.image.height)));
  set(dict, "complete", Object(PyBool_FromLong(made.complete)));
  set(dict, "channels", list(made.image.channels, channel_of));
  set(dict, "layers", list(made.layers, [](const Layer& layer) {
        return tuple(text(layer.name), list(layer.channels, text));
      }));
  set(dict, "picture", Held<Picture>::hold(std::make_shared<Picture>(std::move(made))));
  return dict;
}

// render(workspace, settings, aovs, progress): a dict of a picture.
PyObject* render_picture(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *progress;
    const char *settings, *aovs;
    parse(arguments, "OssO", &capsule, &settings, &aovs, &progress);
    check_fork();
    struct Call {
      std::shared_ptr<Workspace> workspace;
      std::string settings;
      std::vector<std::string> aovs;
      Picture made;
    };
    const auto call = std::make_shared<Call>();
    call->workspace = Held<Workspace>::of(capsule);
    call->settings = settings;
    std::string name;
    for (const char c : std::string(aovs) + ' ') {
      if (c != ' ') {
        name += c;
      } else if (!name.empty()) {
        call->aovs.push_back(std::exchange(name, {}));
      }
    }
    run_job(progress, [call](RunObserver& observer) {
      call->made = render(*call->workspace, call->settings, call->aovs, observer);
    });
    return result_of(std::move(call->made));
  });
}

// save(picture, file)
PyObject* save(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *file;
    parse(arguments, "OO", &capsule, &file);
    const std::shared_ptr<Picture> picture = Held<Picture>::of(capsule);
    const std::filesystem::path path = path_of(file);
    std::string extension = path.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (!extension.empty() && extension != ".png" && extension != ".exr")
      throw Error(ErrorKind::usage, Place{path.string()}, "not a format that is written here (.exr, .png)");
    {
      const WithoutGil others_run;
      if (extension == ".png")
        write_png(path, picture->image, picture->background);
      else
        write_exr(path, picture->image);
    }
    return Object(Py_NewRef(Py_None));
  });
}

// toml(workspace): its scene with every key.
PyObject* toml(PyObject*, PyObject* capsule) {
  return guarded([&] { return text(to_toml(Held<Workspace>::of(capsule)->scene())); });
}

PyObject* wait(PyObject*, PyObject*) {
  wait_for_jobs();
  return Py_NewRef(Py_None);
}

PyMethodDef methods[] = {
    {"open", open, METH_VARARGS, nullptr},
    {"estimate", estimate_at_points, METH_VARARGS, nullptr},
    {"render", render_picture, METH_VARARGS, nullptr},
    {"save", save, METH_VARARGS, nullptr},
    {"toml", toml, METH_O, nullptr},
    {"devices", [](PyObject*, PyObject*) { return guarded(devices); }, METH_NOARGS, nullptr},
    {"keys", [](PyObject*, PyObject*) { return guarded(keys); }, METH_NOARGS, nullptr},
    {"wait", wait, METH_NOARGS, nullptr},
    {nullptr, nullptr, 0, nullptr}};

PyModuleDef module = {
    PyModuleDef_HEAD_INIT, "nook._core", nullptr, -1, methods, nullptr, nullptr, nullptr, nullptr};

}  // namespace
}  // namespace nook::python

PyMODINIT_FUNC PyInit__core() {  // NOLINT(bugprone-reserved-identifier): Python asks for it
  return PyModule_Create(&nook::python::module);
}
