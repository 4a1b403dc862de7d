#include "device/program_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/error.hpp"
#include "device/pocl_folder.hpp"

namespace nook {
namespace {

// -cl-fp32-correctly-rounded-divide-sqrt is not asked for: PoCL's are, and other devices may lack the option.
// Never -cl-fast-relaxed-math: isnan(NaN) becomes 0 and the slab test flips.
constexpr const char* standard_options = "-cl-std=CL1.2";

constexpr char magic[8] = {'n', 'o', 'o', 'k', 'c', 'l', '0', '2'};

struct Header {
  char magic[8];
  std::uint64_t bytes;
  std::uint64_t checksum;
};

std::string cache_key(const Device& device, const std::string& source, const std::string& options) {
  const DeviceInfo& d = device.info();
  const std::string all = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", d.platform_name, d.name, d.driver,
                                      d.version, sizeof(void*), options, source);
  const XXH128_hash_t hash = XXH3_128bits(all.data(), all.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::vector<unsigned char> read_entry(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Header header{};
  if (!in.read(reinterpret_cast<char*>(&header), sizeof header)) return {};
  std::error_code ignored;
  if (std::memcmp(header.magic, magic, sizeof magic) != 0 ||
      header.bytes + sizeof header != std::filesystem::file_size(file, ignored))
    return {};
  std::vector<unsigned char> binary(header.bytes);
  if (!in.read(reinterpret_cast<char*>(binary.data()), std::streamsize(header.bytes))) return {};
  if (XXH3_64bits(binary.data(), binary.size()) != header.checksum) return {};
  return binary;
}

void write_entry(const std::filesystem::path& file, const std::vector<unsigned char>& binary) {
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  const std::filesystem::path temporary = file.string() + fmt::format(".{}.tmp", getpid());
  Header header{};
  std::memcpy(header.magic, magic, sizeof magic);
  header.bytes = binary.size();
  header.checksum = XXH3_64bits(binary.data(), binary.size());
  {
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&header), sizeof header);
    out.write(reinterpret_cast<const char*>(binary.data()), std::streamsize(binary.size()));
    if (!out.flush()) failed = std::make_error_code(std::errc::io_error);
  }
  if (!failed) std::filesystem::rename(temporary, file, failed);
  if (failed) std::filesystem::remove(temporary, failed);
}

std::string build_log(const Device& device, cl_program program) {
  std::size_t bytes = 0;
  opencl().clGetProgramBuildInfo(program, device.id(), CL_PROGRAM_BUILD_LOG, 0, nullptr, &bytes);
  std::string log(bytes, '\0');
  opencl().clGetProgramBuildInfo(program, device.id(), CL_PROGRAM_BUILD_LOG, bytes, log.data(), nullptr);
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

ClProgram from_binary(const Device& device, const std::vector<unsigned char>& binary,
                      const std::string& options) {
  if (binary.empty()) return {};
  const std::size_t bytes = binary.size();
  const unsigned char* data = binary.data();
  const cl_device_id id = device.id();
  cl_int status = CL_SUCCESS, code = CL_SUCCESS;
  ClProgram program(
      opencl().clCreateProgramWithBinary(device.context(), 1, &id, &bytes, &data, &status, &code));
  if (code != CL_SUCCESS || status != CL_SUCCESS) return {};
  if (opencl().clBuildProgram(program.get(), 1, &id, options.c_str(), nullptr, nullptr) != CL_SUCCESS)
    return {};
  return program;
}

ClProgram from_source(const Device& device, const std::string& source, const std::string& options) {
  const char* text = source.c_str();
  const std::size_t length = source.size();
  const cl_device_id id = device.id();
  cl_int code = CL_SUCCESS;
  ClProgram program(opencl().clCreateProgramWithSource(device.context(), 1, &text, &length, &code));
  check_opencl(code, "cannot create a program");
  code = opencl().clBuildProgram(program.get(), 1, &id, options.c_str(), nullptr, nullptr);
  if (code != CL_SUCCESS)
    throw Error(ErrorKind::device,
                fmt::format("the kernels do not build on {} with {} ({})\n{}", device.info().name, options,
                            opencl_error_name(code), build_log(device, program.get())));
  return program;
}

std::vector<unsigned char> binary_of(const ClProgram& program) {
  std::size_t bytes = 0;
  if (opencl().clGetProgramInfo(program.get(), CL_PROGRAM_BINARY_SIZES, sizeof bytes, &bytes, nullptr) !=
      CL_SUCCESS)
    return {};
  std::vector<unsigned char> binary(bytes);
  unsigned char* data = binary.data();
  if (!bytes || opencl().clGetProgramInfo(program.get(), CL_PROGRAM_BINARIES, sizeof data, &data, nullptr) !=
                    CL_SUCCESS)
    return {};
  return binary;
}

}  // namespace

BuildOptions& BuildOptions::define(const std::string& name, long value) {
  text_ += fmt::format(" -D{}={}", name, value);
  return *this;
}

void BuiltProgram::store(Groups launched) noexcept {
  if (!program || cache_entry.empty()) return;
  try {
    if (launched == Groups::of_one) reuse_code_of_single_items();
    write_entry(cache_entry, binary_of(program));
    cache_entry.clear();
  } catch (const std::exception&) {
    // The next run compiles again.
  }
}

ClKernel BuiltProgram::kernel(const char* name) const {
  cl_int code = CL_SUCCESS;
  ClKernel made(opencl().clCreateKernel(program.get(), name, &code));
  check_opencl(code, name);
  return made;
}

std::filesystem::path program_cache_dir() {
  auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  if (const auto chosen = variable("NOOK_CACHE_DIR"); !chosen.empty()) return chosen;
  if (const auto cache = variable("XDG_CACHE_HOME"); !cache.empty()) return cache / "nook";
  if (const auto home = variable("HOME"); !home.empty()) return home / ".cache" / "nook";
  return {};
}

BuiltProgram build_program(const Device& device, const std::string& source, const BuildOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const std::string all_options = standard_options + options.text();
  const std::filesystem::path dir = program_cache_dir();
  const std::filesystem::path file =
      dir.empty() ? dir : dir / (cache_key(device, source, all_options) + ".bin");
  BuiltProgram built;
  if (!dir.empty()) built.program = from_binary(device, read_entry(file), all_options);
  built.from_cache = bool(built.program);
  if (!built.from_cache) {
    built.program = from_source(device, source, all_options);
    built.cache_entry = file;
  }
  built.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return built;
}

}  // namespace nook
