#include "mesh/mesh_text.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "base/memory.hpp"
#include "mesh/load_mesh.hpp"

namespace nook {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::scene, Place{path.string()}, what);
}

LargeVector<char> inflated(const std::filesystem::path& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  if (!file) fail(path, fmt::format("cannot be read ({})", std::strerror(errno)));
  gzbuffer(file.get(), 1 << 18);
  // A text is read beside the mesh that is made of it.
  const std::size_t most =
      std::size_t(std::min<std::uint64_t>(available_memory() / 3, std::uint64_t(1) << 40));
  LargeVector<char> bytes(std::size_t(1) << 20);
  std::size_t size = 0;
  for (;;) {
    const unsigned room = unsigned(std::min<std::size_t>(bytes.size() - size, 1 << 30));
    const int got = gzread(file.get(), bytes.data() + size, room);
    int code = Z_OK;
    const char* what = gzerror(file.get(), &code);
    if (got < 0 || (code != Z_OK && code != Z_STREAM_END))
      fail(path, code == Z_BUF_ERROR
                     ? "the compressed file ends too early"
                     : fmt::format("is damaged ({})", code == Z_ERRNO ? std::strerror(errno) : what));
    if (got == 0) break;
    size += std::size_t(got);
    if (size > most)
      fail(path, fmt::format("holds more than {} MiB, a third of the free memory", most >> 20));
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  if (gzdirect(file.get())) fail(path, "is not compressed by gzip, as its name says");
  bytes.resize(size);
  return bytes;
}

}  // namespace

LargeVector<char> read_mesh_file(const std::filesystem::path& path) {
  const std::uint64_t size = size_of_input(path);
  if (is_compressed(path)) return inflated(path);
  LargeVector<char> text(size);
  std::ifstream in(path, std::ios::binary);
  if (!in || !in.read(text.data(), std::streamsize(text.size())))
    fail(path, fmt::format("cannot be read ({})", std::strerror(errno)));
  return text;
}

std::string_view without_byte_order_mark(std::string_view text, const std::filesystem::path& name) {
  if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    fail(name, "the text is UTF-16: save it as UTF-8 or ASCII");
  return text;
}

}  // namespace nook
