#include "image/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>

#include <bit>
#include <cstring>
#include <limits>
#include <random>

#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::read_bytes;
using test::write_bytes;

/// Random bit patterns: NaNs with payloads, infinities, denormals and negative zeros among them.
Image random_image(int width, int height) {
  std::mt19937 random(7);
  Image image{width, height, {}, {{"nook/seed", "7"}, {"nook/device", "two\nlines, \xc3\xa9"}}};
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const char* name : {"AO.variance", "N.X", "R"}) {
    std::vector<float> values(pixels);
    for (float& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    image.channels.push_back({name, values});
  }
  std::vector<std::uint32_t> counts(pixels);
  for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(random());
  image.channels.push_back({"AO.samples", counts});
  return image;
}

template <class Value>
bool same_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

void expect_same(const Image& a, const Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.metadata, b.metadata);
  ASSERT_EQ(a.channels.size(), b.channels.size());
  for (const Channel& channel : a.channels) {
    const Channel* other = b.find(channel.name);
    ASSERT_TRUE(other) << channel.name;
    ASSERT_EQ(channel.values.index(), other->values.index()) << channel.name;
    EXPECT_TRUE(std::visit(
        [&](const auto& values) {
          return same_bytes(values, std::get<std::decay_t<decltype(values)>>(other->values));
        },
        channel.values))
        << channel.name;
  }
}

TEST(Exr, ACropKeepsItsPlace) {
  test::TemporaryFolder folder;
  Image image = random_image(3, 2);
  image.x0 = 5;
  image.y0 = 7;
  image.full_width = 20;
  image.full_height = 10;
  write_exr(folder.path() / "crop.exr", image);
  const Image back = read_exr(folder.path() / "crop.exr");
  expect_same(back, image);
  EXPECT_EQ(back.x0, 5);
  EXPECT_EQ(back.y0, 7);
  EXPECT_EQ(back.full_width, 20);
  EXPECT_EQ(back.full_height, 10);
}

TEST(Exr, RoundTripKeepsEveryBit) {
  test::TemporaryFolder folder;
  for (auto [width, height] : {std::pair{1, 1}, {37, 53}, {300, 17}, {1, 100}}) {
    const Image image = random_image(width, height);
    write_exr(folder / "a.exr", image);
    expect_same(image, read_exr(folder / "a.exr"));
    EXPECT_EQ(folder.entries(), 1);
  }
}

TEST(Exr, SameImageSameBytes) {
  test::TemporaryFolder folder;
  write_exr(folder / "a.exr", random_image(200, 100));
  write_exr(folder / "b.exr", random_image(200, 100));
  EXPECT_EQ(read_bytes(folder / "a.exr"), read_bytes(folder / "b.exr"));
}

TEST(Exr, RowZeroIsTheTop) {
  test::TemporaryFolder folder;
  write_exr(folder / "a.exr", {1, 2, {{"R", std::vector<float>{10, 20}}}, {}});
  // An OpenEXR file stores its lines from the top: an uncompressed copy of a viewer's would show 10 above 20.
  EXPECT_EQ(std::get<std::vector<float>>(read_exr(folder / "a.exr").channels[0].values),
            (std::vector<float>{10, 20}));
}

/// What other programs write: half floats, a data window off the origin, scanlines or tiles.
TEST(Exr, ReadsHalfFloatsExactly) {
  test::TemporaryFolder folder;
  const Imath::Box2i window({-3, 5}, {4, 10});
  std::vector<half> values(8 * 6);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.1f * static_cast<float>(i) - 1;

  for (bool tiled : {false, true}) {
    Imf::Header header(Imath::Box2i({0, 0}, {20, 20}), window);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice::Make(Imf::HALF, values.data(), window));
    const std::string name = (folder / "half.exr").string();
    if (tiled) {
      header.setTileDescription(Imf::TileDescription(4, 4));
      Imf::TiledOutputFile file(name.c_str(), header);
      file.setFrameBuffer(frame);
      file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
      Imf::OutputFile file(name.c_str(), header);
      file.setFrameBuffer(frame);
      file.writePixels(6);
    }
    const Image image = read_exr(name);
    EXPECT_EQ(image.width, 8);
    EXPECT_EQ(image.height, 6);
    const auto& read = std::get<std::vector<float>>(image.find("Y")->values);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(read[i], static_cast<float>(values[i])) << i;
  }
}

