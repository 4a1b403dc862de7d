#include "device/kernel_source.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "base/embedded_file.hpp"
#include "base/error.hpp"

namespace nook::kernels {
extern const EmbeddedFile files[];
extern const unsigned file_count;
}  // namespace nook::kernels

namespace nook {
namespace {

const EmbeddedFile* find_embedded(const std::string& path) {
  for (unsigned i = 0; i < kernels::file_count; ++i)
    if (path == kernels::files[i].path) return &kernels::files[i];
  return nullptr;
}

// The name inside `#include "name"`, or "".
std::string included_name(const std::string& line) {
  const std::size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) return "";
  const std::size_t open = line.find('"', hash);
  const std::size_t close = open == std::string::npos ? open : line.find('"', open + 1);
  return close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

// Every kernel file is include-guarded, so a file that is in already is left out.
void append(const std::string& path, const std::string& text, std::set<std::string>& seen, std::string& out) {
  out += fmt::format("#line 1 \"{}\"\n", path);
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string name = included_name(line);
    if (name.empty()) {
      out += line + "\n";
      continue;
    }
    const EmbeddedFile* file =
        find_embedded((std::filesystem::path(path).parent_path() / name).lexically_normal().string());
    if (!file) file = find_embedded("kernels/" + name);
    if (!file)
      throw Error(ErrorKind::internal,
                  fmt::format("kernel include '{}' not found ({}:{})", name, path, number));
    if (seen.insert(file->path).second) append(file->path, file->text, seen, out);
    out += fmt::format("#line {} \"{}\"\n", number + 1, path);
  }
}

}  // namespace

std::string flatten_kernel(const std::string& name, const std::string& text) {
  std::set<std::string> seen;
  std::string out;
  append(name, text, seen, out);
  return out;
}

std::string kernel_source(const std::string& file) {
  const EmbeddedFile* found = find_embedded("kernels/" + file);
  if (!found) throw Error(ErrorKind::internal, "no embedded kernel file kernels/" + file);
  return flatten_kernel(found->path, found->text);
}

}  // namespace nook
