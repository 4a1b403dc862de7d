// Machines and environments that make PoCL give up, or a run say nothing: the picture all the same, or one
// line.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "bad_input_rows.hpp"
#include "base/error.hpp"
#include "device/pocl_needs.hpp"
#include "support/program.hpp"

namespace nook::test {
namespace {

namespace fs = std::filesystem;

using Environment = std::vector<std::pair<std::string, std::string>>;

class Machine : public testing::Test {
 protected:
  Machine() {
    write_small_scene(folder.path());
    // One program less to compile where no cache is at hand.
    write_bytes(folder / "depth.toml",
                with(small_scene, "type = \"ao\"\nspp = 4\nmax_distance = 1.0\n", "type = \"depth\"\n"));
    fs::create_directory(folder / "temporary");
    setting.folder = folder.path();
    setting.arguments = words("render depth.toml --quiet --no-png -o out.exr");
  }
  /// No folder but `temporary` is named.
  void without_caches(Environment more = {}) {
    setting.environment = {{"XDG_CACHE_HOME", ""},
                           {"NOOK_CACHE_DIR", ""},
                           {"POCL_CACHE_DIR", ""},
                           {"TMPDIR", (folder / "temporary").string()}};
    setting.environment.insert(setting.environment.end(), more.begin(), more.end());
  }
  void expect_picture(const char* where) {
    const ProgramResult result = run_program(NOOK_PROGRAM, setting);
    EXPECT_EQ(result.code, 0) << where << ": " << result.err;
    EXPECT_TRUE(fs::remove(folder / "out.exr")) << where;
  }
  /// The program after `shell`, which may mount what it likes in a world of its own. False: it cannot here.
  bool in_own_mounts(const std::string& shell) {
    ProgramSetting trial;
    trial.arguments = {"-rm", "true"};
    if (run_program("/usr/bin/unshare", trial).code != 0) return false;
    setting.arguments.insert(setting.arguments.begin(),
                             {"-rm", "sh", "-c", shell + " && exec \"$@\"", "sh", NOOK_PROGRAM});
    return true;
  }
  /// What is in the folders that runs make for themselves in `temporary`.
  std::ptrdiff_t left_over() const {
    std::ptrdiff_t count = 0;
    for (const auto& own : fs::directory_iterator(folder / "temporary"))
      count += std::distance(fs::directory_iterator(own), fs::directory_iterator());
    return count;
  }

