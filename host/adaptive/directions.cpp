#include "adaptive/directions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adaptive/pilot_pixels.hpp"
#include "trace/randomisations.hpp"

namespace nook {
namespace {

constexpr double cost_of_camera_ray = 2;
constexpr std::uint32_t most_directions = 64;
constexpr double least_camera_rays = 24;  // half as many again as an easy pixel takes before it may stop
constexpr std::uint32_t pilot_rays = 8, pilot_directions = 64;
// The squared error of a randomised net falls about like n^-1.25 in four dimensions with edges.
constexpr double rate = 1.25;

// The mean over pixels that see the mesh, and effects, of the variance between camera rays of `directions`
// directions each.
double variance_of_rays(OcclusionTracer& tracer, const std::vector<std::uint32_t>& pixels, const Plan& plan,
                        std::uint32_t directions) {
  tracer.set_directions(directions);
  std::vector<Film> films = tracer.make_films();
  tracer.accumulate(pixels, {0, pilot_rays}, films);
  double sum = 0, seen = 0;
  for (const std::uint32_t pixel : pixels)
    for (const Film& film : films) {
      const std::size_t i = plan.film_index(pixel);
      if (film.hits[i] == 0) continue;
      sum += film.variance(i) * film.replicates[i];
      seen += 1;
    }
  return seen > 0 ? sum / seen : 0;
}

}  // namespace

DirectionChoice cheapest_directions(double between, double within, std::optional<double> error) {
  DirectionChoice made{1, std::max(between, 0.0), std::max(within, 0.0)};
  const auto price = [&](double d) {
    return std::pow(made.between + made.within * std::pow(d, -rate), 1 / rate) * (cost_of_camera_ray + d);
  };
  double most = most_directions;
  if (error) {
    const double samples = std::pow((made.between + made.within) / (*error * *error), 1 / rate);
    most = std::min(most, samples / least_camera_rays);
  }
  for (std::uint32_t d = 2; d <= most; d *= 2)
    if (price(d) < price(made.directions)) made.directions = d;
  return made;
}

std::string why(const DirectionChoice& choice) {
  return fmt::format("{}: the variance between camera rays is {:.2g}, between directions of one {:.2g}",
                     choice.directions, choice.between, choice.within);
}

DirectionChoice choose_directions(OcclusionTracer& tracer, const Plan& plan, std::optional<double> error) {
  const std::vector<std::uint32_t> order = pixels_in_order(plan.window, plan.width);
  std::vector<std::uint32_t> pixels = pilot_pixels(order.size(), 4096);
  for (std::uint32_t& pixel : pixels) pixel = order[pixel];
  // Other random numbers than the render's: what they decide cannot depend on its samples.
  tracer.set_samples(pilot_rays, Randomisations::seed_of(plan.seed, 0xffffffffu));
  const double one = variance_of_rays(tracer, pixels, plan, 1),
               several = variance_of_rays(tracer, pixels, plan, pilot_directions);
  // one = between + within, several = between + within 64^-rate.
  const double within = (one - several) / (1 - std::pow(pilot_directions, -rate));
  DirectionChoice made = cheapest_directions(one - within, within, error);
  while (made.directions > 1 && std::uint64_t(made.directions) * plan.spp > most_samples_per_pixel)
    made.directions /= 2;
  tracer.set_samples(plan.spp, plan.seed);
  tracer.set_directions(made.directions);
  return made;
}

}  // namespace nook
