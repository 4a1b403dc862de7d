#include <filesystem>
#include <sstream>

#include "app/commands.hpp"
#include "app/options/render_options.hpp"
#include "app/progress.hpp"
#include "base/error.hpp"
#include "picture/picture.hpp"
#include "readers.hpp"
#include "scene/scene_writer.hpp"
#include "support/temporary_folder.hpp"

namespace nook::fuzz {
namespace {

// CLI11 takes arguments last first.
std::vector<std::string> arguments_of(const std::string& text) {
  std::istringstream lines(text);
  std::vector<std::string> arguments;
  for (std::string line; std::getline(lines, line);) arguments.insert(arguments.begin(), line);
  return arguments;
}

// The options of a render applied to the scene `file`, whatever scene the command line names.
void apply_options(std::vector<std::string> arguments, const std::filesystem::path& file) {
  CLI::App app;
  RenderOptions options;
  options.add_to(app);
  app.parse(std::move(arguments));
  options.scene.scene = file;
  const Scene scene = options.scene.load();
  to_toml(scene);
  options.check(scene);
  parse_aovs(options.aovs);
  parse_progress(options.progress);
}

}  // namespace

void read_command_line(const std::string& path) {
  const std::vector<std::string> arguments = arguments_of(test::read_bytes(path));
  const std::filesystem::path scene = std::filesystem::path(path).parent_path() / "scene.toml";
  test::write_bytes(scene, "[input]\nobjfile = \"a.obj\"\n[renderer]\ntype = \"ro\"\n");
  Command chosen;  // is never run
  const auto app = make_command_line(chosen);
  try {
    app->parse(std::vector<std::string>(arguments));
  } catch (const CLI::Error&) {
  }
  try {
    apply_options(arguments, scene);
  } catch (const CLI::Success&) {
  } catch (const CLI::ParseError& e) {
    throw Error(ErrorKind::usage, e.what());
  }
}

}  // namespace nook::fuzz
