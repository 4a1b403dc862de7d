#include "base/input_file.hpp"

#include "base/error.hpp"

namespace nook {

std::uint64_t size_of_input(const std::filesystem::path& path) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) throw Error(ErrorKind::scene, Place{path.string()}, "no such file");
  if (!std::filesystem::is_regular_file(status))
    throw Error(ErrorKind::scene, Place{path.string()}, "not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  return code ? 0 : size;
}

}  // namespace nook
