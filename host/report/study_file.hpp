#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "report/study.hpp"

namespace nook {

/// What a study was made of and on: "scene" -> "cbox_ao_cosine.toml", "device" -> ..., in the order shown.
using StudyFacts = std::vector<std::pair<std::string, std::string>>;

/// Writes DIR/study.json: facts, methods, points with every run (what resume reads), summaries. Throws
/// Error(output).
void write_study_json(const std::filesystem::path& path, const Study& study, const StudyFacts& facts);

/// One row per point, after a row of names; docs/study.md explains the columns.
std::string study_csv(const Study& study);

/// Writes it as DIR/study.csv. Throws Error(output).
void write_study_csv(const std::filesystem::path& path, const Study& study);

/// The points in a study.json whose facts agree in `identity` with `facts`; none if there is no such file.
/// Throws Error(scene) if the file is not a study's.
std::vector<StudyPoint> read_study_points(const std::filesystem::path& path, const StudyFacts& facts,
                                          const std::vector<std::string>& identity);

/// The study as the page shows it: facts, methods with their curves, fits, costs of errors. One JSON object.
std::string study_json(const Study& study, const StudyFacts& facts);

}  // namespace nook
