#pragma once

#include <ImfForward.h>

#include <filesystem>

namespace nook {

/// Checks what a reader would believe before it allocates: the attributes' sizes against the file's size, the
/// kind of file, and that the pixels claimed could come from that number of bytes. Throws Error(scene), one
/// line. The first returns the file's version field.
int check_exr_layout(const std::filesystem::path& path);
void check_exr_size(const std::filesystem::path& path, const Imf::Header& header);

}  // namespace nook
