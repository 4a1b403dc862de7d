// Includes run one way: each folder of host/ may include its own files and those of the folders listed for
// it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace nook {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> allowed = {
    {"base", {}},
    {"math", {"base"}},
    {"scene", {"base", "math"}},
    {"mesh", {"base", "math", "kernels"}},
    {"bvh", {"base", "math", "mesh", "kernels"}},
    {"device", {"base", "math", "scene", "mesh", "bvh", "kernels"}},
    {"image", {"base", "math"}},
    {"film", {"base", "math", "image"}},
    {"render", {"base", "math", "scene", "mesh", "bvh", "device", "image", "film", "kernels"}},
    {"ssao", {"base", "math", "scene", "mesh"}},  // never device: OpenGL knows nothing of OpenCL
    {"report", {"base", "math", "scene", "mesh", "bvh", "device", "image", "film", "render", "ssao", "kernels"}},
    {"app",
     {"base", "math", "scene", "mesh", "bvh", "device", "image", "film", "render", "ssao", "report", "kernels"}},
};

/// One line for each include that a file of `folder` must not have.
std::string forbidden_includes(const std::string& folder, const std::string& file, std::istream& source) {
  static const std::regex include("^\\s*#\\s*include\\s+\"([a-z]+)/.*");
  std::string found, line;
  for (int number = 1; std::getline(source, line); ++number) {
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    const std::string target = match[1];
    if (target != folder && !allowed.at(folder).contains(target))
      found += file + ":" + std::to_string(number) + ": " + folder + " must not include " + target + "/\n";
  }
  return found;
}

TEST(IncludeDirection, HostFoldersIncludeWhatStandsBeforeThem) {
  const fs::path host = fs::path(NOOK_SOURCE_DIR) / "host";
  int files = 0;
  for (const fs::directory_entry& folder : fs::directory_iterator(host)) {
    if (!folder.is_directory()) continue;
    const std::string name = folder.path().filename();
    ASSERT_TRUE(allowed.contains(name)) << "host/" << name << " has no place in the order yet";
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      std::ifstream source(entry.path());
      EXPECT_EQ(forbidden_includes(name, fs::relative(entry.path(), NOOK_SOURCE_DIR), source), "");
      ++files;
    }
  }
  EXPECT_GT(files, 20);
}

TEST(IncludeDirection, FindsWhatIsForbidden) {
  std::istringstream source(
      "#include <vector>\n#include \"mesh/triangle_mesh.hpp\"\n  # include \"device/device.hpp\"\n");
  EXPECT_EQ(forbidden_includes("ssao", "a.cpp", source), "a.cpp:3: ssao must not include device/\n");
}

}  // namespace
}  // namespace nook