TEST(Exr, EveryTruncationIsAnError) {
  test::TemporaryFolder folder;
  write_exr(folder / "whole.exr", random_image(9, 20));
  const std::string bytes = read_bytes(folder / "whole.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 64) {
    write_bytes(folder / "cut.exr", bytes.substr(0, length));
    expect_error(ErrorKind::scene, "cut.exr: ", [&] { read_exr(folder / "cut.exr"); });
  }
}

TEST(Exr, DamagedBytesAreAnErrorOrAnImage) {
  test::TemporaryFolder folder;
  write_exr(folder / "whole.exr", random_image(9, 20));
  const std::string bytes = read_bytes(folder / "whole.exr");
  for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 700); ++at)
    for (int change : {0x01, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      write_bytes(folder / "damaged.exr", damaged);
      try {
        const Image image = read_exr(folder / "damaged.exr");
        EXPECT_GT(image.width, 0);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
}

/// Replaces the data window's far corner, in a file that is otherwise whole.
std::string claim_size(std::string bytes, std::int32_t x, std::int32_t y) {
  const std::string key("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t at = bytes.find(key) + key.size() + 8;
  std::memcpy(&bytes[at], &x, sizeof x);
  std::memcpy(&bytes[at + 4], &y, sizeof y);
  return bytes;
}

TEST(Exr, AHeaderThatClaimsTooMuchIsRefusedBeforeAllocating) {
  test::TemporaryFolder folder;
  write_exr(folder / "small.exr", random_image(9, 20));
  const std::string bytes = read_bytes(folder / "small.exr");
  for (auto [x, y] : {std::pair{1'000'000'000, 1'000'000'000}, {100'000, 100'000}, {1'000'000'000, 0}}) {
    write_bytes(folder / "huge.exr", claim_size(bytes, x, y));
    expect_error(ErrorKind::scene, "more than the file can hold", [&] { read_exr(folder / "huge.exr"); });
  }
  write_bytes(folder / "negative.exr", claim_size(bytes, -5, -5));
  expect_error(ErrorKind::scene, "negative.exr: ", [&] { read_exr(folder / "negative.exr"); });
}

TEST(Exr, NamesWhatItCannotRead) {
  test::TemporaryFolder folder;
  write_bytes(folder / "empty.exr", "");
  write_bytes(folder / "text.exr", "[input]\nobjfile = \"a.obj\"\n");
  const auto fails = [&](const std::string& name, const std::string& reason) {
    expect_error(ErrorKind::scene, (folder / name).string() + ": " + reason,
                 [&] { read_exr(folder / name); });
  };
  fails("missing.exr", "No such file or directory");
  fails("", "is a directory");
  fails("empty.exr", "not an OpenEXR file");
  fails("text.exr", "not an OpenEXR file");
  expect_error(ErrorKind::scene, "/dev/zero: not a regular file", [] { read_exr("/dev/zero"); });
}

TEST(Exr, FullDiskIsOneLineAndLeavesTheOldFile) {
  test::TemporaryFolder folder;
  write_bytes(folder / "a.exr", "old");
  const Image image = random_image(100, 100);
  // The line table is written last, from a destructor: limits around the file's size reach that write as
  // well.
  write_exr(folder / "size.exr", image);
  const auto size = std::filesystem::file_size(folder / "size.exr");
  for (std::uintmax_t bytes : {std::uintmax_t{0}, std::uintmax_t{100}, size / 2, size - 1}) {
    test::FileSizeLimit limit(bytes);
    expect_error(ErrorKind::output, (folder / "a.exr").string() + ": File too large",
                 [&] { write_exr(folder / "a.exr", image); });
  }
  EXPECT_EQ(read_bytes(folder / "a.exr"), "old");
  EXPECT_EQ(folder.entries(), 2);
}

TEST(Exr, RefusesPlanesOfAnotherSize) {
  test::TemporaryFolder folder;
  expect_error(ErrorKind::internal, "3 values for 4 pixels", [&] {
    write_exr(folder / "a.exr", {2, 2, {{"R", std::vector<float>(3)}}, {}});
  });
  EXPECT_EQ(folder.entries(), 0);
}

// Its channel list ends before the size that the file states for it; OpenEXR, which goes on behind the list,
// would see a string of 2 GiB there.
TEST(Exr, ListsEndWhereTheirSizeSays) {
  const std::string file = std::string(NOOK_SOURCE_DIR) + "/tests/fuzz/corpus/image/string-of-2-gib";
  expect_error(ErrorKind::scene, "the header is truncated or damaged", [&] { read_exr(file); });
}

}  // namespace
}  // namespace nook
