#include "image/exr_header.hpp"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfHeader.h>
#include <ImfTileDescription.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/error.hpp"

namespace nook {

namespace {

// The file format's constants: OpenEXR, "File Layout", sections "Magic Number" and "Version Field".
constexpr std::uint32_t magic = 20000630;
constexpr std::uint32_t flag_deep = 0x800;
constexpr std::uint32_t flag_multi_part = 0x1000;
constexpr std::size_t longest_name = 255;

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ErrorKind::scene, fmt::format("cannot read {}: {}", path.string(), reason));
}

std::uint32_t read_u32(std::istream& in) {
  unsigned char bytes[4] = {};
  in.read(reinterpret_cast<char*>(bytes), sizeof bytes);
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

/// Reads a name that ends with a zero byte; false if it does not end in time.
bool read_name(std::istream& in, std::string& name) {
  name.clear();
  for (char c; in.get(c);) {
    if (c == '\0') return true;
    if (name.size() == longest_name) return false;
    name.push_back(c);
  }
  return false;
}

// The sizes of the types that have one. OpenEXR reads these, and lists, by what they should be, and goes on
// behind that, whatever size the file states: it would then see another header than the one checked here, and
// believe it how long a string is.
constexpr std::pair<std::string_view, std::uint32_t> type_sizes[] = {{"box2f", 16},
                                                                     {"box2i", 16},
                                                                     {"chromaticities", 32},
                                                                     {"compression", 1},
                                                                     {"deepImageState", 1},
                                                                     {"double", 8},
                                                                     {"envmap", 1},
                                                                     {"float", 4},
                                                                     {"int", 4},
                                                                     {"keycode", 28},
                                                                     {"lineOrder", 1},
                                                                     {"m33d", 72},
                                                                     {"m33f", 36},
                                                                     {"m44d", 128},
                                                                     {"m44f", 64},
                                                                     {"rational", 8},
                                                                     {"tiledesc", 9},
                                                                     {"timecode", 8},
                                                                     {"v2d", 16},
                                                                     {"v2f", 8},
                                                                     {"v2i", 8},
                                                                     {"v3d", 24},
                                                                     {"v3f", 12},
                                                                     {"v3i", 12}};

/// Whether the value at `in` ends after `bytes` as OpenEXR reads it.
bool value_fits(std::istream& in, const std::string& type, std::uint32_t bytes) {
  for (const auto& [name, size] : type_sizes)
    if (type == name) return bytes == size;
  const std::streamoff end = in.tellg() + std::streamoff(bytes);
  if (type == "chlist") {
    for (std::string name; in.tellg() < end && read_name(in, name); in.seekg(16, std::ios::cur))
      if (name.empty()) return in.tellg() == end;
    return false;
  }
  if (type == "stringvector") {
    while (in && in.tellg() < end) {
      const std::uint32_t length = read_u32(in);
      if (!in || length > end - in.tellg()) return false;
      in.seekg(length, std::ios::cur);
    }
    return in && in.tellg() == end;
  }
  if (type == "preview") {
    const std::uint64_t width = read_u32(in), height = read_u32(in);
    return in && width < 65536 && height < 65536 && bytes == 8 + 4 * width * height;
  }
  return true;
}

/// Upper bound of what a byte of the file can expand to. Deflate's is 1032 (RFC 1951: 258 bytes from 2 bits);
/// the wavelet and DCT methods have none but the chunk headers, of which 16 bytes describe 32 or 256 lines.
std::uint64_t largest_expansion(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
      return 2;
    case Imf::PIZ_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
    case Imf::DWAB_COMPRESSION:
      return 65536;
    default:
      return 2048;
  }
}

}  // namespace

int check_exr_layout(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (error) reject(path, error.message());
  if (std::filesystem::is_directory(status)) reject(path, "is a directory");
  if (!std::filesystem::is_regular_file(status)) reject(path, "not a regular file");
  const std::uint64_t size = std::filesystem::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (error || !in) reject(path, std::generic_category().message(errno));

  if (read_u32(in) != magic || !in) reject(path, "not an OpenEXR file");
  const std::uint32_t version = read_u32(in);
  if (!in) reject(path, "the file is truncated (in its header)");
  if ((version & 0xff) != 2)
    reject(path, fmt::format("OpenEXR format version {} is not supported", version & 0xff));
  if (version & flag_multi_part) reject(path, "multi-part OpenEXR files are not supported");
  if (version & flag_deep) reject(path, "deep OpenEXR images are not supported");

  std::string name, type;
  while (read_name(in, name)) {
    if (name.empty()) return static_cast<int>(version);
    if (!read_name(in, type)) break;
    const std::uint32_t bytes = read_u32(in);
    const auto position = static_cast<std::uint64_t>(std::max<std::streamoff>(in.tellg(), 0));
    if (!in || position + bytes > size || !value_fits(in, type, bytes)) break;
    in.clear();
    in.seekg(static_cast<std::streamoff>(position + bytes));
  }
  reject(path, "the header is truncated or damaged");
}

void check_exr_size(const std::filesystem::path& path, const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  const std::uint64_t width = static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
  const std::uint64_t height = static_cast<std::uint64_t>(std::int64_t{window.max.y} - window.min.y + 1);
  std::uint64_t pixel_bytes = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1)
      reject(path, fmt::format("channel {} is subsampled, which is not supported", i.name()));
    pixel_bytes += i.channel().type == Imf::HALF ? 2 : 4;
  }
  if (pixel_bytes == 0) reject(path, "the image has no channels");

  std::uint64_t pixels = width * height;
  if (header.hasTileDescription()) {  // a reader holds one row of tiles, however small the image
    const Imf::TileDescription& tile = header.tileDescription();
    pixels = std::max({pixels, std::uint64_t{tile.xSize} * tile.ySize, width * tile.ySize});
  }
  // Small claims are harmless, whatever the file's size.
  const std::uint64_t allowed = std::max<std::uint64_t>(
      64u << 20, std::filesystem::file_size(path) * largest_expansion(header.compression()));
  if (pixels > allowed / pixel_bytes)
    reject(path, fmt::format("the header claims {} x {} pixels, more than the file can hold", width, height));
}

}  // namespace nook
