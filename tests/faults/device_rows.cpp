#include "row_kinds.hpp"

namespace nook::test {

namespace {

// Drawn with OpenGL, which `environment` spoils.
BadInput screen_space(const char* name, const std::string& says,
                      const std::vector<std::pair<std::string, std::string>>& environment) {
  BadInput row{name, render, 4, says, scene("type = \"ao\"", "realtime = true\ntype = \"ssao\"")};
  row.environment = environment;
  return row;
}

// Before OpenCL is loaded, nook looks for what PoCL would end in a signal, or hang, without.
BadInput limited(const char* name, const std::string& says, int resource, rlim_t value) {
  BadInput row{name, render, 4, "PoCL cannot work here: " + says};
  row.limits = {{resource, value}};
  return row;
}

BadInput pocl_files_in(const char* name, const std::string& folder, const std::string& says) {
  BadInput row{name, render, 4, says};
  row.environment = {{"POCL_CACHE_DIR", folder}};
  return row;
}

// Enough triangles that their positions are the first buffer of over 1000 bytes.
std::string fan() {
  std::string text = "v 0 0 0\n";
  for (int i = 0; i < 100; ++i) text += "v 1 " + std::to_string(i) + " 0\n";
  for (int i = 2; i < 100; ++i) text += "f 1 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  return text;
}

}  // namespace

std::vector<BadInput> device_rows() {
  std::string long_name = "/nonexistent";
  for (int i = 0; i < 4; ++i) long_name += '/' + std::string(220, 'x');
  return {
      {"no OpenCL platform",
       render,
       4,
       "no OpenCL device found",
       {},
       {},
       {},
       {},
       {},
       {{"OCL_ICD_VENDORS", "/nonexistent"}}},
      {"no OpenCL loader",
       render,
       4,
       "no OpenCL loader",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", "/nonexistent.so"}}},
      {"device that matches nothing", render + " --device quantum", 4, "no OpenCL device matches 'quantum'"},
      {"device index that is not there", render + " --device 7:7", 4, "no OpenCL device matches '7:7'"},
      {"device out of memory for the mesh",
       render,
       4,
       "tiles would not help: take a smaller mesh or another --device",
       mesh(fan()),
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_ALLOCATION", "1000"}}},
      {"device out of memory for the samples",
       render,
       4,
       "render it in tiles with --crop",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_ALLOCATION", "9000"}}},
      {"device lost",
       render,
       4,
       "CL_OUT_OF_RESOURCES; nothing was written",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_LAUNCH", "2"}}},
      pocl_files_in("PoCL's folder is a device", "/dev/null", "POCL_CACHE_DIR: /dev/null: "),
      pocl_files_in("PoCL's folder cannot be made", "/proc/none/pocl", "POCL_CACHE_DIR: /proc/none/pocl: "),
      pocl_files_in("PoCL's folder has too long a name", long_name, "File name too long"),
      limited("stack of 64 KiB", "its compiler needs a stack of 128 KiB, the limit is 64 (ulimit -s)",
              RLIMIT_STACK, 64 << 10),
      limited("eight open files", "it needs 10 open files, the limit leaves", RLIMIT_NOFILE, 8),
      limited("address space of 512 MiB",
              "it needs 640 MiB of address space, the limit leaves less (ulimit -v)", RLIMIT_AS, 512 << 20),
      screen_space("no OSMesa", "libnook-no-such-library.so",
                   {{"NOOK_OSMESA", "libnook-no-such-library.so"}}),
      screen_space("unknown way to OpenGL", "NOOK_GL is 'glx'", {{"NOOK_GL", "glx"}}),
      screen_space("OpenGL context lost at once", "the OpenGL context was lost while uploading the mesh",
                   {{"NOOK_OSMESA", NOOK_FAILING_OSMESA}, {"NOOK_LOSE_CONTEXT", "0"}}),
      screen_space("OpenGL context lost in a frame", "the OpenGL context was lost while reading pixels",
                   {{"NOOK_OSMESA", NOOK_FAILING_OSMESA}, {"NOOK_LOSE_CONTEXT", "8"}}),
  };
}

}  // namespace nook::test
