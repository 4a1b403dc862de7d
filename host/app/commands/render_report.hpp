#pragma once

#include <cstdint>
#include <filesystem>

#include "app/exit_code.hpp"
#include "image/image.hpp"
#include "report/run_record.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Says what will be rendered, and until when.
void announce(const RunRecord& record, const StopTarget& stop);

/// Says what it took.
void announce_end(const RunRecord& record, const std::filesystem::path& output);

/// Says how many samples were left out, where there are any.
void warn_of_rejected(std::uint64_t samples);

/// Says what a stop rule reached. Returns the exit code: ExitCode::target if more was asked for.
int announce_error(const ErrorRecord& error, bool quiet);

/// One line to stderr for each screen-space effect drawn: its time, and that of its passes.
void announce_ssao(const RunRecord& record);

}  // namespace nook
