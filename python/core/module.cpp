// nook._core: the front door of libnook for the package nook, which checks shapes and types before it calls.
#include <cctype>
#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "calls.hpp"
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

std::vector<vec2> pairs(PyObject* array) {
  if (array == Py_None) return {};
  const Buffer buffer(array);
  const auto values = buffer.as<float>();
  std::vector<vec2> made;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) made.emplace_back(values[i], values[i + 1]);
  return made;
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

// estimate(workspace, type, points, normals, views or None, samples, point set or None, shift, settings,
// progress): a dict of bytearrays.
PyObject* estimate_at_points(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *points, *normals, *views, *point_set, *progress;
    const char *type, *settings;
    unsigned samples;
    int shift;
    parse(arguments, "OsOOOIOpsO", &capsule, &type, &points, &normals, &views, &samples, &point_set, &shift,
          &settings, &progress);
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
                     pairs(point_set),
                     shift != 0,
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
    call->aovs = words_of(aovs);
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
      if (extension == ".png") {
        write_png(path, picture->image, picture->background);
      } else {
        Image image = picture->image;
        image.metadata["nook/folder"] =
            std::filesystem::absolute(path).lexically_normal().parent_path().string();
        write_exr(path, image);
      }
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
    {"bake", bake_onto_mesh, METH_VARARGS, nullptr},
    {"bake_texture", bake_into_texture, METH_VARARGS, nullptr},
    {"save_bake", save_bake, METH_VARARGS, nullptr},
    {"save", save, METH_VARARGS, nullptr},
    {"plan", plan_of, METH_O, nullptr},
    {"info", info_of, METH_O, nullptr},
    {"study", make_study, METH_VARARGS, nullptr},
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
