// Bad input, row by row, as in the table of docs/hard-cases.md: each gives one clear line and its exit code,
// leaves no file behind and no hang.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <set>

#include "bad_input_rows.hpp"
#include "support/program.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {
namespace {

std::set<std::string> files_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.insert(entry.path().string());
  return names;
}

void make_inputs(const BadInput& row, const std::filesystem::path& folder) {
  write_small_scene(folder);
  for (const auto& [name, text] : row.files) write_bytes(folder / name, text);
  for (const std::string& name : row.folders) std::filesystem::create_directory(folder / name);
  for (const std::string& name : row.fifos) ::mkfifo((folder / name).c_str(), 0600);
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, OneLineAndItsExitCode) {
  const BadInput& row = GetParam();
  TemporaryFolder folder;
  make_inputs(row, folder.path());
  ProgramSetting setting;
  setting.folder = folder.path();
  setting.environment = row.environment;
  setting.limits = row.limits;
  setting.standard_output = row.standard_output;
  setting.timeout = 30;
  for (const std::string& command : row.before) {
    setting.arguments = words(command);
    ProgramSetting clean = setting;
    std::erase_if(clean.environment, [](const auto& entry) { return entry.first != "POCL_CACHE_DIR"; });
    clean.limits.clear();
    const ProgramResult made = run_program(NOOK_PROGRAM, clean);
    ASSERT_EQ(made.code, 0) << command << ": " << made.err;
  }
  if (row.spoil) row.spoil(folder.path());
  const std::set<std::string> before = files_in(folder.path());

  setting.arguments = words(row.command);
  const ProgramResult result = run_program(NOOK_PROGRAM, setting);
  EXPECT_EQ(result.code, row.code) << result.err;
  EXPECT_NE(result.err.find(row.says), std::string::npos)
      << "'" << row.says << "' is missing in: " << result.err;
  EXPECT_TRUE(result.err.starts_with("nook: ")) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_LT(result.err.size(), 1200u) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(files_in(folder.path()), before) << "a file was left behind";
}

std::string test_name(const testing::TestParamInfo<BadInput>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rows, BadInputTest, testing::ValuesIn(bad_input_rows()), test_name);

TEST(BadInputTable, EveryRowIsInTheDocs) {
  const std::string docs = read_bytes(std::string(NOOK_SOURCE_DIR) + "/docs/hard-cases.md");
  for (const BadInput& row : bad_input_rows())
    EXPECT_NE(docs.find("| " + std::string(row.name) + " |"), std::string::npos)
        << row.name << " is not in docs/hard-cases.md";
}

}  // namespace
}  // namespace nook::test
