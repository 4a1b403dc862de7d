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
      {"device out of memory",
       render,
       4,
       "bytes asked",
       {},
       {},
       {},
       {},
       {},
       {{"NOOK_OPENCL", NOOK_FAILING_OPENCL}, {"NOOK_FAIL_ALLOCATION", "1000"}}},
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
