#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptive/error_record.hpp"
#include "film/film_part.hpp"
#include "image/image.hpp"
#include "picture/ssao_layers.hpp"
#include "render/observer.hpp"
#include "render/repeat.hpp"
#include "trace/session.hpp"

namespace nook {

class SceneRenderer;

/// The channel of what each pixel got, where its scene does not say it: camera rays.
inline constexpr const char* camera_rays_channel = "camera_rays";

/// What a picture is made for, beside what its scene says.
struct PictureRequest {
  std::vector<std::string> aovs;      ///< more channels, as --aov names them
  std::optional<Share> share;         ///< a part of the picture alone: no image is made
  std::filesystem::path part_file;    ///< where finished samples are kept; empty: nowhere
  double seconds_between_parts = 60;  ///< that the file is written, at least
  bool resume = false;                ///< go on from the file, if it is there
  double start = 0;                   ///< of the scene's time limit, by Deadline::steady_seconds(); 0: now
  unsigned frames = 1;                ///< of each screen-space effect, for timing
  /// Camera rays of each pixel of the window, row by row, of a picture that is made again: those alone,
  /// whatever time it takes. Empty: as the scene says.
  std::vector<std::uint32_t> camera_rays;
};

/// One picture of a SceneRenderer, step by step, so that what is known at each can be recorded:
///
///     PictureRun run(renderer, request);
///     run.take(observer);
///     const Image image = run.image();
class PictureRun {
 public:
  /// Resumes if it is to. Throws Error(device), and Error(scene) if the part is of another picture.
  PictureRun(SceneRenderer& renderer, PictureRequest request);
  ~PictureRun();

  /// What the part's file and the image say of the run.
  void set_metadata(const FilmPart::Texts& metadata);
  /// Takes the samples. Whatever ends it early, what is finished is kept in the part's file. Throws
  /// Error(interrupted) if the observer cancels it, Error(device), Error(output).
  void take(RunObserver& observer);
  /// Writes the part's file, if there is to be one. Throws Error(output).
  void keep();
  /// The whole picture, screen-space layers too; once.
  Image image();

  /// What a stop rule or a time limit reached, after take().
  const std::optional<ErrorRecord>& error() const { return error_; }
  /// No stop rule is left unsatisfied.
  bool complete() const { return complete_; }
  const TraceCounts& counts() const { return counts_; }
  /// Of the samples, with those of the runs that this one resumed.
  double render_seconds() const { return render_seconds_; }
  /// What was drawn, after image().
  const SsaoLayers& ssao() const { return ssao_; }
  /// How the image can be made again from its attributes and channels, which it has; after take(), also
  /// whether.
  Repeat repeat() const;

 private:
  struct Samples;
  std::vector<Channel> channels_of_surface() const;
  std::string why_not_repeatable() const;

  SceneRenderer& renderer_;
  PictureRequest request_;
  AovRequest aovs_;
  std::unique_ptr<Samples> samples_;  // none without a traced effect
  std::vector<SurfacePoint> surface_;
  std::optional<ErrorRecord> error_;
  bool complete_ = true;
  TraceCounts counts_;
  double render_seconds_ = 0;
  SsaoLayers ssao_;
};

}  // namespace nook
