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

}  // namespace

int exact_orientation(const dvec2& a, const dvec2& b, const dvec2& c) {
  // (a - c) x (b - c) as the file's own numbers, since their differences are rounded
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
