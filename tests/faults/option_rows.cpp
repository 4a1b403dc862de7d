#include "row_kinds.hpp"

namespace nook::test {

std::vector<BadInput> option_rows() {
  return {
      {"no command", "", 2, "no command was given"},
      {"unknown command", "rendr scene.toml", 2, "rendr"},
      {"no scene named", "render", 2, "scene"},
      {"unknown option", render + " --sp 4", 2, "--sp"},
      {"option without its value", "render scene.toml --spp", 2, "--spp"},
      {"--spp 0", render + " --spp 0", 2, "--spp"},
      {"--spp of a word", render + " --spp many", 2, "--spp"},
      {"--directions over 2^26", render + " --directions 100000000", 2, "--directions"},
      {"--size 0x5", render + " --size 0x5", 2, "--size: '0x5' is not WIDTHxHEIGHT"},
      {"--size of one number", render + " --size 640", 2, "--size"},
      {"--crop of two numbers", render + " --crop 1,2", 2, "--crop"},
      {"--crop empty", render + " --crop 4,4,0,2", 3, "empty or outside"},
      {"--crop left of the film", render + " --crop -1,4,0,2", 3, "empty or outside"},
      {"--error NaN", render + " --error nan", 2, "--error"},
      {"--time NaN", render + " --time nan", 2, "--time"},
      {"--radius of a word", render + " --radius wide", 2, "--radius: 'wide'"},
      {"--sampling unknown", render + " --sampling cosin", 2, "--sampling: unknown value 'cosin'"},
      {"--sampler unknown", render + " --sampler blue", 2, "--sampler: unknown value 'blue'"},
      {"--max-distance -1", render + " --max-distance -1", 2, "--max-distance"},
      {"--exponent NaN", render + " --exponent nan", 2, "--exponent"},
      {"--exponent 1e9", render + " --exponent 1e9", 2, "--exponent"},
      {"--aov unknown", render + " --aov albedo", 2, "--aov: unknown channel 'albedo'"},
      {"--progress unknown", render + " --progress fast", 2, "--progress"},
      {"NOOK_SPP of a word", render, 2, "many", {}, {}, {}, {}, {}, {{"NOOK_SPP", "many"}}},
      {"--resume without a checkpoint", render + " --resume", 2, "--resume: needs --checkpoint"},
      {"--turntable 0", render + " --turntable 0", 2, "--turntable"},
      {"--turntable of a word", render + " --turntable full", 2, "--turntable"},
      {"--turntable with a checkpoint", render + " --turntable 2 --checkpoint a.nook", 2,
       "--turntable: a turn is not kept in parts"},
      {"--turntable with a shard", "render scene.toml --turntable 2 --shard 1/2 -o a.nook", 2,
       "--turntable: a turn is not kept in parts"},
      {"--turntable with a forecast", render + " --turntable 2 --error 0.1 --dry-run", 2,
       "--turntable: --dry-run forecasts one picture"},
      {"--turntable over the scene's mesh",
       "render mesh_0001.obj --turntable 2 -o mesh.obj --no-png",
       6,
       "mesh_0001.obj: is the scene's own file",
       {{"mesh_0001.obj", two_squares}}},
      {"--turntable into a missing folder", "render scene.toml --turntable 2 -o none/a.exr", 6, "none"},
      {"--shard 0/4", render + " --shard 0/4", 2, "'0/4' is not I/N"},
      {"--shard 5/4", render + " --shard 5/4", 2, "'5/4' is not I/N"},
      {"--shard of a word", render + " --shard half", 2, "'half' is not I/N"},
      {"--shard slurm outside Slurm", render + " --shard slurm", 2, "SLURM_ARRAY_TASK_ID is not set"},
  };
}

}  // namespace nook::test