  TemporaryFolder folder;
  ProgramSetting setting;
};

TEST_F(Machine, HomesThatCannotBeWritten) {
  for (const char* home : {"/dev/null", "/proc", ""}) {
    without_caches({{"HOME", home}});
    expect_picture(home);
  }
  without_caches({{"NOOK_CACHE_DIR", "/dev/null"}});
  expect_picture("a cache that is a device");
  EXPECT_TRUE(fs::exists(folder / ("temporary/nook-" + std::to_string(geteuid()))));
  EXPECT_EQ(left_over(), 0);
}

TEST_F(Machine, ReadOnlyHome) {
  without_caches({{"HOME", (folder / "home").string()}});
  fs::create_directory(folder / "home");
  if (!in_own_mounts("mount -t tmpfs -o ro tmpfs home")) GTEST_SKIP() << "no mounts of one's own";
  const ProgramResult result = run_program("/usr/bin/unshare", setting);
  EXPECT_EQ(result.code, 0) << result.err;
}

// PoCL maps what it compiles.
TEST_F(Machine, HomeThatNoProgramRunsFrom) {
  without_caches({{"HOME", (folder / "home").string()}});
  fs::create_directory(folder / "home");
  if (!in_own_mounts("mount -t tmpfs -o noexec tmpfs home")) GTEST_SKIP() << "no mounts of one's own";
  const ProgramResult result = run_program("/usr/bin/unshare", setting);
  EXPECT_EQ(result.code, 0) << result.err;
}

TEST_F(Machine, NoFolderAtAll) {
  if (std::string(NOOK_PROGRAM).starts_with("/tmp/") || std::string(NOOK_PROGRAM).starts_with("/var/tmp/"))
    GTEST_SKIP() << "the program would be hidden";
  without_caches({{"HOME", "/tmp"}, {"TMPDIR", ""}});
  if (!in_own_mounts("mount -t tmpfs -o ro tmpfs /tmp && mount -t tmpfs -o ro tmpfs /var/tmp"))
    GTEST_SKIP() << "no mounts of one's own";
  const ProgramResult result = run_program("/usr/bin/unshare", setting);
  EXPECT_EQ(result.code, 4) << result.err;
  EXPECT_NE(result.err.find("NOOK_CACHE_DIR names one; /tmp/.cache/nook/pocl: Read-only file system"),
            std::string::npos)
      << result.err;
}

TEST_F(Machine, NoTopologyOfProcessors) {
  if (!in_own_mounts("mount -t tmpfs tmpfs /sys")) GTEST_SKIP() << "no mounts of one's own";
  const ProgramResult result = run_program("/usr/bin/unshare", setting);
  EXPECT_TRUE(result.code == 0 || result.code == 4) << result.err;
  EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

// Clang looks for `ld` there.
TEST_F(Machine, PathWithoutALinker) {
  setting.environment = {{"PATH", "/nonexistent"}, {"NOOK_CACHE_DIR", (folder / "cache").string()}};
  expect_picture("PATH of no folder");
}

TEST_F(Machine, NoMoreProcesses) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit one{1, 1};
    if (geteuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0)) ::_exit(77);
    ::setrlimit(RLIMIT_NPROC, &one);
    try {
      check_what_pocl_needs(2);
    } catch (const Error& e) {
      const bool named = std::string(e.what()).find("ulimit -u") != std::string::npos;
      ::_exit(named && e.kind() == ErrorKind::device ? 0 : 1);
    }
    ::_exit(2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "cannot become another user";
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

// A log on a full disk, a closed terminal, a reader that went away.
TEST_F(Machine, StderrThatCannotBeWritten) {
  setting.arguments = words("render scene.toml --progress plain --no-png -o out.exr");
  for (const char* where : {"/dev/full", "closed"}) {
    setting.standard_error = where;
    expect_picture(where);
  }
  setting.arguments = words("render none.toml");
  for (const char* where : {"/dev/full", "closed"}) {
    setting.standard_error = where;
    EXPECT_EQ(run_program(NOOK_PROGRAM, setting).code, 3) << where;
  }
  setting.arguments = words("render scene.toml --progress plain --no-png -o out.exr --spp 64");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int reader = ::open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  setting.standard_error = (folder / "pipe").string();
  RunningProgram program(NOOK_PROGRAM, setting);
  ::close(reader);
  EXPECT_EQ(program.wait().code, 0);
  EXPECT_TRUE(fs::exists(folder / "out.exr"));
}

// More lines than the buffer of stdout holds.
TEST_F(Machine, StdoutThatFillsUpOnTheWay) {
  std::string points;
  for (int i = 0; i < 2000; ++i) points += "0,0,0,0,0,1\n";
  write_bytes(folder / "points.csv", points);
  for (const char* command : {"probe scene.toml --points points.csv --samples 1", "render --help"}) {
    setting.arguments = words(command);
    setting.standard_output = "/dev/full";
    const ProgramResult result = run_program(NOOK_PROGRAM, setting);
    EXPECT_EQ(result.code, 6) << command;
    EXPECT_EQ(result.err, "nook: stdout: cannot write\n") << command;
  }
}

TEST_F(Machine, IgnoredHangUpsStayIgnored) {
  setting.arguments = {"-c",
                       "trap '' HUP; exec \"$0\" render scene.toml --quiet --no-png --spp 4096 --checkpoint "
                       "c.nook --every 0 -o out.exr",
                       NOOK_PROGRAM};
  RunningProgram program("/bin/sh", setting);
  while (!fs::exists(folder / "c.nook") && !program.ended_within(.005)) continue;
  program.send(SIGHUP);
  EXPECT_EQ(program.wait().code, 0);
  EXPECT_TRUE(fs::exists(folder / "out.exr"));
}

// Threads of the program while it renders.
std::ptrdiff_t threads_of(ProgramSetting setting, const std::string& more) {
  setting.arguments = words("render scene.toml --quiet --no-png --spp 60000000 -o endless.exr" + more);
  RunningProgram program(NOOK_PROGRAM, setting);
  const fs::path tasks = "/proc/" + std::to_string(program.process()) + "/task";
  std::ptrdiff_t most = 0;
  for (int wait = 0; wait < 150 && !program.ended_within(.01); ++wait) {
    std::error_code failed;
    fs::directory_iterator first(tasks, failed);
    if (!failed) most = std::max(most, std::distance(first, fs::directory_iterator()));
  }
  return most;
}

TEST_F(Machine, ThreadsAreAsManyAsAskedOrAllowed) {
  setting.environment = {{"POCL_MAX_PTHREAD_COUNT", ""}, {"POCL_CPU_MAX_CU_COUNT", ""}, {"NOOK_THREADS", ""}};
  const std::ptrdiff_t one = threads_of(setting, " --threads 1"), five = threads_of(setting, " --threads 5");
  ASSERT_GT(one, 0);
  EXPECT_GE(five, one + 4);
  setting.one_processor = true;
  EXPECT_EQ(threads_of(setting, ""), one);
}

}  // namespace
}  // namespace nook::test
