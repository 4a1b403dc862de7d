#include "base/pending_file.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

using test::expect_error;
using test::read_bytes;
using test::write_bytes;
namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  PendingFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

TEST(PendingFile, AppearsWhenCommitted) {
  test::TemporaryFolder folder;
  PendingFile file(folder / "a");
  file.write("hello", 5);
  EXPECT_FALSE(fs::exists(folder / "a"));
  file.seek(0);
  file.write("J", 1);
  file.commit();
  EXPECT_EQ(read_bytes(folder / "a"), "Jello");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, LeavesTheOldFileWhenAbandoned) {
  test::TemporaryFolder folder;
  write_bytes(folder / "a", "old");
  {
    PendingFile file(folder / "a");
    file.write("new", 3);
  }
  EXPECT_EQ(read_bytes(folder / "a"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, FullDiskIsOneLineAndLeavesNothing) {
  test::TemporaryFolder folder;
  const std::string text(100'000, 'x');
  {
    test::FileSizeLimit limit(1000);
    expect_error(ErrorKind::output, (folder / "a").string() + ": File too large",
                 [&] { write(folder / "a", text); });
  }
  EXPECT_EQ(folder.entries(), 0);
}

TEST(PendingFile, ReplacesTheTargetOfALink) {
  test::TemporaryFolder folder;
  write_bytes(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_bytes(folder / "target"), "new");
}

TEST(PendingFile, NamesWhatItCannotWrite) {
  test::TemporaryFolder folder;
  const auto fails = [](const fs::path& path, const std::string& reason) {
    expect_error(ErrorKind::output, path.string() + ": " + reason, [&] { PendingFile file(path); });
  };
  fails(folder / "missing" / "a", "No such file or directory");
  fails(folder.path(), "Is a directory");
  fails("/dev/null", "not a regular file");
  write_bytes(folder / "file", "");
  fails(folder / "file" / "a", "Not a directory");
  fails(folder / std::string(300, 'n'), "File name too long");
}

TEST(PendingFile, TakesTheLongestNames) {
  test::TemporaryFolder folder;
  const std::string name(255, 'n');
  write(folder / name, "x");
  EXPECT_EQ(read_bytes(folder / name), "x");
}

TEST(PendingFile, UsesWhatAKilledProcessLeft) {
  test::TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    PendingFile file(folder / "a");
    file.write("half", 4);
    file.sync();
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(fs::exists(folder / ".a.part"));
  write(folder / "a", "it");
  EXPECT_EQ(read_bytes(folder / "a"), "it");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, LeavesAloneWhatALivingOneWrites) {
  test::TemporaryFolder folder;
  PendingFile first(folder / "a");
  first.write("first", 5);
  write(folder / "a", "second");
  EXPECT_EQ(read_bytes(folder / "a"), "second");
  first.commit();
  EXPECT_EQ(read_bytes(folder / "a"), "first");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(PendingFile, FollowsNoLinkOfItsTemporaryName) {
  test::TemporaryFolder folder;
  write_bytes(folder / "other", "kept");
  fs::create_symlink("other", folder / ".a.part");
  write(folder / "a", "x");
  fs::create_hard_link(folder / "other", folder / ".b.part");
  write(folder / "b", "y");
  EXPECT_EQ(read_bytes(folder / "other"), "kept");
  EXPECT_EQ(read_bytes(folder / "a") + read_bytes(folder / "b"), "xy");
}

}  // namespace
}  // namespace nook
