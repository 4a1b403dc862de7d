#include "render/checkpoint_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "film/film_part_file.hpp"

namespace nook {

std::string CheckpointWriter::update(Session& session) {
  std::string failure;
  if (file_.empty()) return failure;
  const auto start = Clock::now();
  if (std::chrono::duration<double>(start - last_).count() < every_) return failure;
  try {
    write_film_part(file_, session.part());
  } catch (const Error& e) {
    failure = e.what();
  }
  last_ = Clock::now();
  every_ = std::max(every_, 20 * std::chrono::duration<double>(last_ - start).count());
  return failure;
}

void CheckpointWriter::write(Session& session) {
  if (!file_.empty()) write_film_part(file_, session.part());
}

std::string CheckpointWriter::what_is_kept(const Session& session) const {
  if (file_.empty()) return "; nothing was written";
  // How many samples a render to an error will need is not known.
  if (!session.films().front().kept.empty())
    return fmt::format("; {} holds what is finished, --resume goes on from there", file_.string());
  const double share = double(session.samples_held()) / double(session.share({0, 1}).samples());
  return fmt::format("; {} holds {:.1f} % of the picture's samples, --resume goes on from there",
                     file_.string(), 100 * share);
}

}  // namespace nook
