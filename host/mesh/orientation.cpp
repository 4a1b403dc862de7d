#include "mesh/orientation.hpp"

#include <array>
#include <cmath>

namespace nook {
namespace {

// A sum without rounding: of terms that do not overlap, smaller ones first (Shewchuk's expansions).
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = value + terms_[i], part = sum - value;
      const double error = (value - (sum - part)) + (terms_[i] - part);
      value = sum;
      if (error != 0) terms_[kept++] = error;
    }
    if (value != 0) terms_[kept++] = value;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const {
    if (size_ == 0) return 0;
    return terms_[size_ - 1] > 0 ? 1 : -1;
  }

 private:
  std::array<double, 16> terms_{};
  std::size_t size_ = 0;
};

// (a - b) - difference, for difference = a - b as rounded: exact (Knuth's two-sum).
dvec2 rounding(const dvec2& a, const dvec2& b, const dvec2& difference) {
  const dvec2 bb = a - difference, aa = difference + bb;
  return (a - aa) + (bb - b);
}

}  // namespace

int exact_orientation(const dvec2& a, const dvec2& b, const dvec2& c) {
  // (a - c) x (b - c) with what rounding leaves of each difference and product. What is left out of it, and
  // its own rounding, are below 14 (2^-53)^2 of the products' sum.
  const dvec2 u = a - c, v = b - c, du = rounding(a, c, u), dv = rounding(b, c, v);
  const double left = u.x * v.y, right = u.y * v.x, high = left - right;
  const double low = std::fma(u.x, v.y, -left) - std::fma(u.y, v.x, -right);
  const double tails = (u.x * dv.y + v.y * du.x) - (u.y * dv.x + v.x * du.y);
  const double sum_rounding = rounding(dvec2(left), dvec2(right), dvec2(high)).x;
  const double determinant = high + ((sum_rounding + low) + tails);
  if (std::abs(determinant) > 0x1p-101 * (std::abs(left) + std::abs(right))) return determinant > 0 ? 1 : -1;
  // or as the file's own numbers
  Expansion sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.x, c.y);
  sum.add_product(-c.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(a.y, c.x);
  sum.add_product(c.y, b.x);
  return sum.sign();
}

}  // namespace nook
