// nook study SCENE: what accuracy costs in time, measured; JSON, CSV and a page.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/commands/study_job.hpp"

namespace nook {

void add_study_command(CLI::App& app, Command& chosen_command) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = app.add_subcommand(
      "study", "Measure what accuracy costs in time; writes study.json, study.csv and index.html");
  // It has its own samplers, distributions, methods and numbers of samples, and studies whole pictures.
  options->scene.add_to(
      *command, all_kinds,
      {"--spp", "--directions", "--sampling", "--sampler", "--method", "--quality", "--crop"});
  options->device.add_to(*command);
  command->add_option("-o,--output", options->folder,
                      "Folder; default: SCENE_study here. A study that is there goes on");
  command->add_option("--budget", options->budget, "Seconds, about; default 120")
      ->check(CLI::Range(1.0, 1e6));
  command->add_option("--samplers", options->samplers, "Point sequences to compare; default: all")
      ->delimiter(',');
  command->add_option("--samplings", options->samplings, "Distributions to compare; default: all")
      ->delimiter(',');
  command->add_option("--max-spp", options->max_spp, "Largest number of camera rays a pixel; default 1024")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--reference", options->reference,
                      "EXR to measure errors against (R, and AO.variance if there is one)");
  command->add_flag("--gallery,!--no-gallery", options->gallery, "Pictures on the page; on by default");
  CLI::Option* no_plots =
      command->add_flag("--no-plots", options->no_plots, "Tables instead of plots on the page");
  command
      ->add_option(
          "--chart-js", options->chart_js,
          fmt::format("Chart.js 3 for the page's plots; default: {}, if it is there", debian_chart_js))
      ->excludes(no_plots);
  command->add_flag("--quiet", options->quiet, "Say nothing but errors");
  command->callback([options, &chosen_command] {
    chosen_command = [options] {
      StudyJob(*options).run();
      return 0;
    };
  });
}

}  // namespace nook
