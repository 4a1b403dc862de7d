#include "app/commands/render_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/exit_code.hpp"
#include "base/counted.hpp"
#include "base/error.hpp"
#include "base/to_stderr.hpp"
#include "scene/effect_keys.hpp"
#include "scene/names.hpp"

namespace nook {
namespace {

std::string samples_text(const Plan& plan, const StopTarget& stop) {
  if (!stop.any()) return fmt::format("{} spp", plan.spp);
  std::string text = stop.error ? fmt::format("to a standard error of {}", *stop.error) : "";
  if (stop.seconds) text += fmt::format("{}{} seconds", stop.error ? ", at most " : "for ", *stop.seconds);
  return text + fmt::format(", at most {} spp", plan.spp);
}

}  // namespace

void announce(const RunRecord& record, const StopTarget& stop) {
  const Plan& plan = record.plan;
  for (const EffectPlan& effect : plan.effects)
    to_stderr("{} {}x{}, {}, {} x {}, {}, {}, {}\n", effect.label(), plan.window.width(),
              plan.window.height(), counted(record.triangles, "triangle"), samples_text(plan, stop),
              counted(plan.directions, "direction"), name_of(plan.sampler), settings_text(effect.resolved()),
              record.device.name);
}

void announce_end(const RunRecord& r, const std::filesystem::path& output) {
  if (!r.plan.needs_opencl()) {
    to_stderr("{}: load {:.2f} s, render {:.2f} s, write {:.2f} s\n", output.string(), r.seconds.load,
              r.seconds.render, r.seconds.write);
    return;
  }
  to_stderr(
      "{}: load {:.2f} s, tree {:.2f} s, kernels {:.2f} s{}, render {:.2f} s ({:.1f} Mrays/s), {}write "
      "{:.2f} s\n",
      output.string(), r.seconds.load, r.seconds.bvh, r.seconds.compile,
      r.kernels_from_cache ? " (cached)" : "", r.seconds.render,
      double(r.counts.camera_rays + r.counts.occlusion_rays) / std::max(r.seconds.render, 1e-9) * 1e-6,
      r.ssao.empty() ? "" : fmt::format("ssao {:.2f} s, ", r.seconds.ssao), r.seconds.write);
  warn_of_rejected(r.counts.rejected);
}

void warn_of_rejected(std::uint64_t samples) {
  if (samples)
    to_stderr("warning: {} not finite and left out\n", counted(samples, "sample was", "samples were"));
}

int announce_error(const ErrorRecord& error, bool quiet) {
  const bool missed = error.asked > 0 && (error.share_done < 1 || error.reached > error.asked);
  if (quiet && !missed) return 0;
  const std::string asked = error.asked > 0 ? fmt::format(" (asked: {}, {:.1f} % of the pixels done)",
                                                          error.asked, 100 * error.share_done)
                                            : "";
  to_stderr("{}standard error {:.5f}, at most {:.5f}{}\n", missed ? "nook: target missed: " : "",
            error.reached, error.worst, asked);
  return missed ? int(ExitCode::target) : 0;
}

void announce_ssao(const RunRecord& record) {
  for (const SsaoRecord& drawn : record.ssao) {
    to_stderr("{} {}x{}, {}, {}, radius {:.6g} world units: {:.1f} ms a frame, {:.1f} fps (", drawn.name,
              record.plan.width, record.plan.height, counted(record.triangles, "triangle"),
              name_of(drawn.plan.method), drawn.plan.radius, 1e3 * drawn.seconds_per_frame,
              1 / std::max(drawn.seconds_per_frame, 1e-9));
    for (std::size_t i = 0; i < drawn.passes.size(); ++i)
      to_stderr("{}{} {:.1f}", i == 0 ? "" : ", ", drawn.passes[i].pass, 1e3 * drawn.passes[i].seconds);
    to_stderr(" ms)\n");
  }
}

}  // namespace nook
