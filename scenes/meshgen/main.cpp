#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "models.hpp"
#include "obj_writer.hpp"

namespace {

using namespace nook::meshgen;

const std::map<std::string, std::function<Model()>> models = {
    {"cbox", cornell_box},
    {"fence", fence},
    {"fir", fir},
    {"hard_contact", [] { return hard_contact(1, dvec3(0)); }},
    {"hard_contact_far", [] { return hard_contact(1, dvec3(4096, 4096, 4096)); }},
    {"hard_contact_large", [] { return hard_contact(1e6, dvec3(0)); }},
    {"hard_contact_small", [] { return hard_contact(1e-6, dvec3(0)); }},
    {"hard_slivers", hard_slivers},
    {"hard_spikes", hard_spikes},
    {"hard_wedge", hard_wedge},
    {"oak", oak},
    {"room", furnished_room},
    {"spaceship", spaceship},
};

int usage() {
  std::fprintf(
      stderr,
      "usage: nook_meshgen FOLDER [MODEL... | --bunny FILE.obj]   writes FOLDER/MODEL.obj and .mtl; models:");
  for (const auto& [name, make] : models) std::fprintf(stderr, " %s", name.c_str());
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) return usage();
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::function<Model()>& make) {
    const Model model = make();
    write_obj(model, folder, name);
    std::printf("%s.obj: %zu triangles\n", (folder / name).string().c_str(), model.triangle_count());
  };
  for (int i = 2; i < argc; ++i) {
    if (std::string(argv[i]) == "--bunny" && i + 1 < argc) {
      const std::filesystem::path file = argv[++i];
      write("bunny", [&] { return bunny_on_plane(file); });
      continue;
    }
    const auto it = models.find(argv[i]);
    if (it == models.end()) return usage();
    write(it->first, it->second);
  }
  if (argc == 2)
    for (const auto& [name, make] : models) write(name, make);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "nook_meshgen: %s\n", e.what());
  return 1;
}
