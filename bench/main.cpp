// nook_bench: see bench/README.md.
#include <cstdio>
#include <string_view>

#include "base/error.hpp"
#include "bench/ssao/ssao.hpp"
#include "bench/support/child.hpp"
#include "bench/support/record.hpp"
#include "effects.hpp"
#include "end_to_end.hpp"
#include "instances.hpp"
#include "occlusion.hpp"
#include "scaling.hpp"
#include "tree.hpp"

int main(int argc, char** argv) {
  if (argc > 2 && std::string_view(argv[1]) == nook::bench::child_command)
    return nook::bench::run_and_report(argc - 2, argv + 2);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // results as they come, into a file too
  CLI::App app{"Benchmarks of nook against Embree"};
  app.require_subcommand(1);
  nook::bench::add_occlusion(app);
  nook::bench::add_tree(app);
  nook::bench::add_effects(app);
  nook::bench::add_instances(app);
  nook::bench::add_end_to_end(app);
  nook::bench::add_overhead(app);
  nook::bench::add_scaling(app);
  nook::bench::add_ssao(app);
  app.add_subcommand("machine", "Describe the machine")->callback([] {
    std::fputs(nook::bench::machine_description().c_str(), stdout);
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const nook::Error& e) {
    std::fprintf(stderr, "nook_bench: %s\n", e.what());
    return int(e.kind());
  }
}
