#include "obj_writer.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace nook::meshgen {
namespace {

/// Appends x rounded to six decimals, without trailing zeros: printf is what the time would go into.
void put(std::string& out, double x) {
  const long long scaled = std::llround(x * 1e6);
  if (scaled < 0) out += '-';
  const unsigned long long magnitude = scaled < 0 ? 0ull - static_cast<unsigned long long>(scaled) : scaled;
  char digits[24];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, magnitude / 1000000).ptr);
  unsigned fraction = unsigned(magnitude % 1000000);
  if (fraction == 0) return;
  int width = 6;
  for (; fraction % 10 == 0; fraction /= 10) --width;
  char tail[7] = {'.', '0', '0', '0', '0', '0', '0'};
  for (int i = width; i > 0; --i, fraction /= 10) tail[i] = char('0' + fraction % 10);
  out.append(tail, std::size_t(width) + 1);
}

void put(std::string& out, const char* keyword, const dvec3& p, bool exact = false) {
  out += keyword;
  for (int i = 0; i < 3; ++i) {
    out += ' ';
    char digits[32];
    if (exact)
      out.append(digits, std::to_chars(digits, digits + sizeof digits, float(p[i])).ptr);
    else
      put(out, p[i]);
  }
  out += '\n';
}

void put_index(std::string& out, std::uint32_t index) {
  char digits[12];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, index).ptr);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path temporary = path.string() + ".part";
  std::ofstream file(temporary, std::ios::binary);
  file.write(text.data(), std::streamsize(text.size()));
  file.close();
  if (!file) {
    std::filesystem::remove(temporary);
    throw std::runtime_error("cannot write " + path.string());
  }
  std::filesystem::rename(temporary, path);
}

std::string obj_text(const Model& model, const std::string& name) {
  std::string out = "# " + name + ": " + std::to_string(model.triangle_count()) +
                    " triangles, written by nook_meshgen\nmtllib " + name + ".mtl\n";
  std::uint32_t first_position = 1, first_normal = 1;
  for (const Model::Group& g : model.groups()) {
    out += "g " + g.name + "\nusemtl " + g.material + "\n";
    for (const dvec3& p : g.part.positions) put(out, "v", p, model.exact);
    for (const dvec3& n : g.part.normals) put(out, "vn", n);
    for (std::size_t t = 0; t < g.part.triangles.size(); ++t) {
      out += 'f';
      for (int i = 0; i < 3; ++i) {
        out += ' ';
        put_index(out, g.part.triangles[t][i] + first_position);
        out += "//";
        put_index(out, g.part.triangle_normals[t][i] + first_normal);
      }
      out += '\n';
    }
    first_position += std::uint32_t(g.part.positions.size());
    first_normal += std::uint32_t(g.part.normals.size());
  }
  return out;
}

std::string mtl_text(const Model& model) {
  std::string out;
  for (const auto& [name, exponent] : model.exponents()) {
    out += "newmtl " + name + "\nKd 1 1 1\n";
    if (exponent >= 0) {
      out += "Ns ";
      put(out, exponent);
      out += '\n';
    }
  }
  return out;
}

}  // namespace

void write_obj(const Model& model, const std::filesystem::path& folder, const std::string& name) {
  write_file(folder / (name + ".mtl"), mtl_text(model));
  write_file(folder / (name + ".obj"), obj_text(model, name));
}

}  // namespace nook::meshgen
