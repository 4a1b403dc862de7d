#include "bakes.hpp"

#include <utility>

#include "base/error.hpp"
#include "calls.hpp"
#include "errors.hpp"
#include "points/corner_points.hpp"

namespace nook::python {
namespace {

SceneRenderer& renderer_to_bake(Workspace& workspace, const std::string& settings, bool to_texture) {
  const Scene scene = scene_to_bake(workspace.with(settings));
  return workspace.renderer(scene, {baked_attributes(scene, to_texture), false, true});
}

TriangleMesh surface_of(const TriangleMesh& mesh) {
  TriangleMesh made;
  made.frame = mesh.frame;
  made.positions = mesh.positions;
  made.triangles = mesh.triangles;
  return made;
}

// Of the properties that MeshBake names.
std::vector<Layer> layers_of_bake(const Plan& plan) {
  std::vector<Layer> layers;
  for (const EffectPlan& effect : plan.effects) {
    const std::string name = effect.label();
    std::vector<std::string> channels = {name};
    if (effect.effect.kind == EffectKind::bent) channels = {name + "_x", name + "_y", name + "_z"};
    layers.push_back({name, std::move(channels)});
  }
  return layers;
}

Object dict_of(const std::shared_ptr<Bake>& bake) {
  std::vector<dvec3> vertices;
  for (const vec3& p : bake->mesh.positions) vertices.push_back(bake->mesh.frame.to_file(dvec3(p)));
  Object dict(PyDict_New());
  set(dict, "properties", list(bake->baked.properties, [](const VertexProperty& property) {
        return tuple(text(property.name), bytes_of(property.values));
      }));
  set(dict, "layers", list_of(bake->layers));
  set(dict, "normals", bytes_of(bake->baked.normals));
  set(dict, "vertices", bytes_of(vertices));
  set(dict, "faces", bytes_of(bake->mesh.triangles));
  set(dict, "bake", Held<Bake>::hold(bake));
  return dict;
}

}  // namespace

Bake bake(Workspace& workspace, bool corners, const std::string& settings, RunObserver& observer) {
  const std::lock_guard lock(workspace.mutex);
  SceneRenderer& renderer = renderer_to_bake(workspace, settings, false);
  Bake made{surface_of(renderer.mesh()), {}, layers_of_bake(renderer.plan()), corners};
  made.baked = corners ? bake_corners(renderer, &observer) : bake_vertices(renderer, &observer);
  renderer.tracer().store_programs();
  return made;
}

Picture bake(Workspace& workspace, const TextureRequest& request, const std::string& settings,
             RunObserver& observer) {
  const std::lock_guard lock(workspace.mutex);
  check_texture(request, workspace.scene());
  SceneRenderer& renderer = renderer_to_bake(workspace, settings, true);
  const TexturePoints texels = texels_of(renderer, request, observer);
  Picture made{bake_texture(renderer, texels, request, &observer), {}, layers_of(renderer.plan()), true};
  renderer.tracer().store_programs();
  return made;
}

void write(const Bake& bake, const std::filesystem::path& file) {
  write_ply(file, bake.corners ? corner_mesh(bake.mesh) : bake.mesh, bake.baked.normals,
            bake.baked.properties);
}

PyObject* bake_onto_mesh(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *progress;
    const char *to, *settings;
    parse(arguments, "OssO", &capsule, &to, &settings, &progress);
    check_fork();
    struct Call {
      std::shared_ptr<Workspace> workspace;
      bool corners;
      std::string settings;
      std::shared_ptr<Bake> made;
    };
    const auto call = std::make_shared<Call>(
        Call{Held<Workspace>::of(capsule), to == std::string("corners"), settings, nullptr});
    run_job(progress, [call](RunObserver& observer) {
      call->made = std::make_shared<Bake>(bake(*call->workspace, call->corners, call->settings, observer));
    });
    return dict_of(call->made);
  });
}

PyObject* bake_into_texture(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *progress;
    const char *aovs, *settings;
    struct Call {
      std::shared_ptr<Workspace> workspace;
      TextureRequest request;
      std::string settings;
      Picture made;
    };
    const auto call = std::make_shared<Call>();
    parse(arguments, "OiissO", &capsule, &call->request.size, &call->request.dilation, &aovs, &settings,
          &progress);
    check_fork();
    call->workspace = Held<Workspace>::of(capsule);
    call->request.aovs = words_of(aovs);
    call->settings = settings;
    run_job(progress, [call](RunObserver& observer) {
      call->made = bake(*call->workspace, call->request, call->settings, observer);
    });
    return result_of(std::move(call->made));
  });
}

PyObject* save_bake(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *file;
    parse(arguments, "OO", &capsule, &file);
    const std::shared_ptr<Bake> bake = Held<Bake>::of(capsule);
    const std::filesystem::path path = path_of(file);
    {
      const WithoutGil others_run;
      write(*bake, path);
    }
    return Object(Py_NewRef(Py_None));
  });
}

}  // namespace nook::python
