// nook deliver: what it refuses, and what it packs.
#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

#include "support/nook_program.hpp"

namespace nook::test {
namespace {

std::string config(const std::string& renders) {
  return "{\"firstlast\": \"Ada Lovelace\", \"id\": 123, \"course\": 446, \"assignment\": 3, \"renders\": [" +
         renders + "]}";
}

std::string entry(const std::string& render) {
  return "{\"scene\": \"A picture\", \"render\": \"" + render + "\"}";
}

ProgramResult deliver(const TemporaryFolder& folder, const std::string& json,
                      const std::string& arguments = "") {
  write_small_scene(folder, "small_ao.toml", "[renderer]\ntype = \"ao\"\nspp = 1\n");
  write_small_scene(folder, "small_ro_offline.toml", "[renderer]\ntype = \"ro\"\nspp = 1\nexponent = 10\n");
  write_small_scene(folder, "small_ssao.toml", "[renderer]\nrealtime = true\ntype = \"ssao\"\n");
  write_bytes(folder / "config.json", json);
  return run_nook(folder, "deliver '" + (folder / "config.json").string() + "' " + arguments);
}

TEST(Deliver, PacksTheSet) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "src" / "render");
  write_bytes(folder / "src" / "render" / "ao.h", "// mine\n");
  const ProgramResult run =
      deliver(folder,
              config(entry("offline/small_ao.exr") + "," + entry("offline/small_ro.exr") + "," +
                     entry("realtime/small_ssao.exr")),
              "--student 'Grace Hopper'");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::filesystem::path out = folder / "delivery";
  for (const char* part : {"config.json", "offline/", "small_ao.exr", "small_ro.exr", "src/render/", "ao.h"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  const Imf::InputFile exr((out / "offline" / "small_ao.exr").c_str());
  int channels = 0;
  for (auto c = exr.header().channels().begin(); c != exr.header().channels().end(); ++c, ++channels)
    EXPECT_EQ(c.channel().type, Imf::HALF);
  EXPECT_EQ(channels, 3);

  const std::string zip = read_bytes(out / "123_a3.zip");
  // Each name stands before its file and again in the directory at the end.
  for (const std::string name : {"config.json", "src/render/ao.h", "offline/small_ao.exr",
                                 "offline/small_ro.exr", "realtime/small_ssao.exr"}) {
    std::size_t found = 0;
    for (std::size_t at = zip.find(name); at != std::string::npos; at = zip.find(name, at + 1)) ++found;
    EXPECT_EQ(found, 2u) << name;
  }
  EXPECT_EQ(zip.find("small_ao.png"), std::string::npos);
  EXPECT_EQ(zip.substr(0, 4), std::string("PK\3\4"));
  const std::string sheet = read_bytes(out / "contact_sheet.html");
  EXPECT_NE(sheet.find("Grace Hopper"), std::string::npos);
  EXPECT_NE(sheet.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_NE(read_bytes(out / "config.json").find("\"firstlast\": \"Grace Hopper\""), std::string::npos);
}

// The names in the archive's directory, at its end.
std::vector<std::string> names_in(const std::filesystem::path& zip) {
  const std::string bytes = read_bytes(zip), mark = "PK\1\2";
  std::vector<std::string> names;
  for (std::size_t at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 4)) {
    const auto length = std::size_t(static_cast<unsigned char>(bytes[at + 28])) |
                        std::size_t(static_cast<unsigned char>(bytes[at + 29])) << 8;
    names.push_back(bytes.substr(at + 46, length));
  }
  return names;
}

TEST(Deliver, PacksLinksWithinUnderTheirNames) {
  const TemporaryFolder folder;
  const std::filesystem::path src = folder / "src";
  std::filesystem::create_directories(src / "shared");
  write_bytes(src / "shared" / "a.h", "// a\n");
  std::filesystem::create_symlink("shared/a.h", src / "b.h");
  std::filesystem::create_directory_symlink("shared", src / "twin");
  const ProgramResult run = deliver(folder, config(entry("offline/small_ao.exr")));
  ASSERT_EQ(run.code, 0) << run.err;
  const std::vector<std::string> expected = {"config.json", "src/b.h", "src/shared/a.h", "src/twin/a.h",
                                             "offline/small_ao.exr"};
  EXPECT_EQ(names_in(folder / "delivery/123_a3.zip"), expected);
}

TEST(Deliver, RefusesLinksThatLeadElsewhere) {
  for (const std::string kind : {"file", "folder", "up", "nowhere", "itself", "src"}) {
    const TemporaryFolder folder;
    const std::filesystem::path src = folder / "src", other = folder / "elsewhere";
    std::filesystem::create_directories(other);
    write_bytes(other / "private.txt", "not for others\n");
    std::filesystem::path link = src / "link";
    if (kind != "src") std::filesystem::create_directories(src / "sub");
    if (kind == "file") std::filesystem::create_symlink("../elsewhere/private.txt", link);
    if (kind == "folder") std::filesystem::create_directory_symlink(other, link);
    if (kind == "up") std::filesystem::create_directory_symlink("..", link);
    if (kind == "nowhere") std::filesystem::create_symlink("missing", link);
    if (kind == "itself") std::filesystem::create_directory_symlink(".", link);
    if (kind == "src") {
      link = src;
      std::filesystem::create_directory_symlink(std::filesystem::temp_directory_path(), link);
    }
    const ProgramResult run = deliver(folder, config(entry("offline/small_ao.exr")));
    EXPECT_EQ(run.code, 3) << kind << ": " << run.err;
    EXPECT_NE(run.err.find(link.string() + ": "), std::string::npos) << kind << ": " << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "delivery")) << kind;
  }
}

TEST(Deliver, RefusesABadConfiguration) {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& json, const std::string& message) {
    const ProgramResult run = deliver(folder, json);
    EXPECT_EQ(run.code, 3) << json;
    EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "delivery"));
  };
  refuse("{\n  \"firstlast\": \"A\",,\n}", "config.json:2:20: not JSON");
  refuse("[1]", "must be an object");
  refuse("{}", "firstlast is missing");
  refuse("{\"firstlast\": 3}", "firstlast must be a string");
  refuse("{\"firstlast\": \"A\", \"id\": -4}", "id must be a whole number");
  refuse(config(""), "renders must be a list, and not empty");
  refuse(config("3"), "renders must hold objects in renders[0]");
  refuse(config(entry("small_ao.exr")), "must be offline/NAME.exr or realtime/NAME.exr");
  refuse(config(entry("offline/../../small_ao.exr")), "must be offline/NAME.exr");
  refuse(config(entry("offline/nothing.exr")), "no scene for offline/nothing.exr: tried");
  refuse(config(entry("realtime/small_ao.exr")), "belongs into the other folder");
  refuse(config(entry("offline/small_ao.exr") + "," + entry("offline/small_ao.exr")), "listed twice");
}

}  // namespace
}  // namespace nook::test
