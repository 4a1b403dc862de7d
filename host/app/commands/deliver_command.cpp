// nook deliver config.json: an assignment's delivery set: rendered, laid out, packed, and shown on one page.
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>

#include "app/commands.hpp"
#include "app/commands/delivery.hpp"
#include "app/exit_code.hpp"
#include "base/error.hpp"
#include "base/pending_file.hpp"
#include "base/to_stderr.hpp"
#include "image/exr.hpp"

extern char** environ;

namespace nook {
namespace {

namespace fs = std::filesystem;

struct DeliverOptions {
  fs::path config, output, scenes, source;
  std::string student;
};

// Runs this program with the arguments: each picture is made as `nook render` makes it, in a process of its
// own.
int run_self(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  std::string self = "nook";
  argv.push_back(self.data());
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, argv.data(), environ) != 0)
    throw Error(ErrorKind::internal, "cannot start /proc/self/exe");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : int(ExitCode::interrupted);
}

// Renders an entry into `folder` and keeps R, G, B alone, in half precision, as the course's files are.
void render_entry(const DeliveryEntry& entry, const fs::path& folder) {
  const fs::path target = folder / entry.render;
  if (const int code = run_self({"render", entry.scene.string(), "-o", target.string(), "--png"}); code != 0)
    throw Error(error_kind(code), fmt::format("{}: rendering it for {} failed (exit code {})",
                                              entry.scene.string(), entry.render, code));
  Image image = read_exr(target);
  std::erase_if(image.channels,
                [](const Channel& c) { return c.name != "R" && c.name != "G" && c.name != "B"; });
  write_exr(target, image, ExrPrecision::half);
}

std::string base64(const std::string& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

// One page that needs no other file.
std::string contact_sheet(const Delivery& delivery, const fs::path& folder) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">\n"
      "<title>Assignment {0}, {1}</title>\n"
      "<style>body{{font:16px/1.5 sans-serif;margin:2rem auto;max-width:80rem;padding:0 1rem}}"
      "main{{display:grid;gap:1.5rem;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr))}}"
      "figure{{margin:0}}img{{width:100%;height:auto;background:#000}}figcaption code{{color:#555}}</style>\n"
      "<h1>Assignment {0}, course {2}</h1><p>{1}, {3}</p>\n<main>\n",
      delivery.assignment, escaped(delivery.student), delivery.course, delivery.id);
  for (const DeliveryEntry& entry : delivery.entries) {
    const fs::path preview = (folder / entry.render).replace_extension(".png");
    html += fmt::format(
        "<figure><img alt=\"{0}\" "
        "src=\"data:image/png;base64,{1}\"><figcaption>{0}<br><code>{2}</code></figcaption></figure>\n",
        escaped(entry.title), base64(packed_bytes(preview)), escaped(entry.render));
  }
  return html + "</main></html>\n";
}

void write_text(const fs::path& path, const std::string& text) {
  PendingFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

void print_tree(const fs::path& archive, std::vector<ArchiveEntry> entries) {
  fmt::print("{}\n", archive.string());
  std::sort(entries.begin(), entries.end(),
            [](const ArchiveEntry& a, const ArchiveEntry& b) { return a.name < b.name; });
  std::string folder;
  for (const ArchiveEntry& entry : entries) {
    const std::size_t slash = entry.name.rfind('/');
    const std::string of_entry = slash == std::string::npos ? "" : entry.name.substr(0, slash + 1);
    if (of_entry != folder && !of_entry.empty()) fmt::print("  {}\n", of_entry);
    folder = of_entry;
    if (of_entry != entry.name)
      fmt::print("  {}{:<40} {:>10} bytes\n", of_entry.empty() ? "" : "  ",
                 entry.name.substr(of_entry.size()), entry.bytes.size());
  }
}

int deliver(const DeliverOptions& options) {
  const fs::path home = options.config.has_parent_path() ? options.config.parent_path() : fs::path(".");
  const std::vector<fs::path> folders = options.scenes.empty() ? std::vector<fs::path>{home, home / "scenes"}
                                                               : std::vector<fs::path>{options.scenes};
  const Delivery delivery = read_delivery(options.config, options.student, folders);
  const fs::path source = options.source.empty() ? home / "src" : options.source;
  std::error_code code;
  if (!fs::is_directory(source, code)) {
    if (!options.source.empty())
      throw Error(ErrorKind::usage, fmt::format("--src: {} is not a folder", source.string()));
    to_stderr("warning: there is no folder {}: the archive's src is empty\n", source.string());
  }
  std::vector<ArchiveEntry> archive = {{"config.json", delivery.config}};
  if (fs::is_directory(source, code)) {
    if (options.source.empty()) require_within(source, home);
    add_folder(source, "src/", archive);
  } else {
    archive.push_back({"src/", ""});
  }
  const fs::path folder = options.output.empty() ? home / "delivery" : options.output;
  for (const char* part : {"offline", "realtime"}) {
    fs::create_directories(folder / part, code);
    if (code)
      throw Error(ErrorKind::output,
                  fmt::format("cannot make the folder {}: {}", (folder / part).string(), code.message()));
  }

  for (const DeliveryEntry& entry : delivery.entries) render_entry(entry, folder);

  for (const DeliveryEntry& entry : delivery.entries)
    archive.push_back({entry.render, packed_bytes(folder / entry.render)});
  const fs::path zip = folder / fmt::format("{}_a{}.zip", delivery.id, delivery.assignment);
  write_text(folder / "config.json", delivery.config);
  write_text(folder / "contact_sheet.html", contact_sheet(delivery, folder));
  write_zip(zip, archive);
  print_tree(zip, archive);
  return 0;
}

}  // namespace

void add_deliver_command(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<DeliverOptions>();
  CLI::App* command = app.add_subcommand("deliver", "Render, lay out and pack an assignment's delivery set");
  command->add_option("config", options->config, "config.json: firstlast, id, course, assignment, renders")
      ->required();
  command->add_option("--student", options->student, "Name to put in place of the configuration's");
  command->add_option(
      "-o,--output", options->output,
      "Folder for the pictures, the archive and the contact sheet; default: delivery, beside config.json");
  command->add_option("--scenes", options->scenes,
                      "Folder of the scenes; default: beside config.json, or its folder scenes");
  command->add_option("--src", options->source, "Folder to pack as src; default: src beside config.json");
  command->footer(
      "The pictures are rendered as `nook render` does; its environment variables (NOOK_SPP, NOOK_DEVICE, "
      "...) hold here too.");
  command->callback([options, &chosen] { chosen = [options] { return deliver(*options); }; });
}

}  // namespace nook
