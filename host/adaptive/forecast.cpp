#include "adaptive/forecast.hpp"

#include <algorithm>
#include <cmath>

#include "adaptive/pilot_pixels.hpp"
#include "adaptive/replicated_pilot.hpp"
#include "math/median.hpp"

namespace nook {
namespace {

constexpr std::uint32_t samples_a_pass = 256;  // as a render's stages have for errors that take long
// The rules take more samples than their target needs, by these factors: stages are an eighth apart, and what
// a pilot asks for is on the safe side.
constexpr double counts_surplus = 1.06, planned_surplus = 1.12;

}  // namespace

Forecast forecast(OcclusionTracer& tracer, const Plan& plan, const ErrorTarget& target,
                  std::span<const double> errors, double seconds, const Deadline::Clock& clock) {
  const auto since = [&](double start) { return clock() - start; };
  const double start = clock();
  const std::vector<std::uint32_t> order = pixels_in_order(plan.window, plan.width);
  std::vector<std::uint32_t> pixels =
      pilot_pixels(order.size(), std::max<std::size_t>(8192, order.size() / 32));
  if (plan.sampler != Sampler::independent) {
    Forecast made;
    ReplicatedPilot pilot(tracer, plan, target, std::move(pixels));
    made.samples_per_second = pilot.run([&] { return since(start) < seconds; }, clock);
    for (const double error : errors) {
      const bool counts = AdaptiveRender::plan_for(plan, {.error = error}).sampler == Sampler::independent;
      const double spp = counts ? counts_surplus * pilot.samples_as_counts(error) : pilot.samples_for(error);
      made.rows.push_back({error, spp, spp * double(order.size()) / made.samples_per_second});
    }
    made.pilot_seconds = since(start);
    return made;
  }
  for (std::uint32_t& pixel : pixels) pixel = order[pixel];
  std::vector<Film> films = tracer.make_films();
  // The first launches load code and fill caches: their samples count, their speed does not. The rate is that
  // of pixels that see the mesh, on which a render spends its time.
  std::uint32_t taken = 16;
  tracer.accumulate(pixels, {0, taken}, films);
  std::vector<std::uint32_t> on_mesh;
  for (const std::uint32_t pixel : pixels)
    if (films.front().hits[plan.film_index(pixel)] > 0) on_mesh.push_back(pixel);
  if (on_mesh.empty()) on_mesh = pixels;
  std::vector<double> rates;
  do {
    const double began = clock();
    tracer.accumulate(on_mesh, {taken, samples_a_pass}, films);
    taken += samples_a_pass;
    rates.push_back(double(samples_a_pass) * double(on_mesh.size()) / std::max(clock() - began, 1e-9));
  } while (since(start) < seconds && taken + samples_a_pass < plan.spp && taken < 4096);

  Forecast made;
  made.samples_per_second = upper_median(rates);
  for (const double error : errors) {
    double total = 0;
    for (const std::uint32_t pixel : pixels) {
      const std::size_t i = plan.film_index(pixel);
      double most = 0;
      for (std::size_t e = 0; e < films.size(); ++e) {
        const Film& film = films[e];
        const bool counts = samples_are_counts(plan.effects[e], plan.directions);
        const std::uint32_t first = counts ? target.min_spp : std::max(target.min_spp, 64u);
        double n = first;
        if (film.hits[i] > 0) {
          // The mean square about the unbiased variance, so that few samples do not promise too much.
          const double mean = film.value(i), square = mean * mean + film.variance(i) * film.replicates[i];
          const double needed = samples_needed(mean, square, plan.effects[e].weight_bound, error, target.z());
          n = counts ? std::max<double>(first, counts_surplus * needed) : first + planned_surplus * needed;
        }
        most = std::max(most, std::min(n, double(target.max_spp)));
      }
      total += most;
    }
    const double spp = total / double(pixels.size());
    made.rows.push_back({error, spp, spp * double(order.size()) / made.samples_per_second});
  }
  made.pilot_seconds = since(start);
  return made;
}

}  // namespace nook
