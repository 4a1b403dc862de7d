// Killed at random moments, or by what kills a process from within: the last checkpoint is whole, and what
// goes on from it ends in the bits of one undisturbed run. NOOK_KILLS=50 kills more often than a short test
// has time for.
#include <csignal>
#include <memory>
#include <random>
#include <thread>

#include "film/film_part_file.hpp"
#include "nothing_lost.hpp"

namespace nook::test {
namespace {

int kills_asked(int otherwise) {
  const char* asked = std::getenv("NOOK_KILLS");
  return asked ? std::atoi(asked) : otherwise;
}

TEST_F(NothingLostToAnError, KillsAtRandomMoments) {
  const int kills = kills_asked(12);
  std::minstd_rand random(11);
  for (const std::string& render : renders_to_an_error) {
    succeed(render + with_aovs + " -o one.exr");
    const std::string resumed = render + with_aovs + " --checkpoint c.nook --every 0 --resume -o resumed.exr";
    for (int killed = 0; killed < kills / 4; ++killed) {
      RunningProgram program(NOOK_PROGRAM, setting(resumed));
      std::this_thread::sleep_for(std::chrono::milliseconds(100 + random() % 700));
      program.send(SIGKILL);
      program.wait();
    }
    succeed(resumed);
    expect_same_picture("one.exr", "resumed.exr");
    std::filesystem::remove(folder / "c.nook");
  }
}

// Parts by two processes that run at once, each killed at random moments and started again while the other
// goes on.
TEST_F(NothingLost, KillsAtRandomMoments) {
  const int kills = kills_asked(10);
  succeed(long_render + " -o one.exr");
  const auto part = [&](int i) {
    return long_render + " --shard " + std::to_string(i + 1) + "/2 -o k" + std::to_string(i + 1) +
           ".nook --every 0 --resume";
  };
  std::minstd_rand random(7);
  std::unique_ptr<RunningProgram> running[2];
  const auto start = [&](int i) {
    running[i] = std::make_unique<RunningProgram>(NOOK_PROGRAM, setting(part(i)));
  };
  for (int i : {0, 1}) start(i);
  for (int killed = 0; killed < kills;) {
    const int i = int(random() % 2);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 500));
    running[i]->send(SIGKILL);
    const int code = running[i]->wait().code;
    if (code == 128 + SIGKILL) {
      ++killed;
    } else {
      // It was done before the signal came: it starts over from nothing, so that kills meet work.
      ASSERT_EQ(code, 0);
      std::filesystem::remove(folder / ("k" + std::to_string(i + 1) + ".nook"));
    }
    start(i);
  }
  for (int i : {0, 1}) EXPECT_EQ(running[i]->wait().code, 0);
  succeed("merge k2.nook k1.nook -o merged.exr");
  expect_same_picture("one.exr", "merged.exr");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path() << " was left by a killed process";
}

TEST_F(NothingLost, LostDeviceKeepsItsCheckpoint) {
  succeed(long_render + " -o one.exr");
  const std::string resumed = long_render + " --checkpoint c.nook --resume -o resumed.exr";
  ProgramSetting failing = setting(resumed);
  failing.environment = {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_LAUNCH", "9"}};
  const ProgramResult result = run_program(NOOK_PROGRAM, failing);
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.err.find("CL_OUT_OF_RESOURCES; c.nook holds"), std::string::npos) << result.err;
  EXPECT_GT(samples_in(read_film_part(folder / "c.nook").held), 0u);
  succeed(resumed);
  expect_same_picture("one.exr", "resumed.exr");
}

// A driver's thread that faults takes the process with it: what was saved stays, nothing half-written
// appears.
TEST_F(NothingLost, FaultInADriversThreadKeepsTheCheckpoint) {
  succeed(long_render + " -o one.exr");
  const std::string resumed = long_render + " --checkpoint c.nook --every 0 --resume -o resumed.exr";
  ProgramSetting faulting = setting(resumed);
  faulting.environment = {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAULT_LAUNCH", "9"}};
  EXPECT_NE(run_program(NOOK_PROGRAM, faulting).code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "resumed.exr"));
  EXPECT_GT(samples_in(read_film_part(folder / "c.nook").held), 0u);
  succeed(resumed);
  expect_same_picture("one.exr", "resumed.exr");
}

}  // namespace
}  // namespace nook::test
