#include "base/driver_threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>

#include "base/threads.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

class ThreadVariables : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const DriverThreads& driver : driver_threads()) before_[driver.variable] = value(driver.variable);
    clear();
  }
  void TearDown() override {
    clear();
    for (const auto& [variable, text] : before_)
      if (text) setenv(variable.c_str(), text->c_str(), 1);
    limit_own_threads(0);
  }
  static std::optional<std::string> value(const char* variable) {
    const char* text = std::getenv(variable);
    return text ? std::optional<std::string>(text) : std::nullopt;
  }
  static void clear() {
    for (const DriverThreads& driver : driver_threads()) unsetenv(driver.variable);
  }

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(ThreadVariables, AreAllSetToWhatIsAsked) {
  setenv("LP_NUM_THREADS", "9", 1);
  limit_driver_threads(3);
  for (const char* variable : {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT",
                               "CL_CONFIG_CPU_TBB_NUM_WORKERS", "LP_NUM_THREADS", "OCLGRIND_NUM_THREADS"})
    EXPECT_EQ(value(variable), "3") << variable;
}

TEST_F(ThreadVariables, OfUsersStayWhereNothingIsAsked) {
  setenv("LP_NUM_THREADS", "9", 1);
  limit_own_threads(5);
  limit_driver_threads(0);
  for (const DriverThreads& driver : driver_threads())
    EXPECT_EQ(value(driver.variable), driver.variable == std::string("LP_NUM_THREADS") ? "9" : "5");
  clear();
  limit_own_threads(0);
  limit_driver_threads(0);
  for (const DriverThreads& driver : driver_threads())
    EXPECT_EQ(value(driver.variable), std::to_string(processors_allowed()));
}

TEST_F(ThreadVariables, AreThoseOfTheDocs) {
  const std::string docs = test::read_bytes(std::string(NOOK_SOURCE_DIR) + "/docs/portability.md");
  std::size_t rows = 0;
  for (const DriverThreads& driver : driver_threads()) {
    const std::string row = std::string("| `") + driver.variable + "` | " + driver.implementation + " |\n";
    EXPECT_NE(docs.find(row), std::string::npos) << row;
    ++rows;
  }
  const std::size_t table = docs.find("| variable | implementation |");
  ASSERT_NE(table, std::string::npos);
  const std::string rest = docs.substr(table, docs.find("\n\n", table) - table);
  EXPECT_EQ(std::size_t(std::count(rest.begin(), rest.end(), '\n')), rows + 1);
}

}  // namespace
}  // namespace nook
