// nook_bench: see bench/README.md.
#include <cstdio>

#include "base/error.hpp"
#include "occlusion.hpp"
#include "ssao.hpp"
#include "tree.hpp"

int main(int argc, char** argv) {
  CLI::App app{"Benchmarks of nook against Embree"};
  app.require_subcommand(1);
  nook::bench::add_occlusion(app);
  nook::bench::add_tree(app);
  nook::bench::add_ssao(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "nook_bench: %s\n", e.what());
    return int(e.code());
  }
}
