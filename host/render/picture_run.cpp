#include "render/picture_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "adaptive/adaptive.hpp"
#include "adaptive/stop_target.hpp"
#include "base/stopwatch.hpp"
#include "film/film_part_file.hpp"
#include "picture/adaptive_picture.hpp"
#include "picture/denoise_picture.hpp"
#include "picture/picture.hpp"
#include "picture/surface_layers.hpp"
#include "render/checkpoint_writer.hpp"
#include "render/run.hpp"
#include "render/scene_renderer.hpp"
#include "scene/scene_writer.hpp"
#include "trace/deadline.hpp"
#include "trace/identity.hpp"

namespace nook {
namespace {

std::vector<std::uint32_t> row_major(const PixelRect& window, int width) {
  std::vector<std::uint32_t> pixels;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      pixels.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
  return pixels;
}

FilmPart::Texts texts_of_rule(const StopTarget& stop) {
  if (!stop.error) return {};
  return {{"error", fmt::format("{}", *stop.error)},
          {"confidence", fmt::format("{}", stop.confidence)},
          {"min_spp", std::to_string(stop.min_spp)}};
}

}  // namespace

// The films of the traced effects: to a number of samples, or to an error.
struct PictureRun::Samples {
  CheckpointWriter writer;
  std::optional<AdaptiveRender> adaptive;
  std::optional<Session> fixed;
  AdaptiveResult result;

  Session& session() { return adaptive ? adaptive->session() : *fixed; }
};

PictureRun::PictureRun(SceneRenderer& renderer, PictureRequest request)
    : renderer_(renderer), request_(std::move(request)), aovs_(parse_aovs(request_.aovs)) {
  renderer_.settle();
  const Plan& plan = renderer_.plan();
  const StopTarget& stop = renderer_.scene().stop;
  if (request_.start == 0) request_.start = Deadline::steady_seconds();
  if (plan.effects.empty()) return;
  samples_ = std::make_unique<Samples>(
      Samples{CheckpointWriter(request_.part_file, request_.seconds_between_parts), {}, {}, {}});
  FilmPart::Texts identity = film_identity(plan, renderer_.device().info(), scene_hash(renderer_.scene()),
                                           renderer_.mesh_hash(), texts_of_rule(stop));
  OcclusionTracer& tracer = renderer_.tracer();
  if (stop.error)
    samples_->adaptive.emplace(tracer, plan, error_target(stop), std::move(identity));
  else
    samples_->fixed.emplace(tracer, plan, std::move(identity));
  Session& session = samples_->session();
  std::error_code code;
  if (request_.resume && std::filesystem::exists(request_.part_file, code))
    session.resume(read_film_part(request_.part_file), request_.part_file.string());
  session.part().layers = layer_names(plan);
  session.part().aovs = request_.aovs;
}

PictureRun::~PictureRun() = default;

void PictureRun::set_metadata(const FilmPart::Texts& metadata) {
  if (samples_) samples_->session().part().metadata = metadata;
}

std::vector<Channel> PictureRun::channels_of_surface() const {
  const Plan& plan = renderer_.plan();
  if (!plan.surface) return {};
  std::vector<Channel> channels = surface_channels(plan, aovs_, surface_);
  add_surface_layers(plan, surface_, channels);
  return channels;
}

void PictureRun::take(RunObserver& observer) {
  const Plan& plan = renderer_.plan();
  const StopTarget& stop = renderer_.scene().stop;
  const Stopwatch watch;
  if (samples_) {
    Session& session = samples_->session();
    const bool timed = stop.seconds && request_.camera_rays.empty();
    const Deadline deadline(timed ? std::optional(request_.start + *stop.seconds) : std::nullopt);
    const RunControl control{renderer_.tracer(), samples_->writer, deadline, observer};
    if (samples_->adaptive) {
      const AdaptiveResult& result = samples_->result = run_to_error(*samples_->adaptive, control);
      error_ = ErrorRecord{result.error_asked, stop.confidence, result.error_reached, result.error_worst,
                           result.share_done};
      complete_ = result.met();
    } else {
      const SampleBox share = session.share(request_.share.value_or(Share{}));
      Session::Schedule schedule = timed ? doublings() : all_of(share);
      SampleBoxes all{share};
      if (!request_.camera_rays.empty())
        all = (schedule = all_of_each(session, request_.camera_rays))(session);
      run_schedule(session, schedule, samples_in(subtract(all, session.held())), control);
      if (stop.seconds) error_ = error_of(session.films());
    }
  }
  // One point at each pixel's centre, if anything is made of them.
  if (plan.surface && plan.needs_opencl()) {
    surface_ = renderer_.tracer().surface_points(row_major(plan.window, plan.width));
    if (!samples_) counts_.camera_rays = surface_.size();
  }
  if (!samples_) {
    render_seconds_ = watch.seconds();
    return;
  }
  FilmPart& part = samples_->session().part();
  part.surface = channels_of_surface();
  if (plan.preview_ground) part.surface.push_back(preview_ground(plan, surface_));
  counts_ = part.counts;
  render_seconds_ = part.render_seconds;
}

std::string PictureRun::why_not_repeatable() const {
  if (!renderer_.mesh_of_files()) return "its mesh was given as arrays, which no file holds";
  const StopTarget& stop = renderer_.scene().stop;
  if (!samples_ || !stop.seconds) return "";
  if (stop.error) return complete_ ? "" : "its time ended before its error was met";
  return has_first_samples(samples_->session()) ? "" : "its pixels have other samples than their first";
}

Repeat PictureRun::repeat() const {
  return {scene_attribute(renderer_.scene()), renderer_.mesh_hash(), request_.aovs, why_not_repeatable()};
}

void PictureRun::keep() {
  if (samples_) samples_->writer.write(samples_->session());
}

Image PictureRun::image() {
  const Plan& plan = renderer_.plan();
  Image image;
  if (samples_) {
    const FilmPart& part = samples_->session().part();
    image = samples_->adaptive ? adaptive_picture(plan, part, samples_->result) : make_picture(part);
    if (plan.denoise) denoise_picture(plan, part.films, surface_, image);
    const StopTarget& stop = renderer_.scene().stop;
    if (stop.seconds && !stop.error && has_first_samples(samples_->session()))
      image.channels.push_back({camera_rays_channel, part.films.front().camera_samples});
  } else if (plan.needs_opencl()) {
    image = {plan.window.width(), plan.window.height(), channels_of_surface(), {}};
    for (const SurfacePoint& point : surface_) image.coverage.push_back(point.flags & SURFACE_HIT ? 1 : 0);
  }
  if (!plan.ssao.empty())
    ssao_ = draw_ssao(renderer_.scene(), renderer_.mesh(), plan, plan.needs_opencl() ? AovRequest{} : aovs_,
                      request_.frames, image);
  place_crop(image, plan);
  image.metadata = repeat().attributes();
  return image;
}

}  // namespace nook
