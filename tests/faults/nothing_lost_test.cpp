// Interrupted, killed, split and joined: always the bits of one undisturbed run.
#include <csignal>

#include "nothing_lost.hpp"

namespace nook::test {
namespace {

const std::string all_aovs =
    " --aov normal,position,depth,variance,samples,alpha --size 64x48 --spp 96 --directions 8";

// 96 samples in shards of thirds; a shard of shards; tiles; every order.
TEST_F(NothingLost, ShardsJoinInAnyOrderAndGrouping) {
  succeed("render scene.toml --no-png -o one.exr" + all_aovs);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    succeed(std::string("render scene.toml -o p") + shard[0] + ".nook --shard " + shard + all_aovs);
  succeed("merge p3.nook p1.nook p2.nook -o flat.exr");
  expect_same_picture("one.exr", "flat.exr");
  succeed("merge p3.nook p1.nook -o p13.nook");
  succeed("merge p2.nook p13.nook -o grouped.exr");
  expect_same_picture("one.exr", "grouped.exr");
}

TEST_F(NothingLost, ShardsOfPixelsWhereSamplesAreFew) {
  const std::string options = " --size 64x48 --spp 2 --directions 3 --aov variance,samples";
  succeed("render scene.toml --no-png -o one.exr" + options);
  std::string parts;
  for (int i = 1; i <= 5; ++i) {
    succeed("render scene.toml -o p" + std::to_string(i) + ".nook --shard " + std::to_string(i) + "/5" +
            options);
    parts = " p" + std::to_string(i) + ".nook" + parts;
  }
  succeed("merge" + parts + " -o merged.exr");
  expect_same_picture("one.exr", "merged.exr");
}

// One camera ray a pixel: the samples are its directions.
TEST_F(NothingLost, ShardsOfDirections) {
  const std::string options = " --size 32x24 --spp 1 --directions 10000 --aov variance,samples,alpha";
  succeed("render scene.toml --no-png -o one.exr" + options);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    succeed(std::string("render scene.toml -o p") + shard[0] + ".nook --shard " + shard + options);
  succeed("merge p2.nook p3.nook p1.nook -o merged.exr");
  expect_same_picture("one.exr", "merged.exr");
}

TEST_F(NothingLost, SlurmArrayTasksAreShards) {
  succeed("render scene.toml --no-png -o one.exr --spp 8");
  for (const char* id : {"10", "12", "14"}) {
    ProgramSetting task = setting(std::string("render scene.toml --spp 8 --shard slurm -o t") + id + ".nook");
    task.environment = {{"SLURM_ARRAY_TASK_ID", id},
                        {"SLURM_ARRAY_TASK_COUNT", "3"},
                        {"SLURM_ARRAY_TASK_MIN", "10"},
                        {"SLURM_ARRAY_TASK_STEP", "2"}};
    const ProgramResult result = run_program(NOOK_PROGRAM, task);
    ASSERT_EQ(result.code, 0) << result.err;
  }
  succeed("merge t10.nook t12.nook t14.nook -o merged.exr");
  expect_same_picture("one.exr", "merged.exr");
}

TEST_F(NothingLost, StatusSaysWhatIsMissing) {
  succeed("render scene.toml --shard 1/4 -o a.nook");
  succeed("render scene.toml --shard 3/4 -o b.nook");
  const ProgramResult status = run("merge a.nook b.nook --status");
  EXPECT_EQ(status.code, 5);
  EXPECT_NE(status.out.find("a.nook: 25.00 %: samples 0-0 of 48 pixels"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("missing: 50.00 %: samples 1-1 of 48 pixels, samples 3-3 of 48 pixels"),
            std::string::npos)
      << status.out;
  succeed("merge a.nook b.nook --partial -o partial.exr");
}

TEST_F(NothingLost, SignalsFlushAndResumeGivesTheSameBits) {
  succeed(long_render + " -o one.exr");
  const std::string resumed = long_render + " --checkpoint c.nook --every 0 --resume -o resumed.exr";
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    RunningProgram program(NOOK_PROGRAM, setting(resumed));
    ASSERT_TRUE(writes(program, folder / "c.nook")) << "too quick to be interrupted";
    program.send(signal);
    const ProgramResult result = program.wait();
    ASSERT_EQ(result.code, 130) << result.err;
    EXPECT_NE(result.err.find("interrupted; c.nook holds"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "resumed.exr"));
  }
  succeed(resumed);
  expect_same_picture("one.exr", "resumed.exr");
}

TEST_F(NothingLostToAnError, SignalsFlushAndResumeGivesTheSameBits) {
  const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  for (std::size_t i = 0; const std::string& render : renders_to_an_error) {
    const int signal = signals[i++ % 3];
    succeed(render + with_aovs + " -o one.exr");
    const std::string resumed = render + with_aovs + " --checkpoint c.nook --every 0 --resume -o resumed.exr";
    {
      RunningProgram program(NOOK_PROGRAM, setting(resumed));
      ASSERT_TRUE(writes(program, folder / "c.nook")) << "too quick to be interrupted";
      program.send(signal);
      const ProgramResult result = program.wait();
      ASSERT_EQ(result.code, 130) << render << ": " << result.err;
      EXPECT_NE(result.err.find("interrupted; c.nook holds"), std::string::npos) << result.err;
    }
    succeed(resumed);
    expect_same_picture("one.exr", "resumed.exr");
    // A finished one is not rendered again.
    succeed(resumed);
    expect_same_picture("one.exr", "resumed.exr");
    std::filesystem::remove(folder / "c.nook");
  }
}

// A render that ran out of time goes on from there, to the same bits.
TEST_F(NothingLostToAnError, TimeIsNoEnd) {
  const std::string render = renders_to_an_error[1] + with_aovs;
  succeed(render + " -o one.exr");
  EXPECT_EQ(run(render + " --checkpoint c.nook --time .25 -o short.exr").code, 5);
  EXPECT_TRUE(std::filesystem::exists(folder / "short.exr"));
  succeed(render + " --checkpoint c.nook --resume -o resumed.exr");
  expect_same_picture("one.exr", "resumed.exr");
}

TEST_F(NothingLost, OutputFolderRemovedWhileRunning) {
  std::filesystem::create_directory(folder / "out");
  RunningProgram program(NOOK_PROGRAM, setting(long_render + " --checkpoint c.nook --every 0 -o out/a.exr"));
  ASSERT_TRUE(writes(program, folder / "c.nook")) << "too quick";
  std::filesystem::remove(folder / "out");
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.code, 6) << result.err;
  EXPECT_NE(result.err.find("out/a.exr"), std::string::npos) << result.err;
  // The samples are in the checkpoint.
  std::filesystem::create_directory(folder / "out");
  succeed(long_render + " --checkpoint c.nook --resume -o out/a.exr");
}

TEST_F(NothingLost, NamesWithBlanksUtf8AndLength) {
  const std::string name =
      "Gr\xc3\xb6\xc3\x9f"
      "e \xe2\x88\x9e " +
      std::string(200, 'n');
  std::filesystem::rename(folder / "mesh.obj", folder / (name + ".obj"));
  write_bytes(folder / (name + ".toml"), with(small_scene, "mesh.obj", name + ".obj"));
  ProgramSetting made = setting("render");
  made.arguments = {"render", name + ".toml", "--quiet"};
  const ProgramResult result = run_program(NOOK_PROGRAM, made);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder / (name + ".exr")));
}

}  // namespace
}  // namespace nook::test
