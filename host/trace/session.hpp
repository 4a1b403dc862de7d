#pragma once

#include <functional>
#include <string>

#include "film/film_part.hpp"
#include "plan/plan.hpp"
#include "trace/identity.hpp"
#include "trace/occlusion_tracer.hpp"
#include "trace/randomisations.hpp"

namespace nook {

/// The index-th of count equal parts of a picture (from 0): of the range of sample indices, or, where a pixel
/// has fewer samples than there are parts, of the pixels.
struct Share {
  std::uint32_t index = 0, count = 1;
};

/// A render under way: films, which samples of which pixels they hold, and what comes next. Samples are
/// numbered as in SampleRange, pixels by their position in order().
///
///     Session session(tracer, plan, identity);
///     if (resuming) session.resume(read_film_part(file), file);
///     while (!session.run(all_of(session.share({0, 1})), go_on)) ...
class Session {
 public:
  /// What to do next, given what there is: the boxes of one step (samples that are held already do not
  /// count), none of them new: the render is finished. It is asked when a step is complete. A resumed render
  /// goes on with the step under way and makes the same decisions as one that was never stopped if a schedule
  /// depends on nothing but films(), held() and constants.
  using Schedule = std::function<SampleBoxes(const Session&)>;
  /// Called after each launch, when films() and held() agree; false stops.
  using GoOn = std::function<bool()>;

  /// `tracer` must outlive it. With more than one randomisation Film::kept[r] is the sum of randomisation r,
  /// in the fixed point of Film::sum; rule_planes more planes follow, for a stop rule.
  Session(OcclusionTracer& tracer, const Plan& plan, FilmPart::Texts identity,
          Randomisations randomisations = {}, std::size_t rule_planes = 0);

  /// Continues `part`. Throws Error(scene) naming `file` if it is of another picture, or its sums and its
  /// sample ranges disagree.
  void resume(FilmPart part, const std::string& file);

  /// Works until the schedule has nothing new (true) or `go_on` stops it (false). Throws Error(device);
  /// films() and held() agree then too.
  bool run(const Schedule& schedule, const GoOn& go_on);

  const std::vector<Film>& films() const { return part_.films; }
  /// For a stop rule's planes.
  std::vector<Film>& films() { return part_.films; }
  const SampleBoxes& held() const { return held_.boxes(); }
  /// Samples in held().
  std::uint64_t samples_held() const { return samples_held_; }
  /// The pixel (y * width + x in the whole image) at each position.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// The index in a film of the pixel at a position.
  std::size_t film_index(std::uint32_t position) const { return plan_.film_index(order_[position]); }
  /// All samples of a share of the picture.
  SampleBox share(const Share& share) const;
  /// The state to write to a file, or to make the picture of; layers, aovs, metadata and surface are the
  /// caller's to fill in.
  FilmPart& part();

 private:
  bool work(const SampleBoxes& open, const GoOn& go_on);
  bool work(const SampleBoxes& boxes, SampleRange range, const GoOn& go_on);
  bool work(const std::vector<std::uint32_t>& positions, const std::vector<std::uint32_t>& pixels,
            const Randomisations::Piece& piece, const GoOn& go_on);
  void keep_sums(std::uint32_t randomisation, std::size_t pixel);

  OcclusionTracer& tracer_;
  Plan plan_;
  Randomisations randomisations_;
  std::vector<std::uint32_t> order_;
  FilmPart part_;
  HeldSamples held_;
  std::uint64_t samples_held_ = 0;
};

/// The schedule of a fixed number of samples: all of `box`.
Session::Schedule all_of(const SampleBox& box);

}  // namespace nook
