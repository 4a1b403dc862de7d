// What is told of a scene: plan, info, study.
#include <utility>

#include "base/error.hpp"
#include "bvh/bvh.hpp"
#include "calls.hpp"
#include "errors.hpp"
#include "report/plan_json.hpp"
#include "report/scene_info.hpp"
#include "report/study_job.hpp"
#include "scene/names.hpp"

namespace nook::python {
namespace {

std::string json_of_plan(Workspace& workspace) {
  const std::lock_guard lock(workspace.mutex);
  const Scene& scene = workspace.scene();
  const TriangleMesh& mesh = workspace.mesh(needed_attributes(scene));
  const Plan plan = make_plan(scene, mesh);
  std::optional<Bvh> bvh;
  if (plan.needs_opencl()) bvh = build_bvh(mesh);  // of 16 children a node: no device is asked
  return plan_json(plan, mesh, report_plan(scene, plan, mesh, bvh ? &*bvh : nullptr));
}

std::string json_of_info(Workspace& workspace) {
  const std::lock_guard lock(workspace.mutex);
  const Scene& scene = workspace.scene();
  return info_json(
      scene_info(scene, workspace.mesh({.normals = true, .uvs = true, .materials = true, .groups = true}),
                 scene.stop.any()));
}

Object told_by(PyObject* capsule, std::string (*tell)(Workspace&)) {
  struct Call {
    std::shared_ptr<Workspace> workspace;
    std::string text;
  };
  const auto call = std::make_shared<Call>(Call{Held<Workspace>::of(capsule), {}});
  run_job(Py_None, [call, tell](RunObserver&) { call->text = tell(*call->workspace); });
  return text(call->text);
}

template <class T>
std::vector<T> chosen(const char* argument, const std::string& text, NameTable<T> names) {
  std::vector<T> values;
  for (const std::string& word : words_of(text)) {
    const auto value = value_of(names, word);
    if (!value) throw Error(ErrorKind::usage, std::string(argument) + ": unknown value '" + word + "'");
    values.push_back(*value);
  }
  return values;
}

StudyResult study(Workspace& workspace, const std::string& settings, StudyRequest request,
                  RunObserver& observer) {
  StudyJob job(std::move(request));
  const std::lock_guard lock(workspace.mutex);
  const Scene scene = workspace.with(settings);
  check_choice(job.request().choice, scene.effects.front());
  SceneRenderer& renderer = workspace.renderer(scene, {needed_attributes(scene), false, true});
  renderer.expect_rays(HUGE_VAL);  // a study's are many
  return job.run(renderer, observer);
}

}  // namespace

PyObject* plan_of(PyObject*, PyObject* workspace) {
  return guarded([&] { return told_by(workspace, json_of_plan); });
}

PyObject* info_of(PyObject*, PyObject* workspace) {
  return guarded([&] { return told_by(workspace, json_of_info); });
}

PyObject* make_study(PyObject*, PyObject* arguments) {
  return guarded([&] {
    PyObject *capsule, *folder, *reference, *progress;
    const char *settings, *samplers, *samplings, *name;
    int own_size, gallery;
    struct Call {
      std::shared_ptr<Workspace> workspace;
      std::string settings;
      StudyRequest request;
      StudyResult made;
    };
    const auto call = std::make_shared<Call>();
    StudyRequest& request = call->request;
    parse(arguments, "OsdssIpOOpsO", &capsule, &settings, &request.budget, &samplers, &samplings,
          &request.choice.max_spp, &own_size, &folder, &reference, &gallery, &name, &progress);
    check_fork();
    call->workspace = Held<Workspace>::of(capsule);
    call->settings = settings;
    request.choice.samplers = chosen<Sampler>("samplers", samplers, sampler_names);
    request.choice.samplings = chosen<Sampling>("samplings", samplings, sampling_names);
    request.own_size = own_size != 0;
    request.folder = path_of(folder);
    request.reference = path_of(reference);
    request.gallery = gallery != 0;
    request.name = name;
    request.command = std::string("nook.study(") + name + ")";
    if (!request.folder.empty()) request.library = load_plot_library({});
    run_job(progress, [call](RunObserver& observer) {
      call->made = study(*call->workspace, call->settings, std::move(call->request), observer);
    });
    return tuple(text(call->made.json), text(call->made.csv));
  });
}

}  // namespace nook::python
