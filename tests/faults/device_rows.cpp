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

// Enough triangles that their positions are the first buffer of over 1000 bytes.
std::string fan() {
  std::string text = "v 0 0 0\n";
  for (int i = 0; i < 100; ++i) text += "v 1 " + std::to_string(i) + " 0\n";
  for (int i = 2; i < 100; ++i) text += "f 1 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  return text;
}

}  // namespace

std::vector<BadInput> device_rows() {
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
