// The file of a part (docs/checkpoints.md): Start, header (JSON), then the arrays that the header counts,
// then their checksum. For film_part_writer.cpp and film_part_reader.cpp.
#pragma once

#include <xxhash.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <new>

namespace nook::film_part_format {

static_assert(std::endian::native == std::endian::little, "parts are little-endian");

struct Start {
  char magic[8];
  std::uint32_t version;
  std::uint32_t header_bytes;
  std::uint64_t header_checksum;
};
inline constexpr char magic[8] = {'n', 'o', 'o', 'k', 'p', 'a', 'r', 't'};
inline constexpr std::uint32_t format_version = 2;
inline constexpr std::uint32_t largest_header = 1u << 24;
inline constexpr std::uint32_t most_extra_planes = 64;
inline constexpr std::uint64_t bytes_a_pixel = 2 * sizeof(std::uint64_t) + 3 * sizeof(std::uint32_t);

using Hash = std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)>;

inline Hash new_hash() {
  Hash hash(XXH3_createState(), XXH3_freeState);
  if (!hash) throw std::bad_alloc();
  XXH3_64bits_reset(hash.get());
  return hash;
}

// Film pixels [first, first + count) hold all samples there are: a shard of tiles does not store the rest of
// the picture.
struct Extent {
  std::uint64_t first = 0, count = 0;
};

// At least this share of the pixels is stored, so that the memory a file asks for is bounded by its size.
inline std::uint64_t least_stored(std::uint64_t pixels) {
  return (pixels + 255) / 256;
}

}  // namespace nook::film_part_format
