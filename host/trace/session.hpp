#pragma once

#include <functional>
#include <string>

#include "film/film_part.hpp"
#include "plan/plan.hpp"
#include "trace/occlusion_tracer.hpp"

namespace nook {

/// The index-th of count equal parts of a picture (from 0): of the range of sample indices, or, where a pixel
/// has fewer samples than there are parts, of the pixels.
struct Share {
  std::uint32_t index = 0, count = 1;
};

/// Independent randomisations of a point sequence, each with a seed of its own: their spread says how
/// accurate their mean is.
///
/// A session numbers their samples stage by stage: the first stages[0] samples of randomisation 0, of 1, ...,
/// then the samples [stages[0], stages[1]) of each, and so on. So a pixel with samples [0, n) of a session
/// has as even a share of each as can be.
struct Randomisations {
  std::uint32_t count = 1;
  std::vector<std::uint32_t> stages;  ///< samples of each randomisation after each stage, ascending

  /// A range of one randomisation's own samples, `first` in the session's numbering.
  struct Piece {
    std::uint32_t randomisation = 0;
    std::uint32_t first = 0;
    SampleRange range;
  };
  /// The pieces of a session's range.
  std::vector<Piece> pieces(SampleRange range) const;
  /// The samples of randomisation r among a session's samples [0, n).
  std::uint32_t samples_of(std::uint32_t r, std::uint32_t n) const;
  /// The seed of randomisation r: far from those of other seeds' randomisations.
  static std::uint32_t seed_of(std::uint32_t seed, std::uint32_t r);
};

/// Everything that decides a film's bits, in words: what parts must agree in to be joined, or resumed.
/// `extra`: what else decides (a stop rule's parameters).
FilmPart::Texts film_identity(const Plan& plan, const DeviceInfo& device, const std::string& scene_hash,
                              const std::string& mesh_hash, const FilmPart::Texts& extra = {});

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
