#pragma once

#include <vector>

#include "part.hpp"

namespace nook::meshgen {

/// The fuselage's cross section at one place: a superellipse |z/width|^power + |y/height|^power = 1 about
/// `y`, with separate heights above and below.
struct HullSection {
  double x, y, width, top, bottom, power;
};

/// A loft through cross sections, nose to tail (x falls), with panels cut into it.
class Hull {
 public:
  explicit Hull(std::vector<HullSection> sections) : sections_(std::move(sections)) {}

  /// s: 0 at the nose, 1 at the tail. a: turn from the keel (0) over starboard (1/4) to the spine (1/2).
  dvec3 point(double s, double a) const;
  dvec3 normal(double s, double a) const;
  /// Frame on the skin: y along the normal, x towards the nose.
  dmat4 mount(double s, double a, double height = 0) const;

  struct Panels {
    std::vector<double> stations;   ///< s of the seams across
    std::vector<double> stringers;  ///< a of the seams along, within (0, 1/2); mirrored to port
    double merged_before = 0.0;     ///< every second stringer starts at this s
    double used = 0.6;              ///< probability that a strip between stringers has the seam at a station
    double width = 0.008, depth = 0.013, step = 0.006;  ///< world units
  };
  /// The skin with grooves between panels, each panel a little higher or lower than the next.
  Part skin(const Panels& panels) const;

 private:
  HullSection section(double s) const;
  std::vector<HullSection> sections_;
};

}  // namespace nook::meshgen
