// Includes run one way. The order stands once, in host/CMakeLists.txt; what a room may include are the rooms
// that its CMakeLists.txt links, and what those link.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace nook {
namespace {

namespace fs = std::filesystem;
const fs::path root = NOOK_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator m(text.begin(), text.end(), regex), end; m != end; ++m) found.push_back((*m)[1]);
  return found;
}

// host/'s rooms, lowest first, app last.
std::vector<std::string> rooms() {
  const std::string list =
      matches(text_of(root / "host/CMakeLists.txt"), "set\\(NOOK_LIBRARIES ([a-z ]+)\\)").at(0);
  std::istringstream words(list);
  std::vector<std::string> order{std::istream_iterator<std::string>(words), {}};
  order.push_back("app");
  return order;
}

// The rooms that each may include: those it links, and theirs.
std::map<std::string, std::set<std::string>> allowed_includes() {
  std::map<std::string, std::set<std::string>> allowed = {{"kernels", {}}};
  const std::vector<std::string> order = rooms();
  for (const std::string& room : order) {
    std::set<std::string>& of_room = allowed[room];
    std::vector<std::string> links =
        matches(text_of(root / "host" / room / "CMakeLists.txt"), "nook::([a-z]+)");
    if (room == "app") links = order;  // by a loop over all
    for (const std::string& link : links) {
      if (link == room) continue;
      EXPECT_TRUE(allowed.contains(link))
          << "host/" << room << " links nook::" << link << ", which stands after it";
      of_room.insert(link);
      of_room.insert(allowed[link].begin(), allowed[link].end());
    }
  }
  return allowed;
}

/// One line for each include that a file of `room` must not have.
std::string forbidden_includes(const std::set<std::string>& allowed, const std::string& room,
                               const std::string& file, std::istream& source) {
  static const std::regex include("^\\s*#\\s*include\\s+\"([a-z]+)/.*");
  std::string found, line;
  for (int number = 1; std::getline(source, line); ++number) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    const std::string target = match[1];
    if (target != room && !allowed.contains(target))
      found += file + ":" + std::to_string(number) + ": " + room + " must not include " + target + "/\n";
  }
  return found;
}

// The files of a folder, with its room's name: `room_of` names it.
template <class Visit>
int for_each_source(const fs::path& folder, const std::set<std::string>& extensions, Visit visit) {
  int files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!extensions.contains(entry.path().extension())) continue;
    std::ifstream source(entry.path());
    visit(fs::relative(entry.path(), folder).begin()->string(), fs::relative(entry.path(), root).string(),
          source);
    ++files;
  }
  return files;
}

TEST(Layering, HostRoomsIncludeWhatTheyLink) {
  const auto allowed = allowed_includes();
  const int files = for_each_source(
      root / "host", {".hpp", ".cpp"},
      [&](const std::string& room, const std::string& file, std::istream& source) {
        ASSERT_TRUE(allowed.contains(room)) << "host/" << room << " has no place in host/CMakeLists.txt";
        EXPECT_EQ(forbidden_includes(allowed.at(room), room, file, source), "");
      });
  EXPECT_GT(files, 200);
}

TEST(Layering, KernelRoomsIncludeThoseBelow) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"shared", {}},
      {"trace", {"shared"}},
      {"sample", {"shared", "trace"}},
      {"effect", {"shared", "trace", "sample"}},
      {"stage", {"shared", "trace", "sample", "effect"}}};
  const int files =
      for_each_source(root / "kernels", {".cl", ".h"},
                      [&](const std::string& room, const std::string& file, std::istream& source) {
                        if (!allowed.contains(room)) return;
                        EXPECT_EQ(forbidden_includes(allowed.at(room), room, file, source), "");
                      });
  EXPECT_GT(files, 30);
}

TEST(Layering, FindsWhatIsForbidden) {
  std::istringstream source(
      "#include <vector>\n#include \"mesh/triangle_mesh.hpp\"\n  # include \"device/device.hpp\"\n");
  EXPECT_EQ(forbidden_includes({"mesh"}, "ssao", "a.cpp", source),
            "a.cpp:3: ssao must not include device/\n");
}

TEST(Layering, TheGuideHasTheSameOrder) {
  std::string order;
  for (const std::string& room : rooms()) order += (order.empty() ? "" : ", ") + room;
  EXPECT_NE(text_of(root / "CONTRIBUTING.md").find("\n    " + order + "\n"), std::string::npos) << order;
}

TEST(Layering, ScreenSpaceKnowsNothingOfOpenCl) {
  EXPECT_FALSE(allowed_includes().at("ssao").contains("device"));
}

}  // namespace
}  // namespace nook
