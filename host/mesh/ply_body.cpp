#include "mesh/ply_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "mesh/words.hpp"

namespace nook {

void PlyBody::fail(const std::string& what) const {
  if (is_text()) throw Error(ErrorKind::scene, Place{name_, line_}, what);
  throw Error(ErrorKind::scene, Place{name_}, fmt::format("byte {}: {}", at_ - begin_, what));
}

double PlyBody::word() {
  skip_blanks();
  const char* stop = at_;
  while (stop != end_ && !is_white(*stop)) ++stop;
  if (stop == at_) fail("the file ends too early");
  double number = 0;
  if (!read_number(at_, stop, number))
    fail(fmt::format("'{}' is not a number",
                     std::string_view(at_, std::min<std::size_t>(std::size_t(stop - at_), 40))));
  at_ = stop;
  return number;
}

std::size_t PlyBody::list_size(PlyType count_type) {
  const double count = value(count_type);
  if (!(count >= 0 && count <= double(most_values_left())) || count != double(std::size_t(count)))
    fail(fmt::format("a list of {} values is more than the file holds", count));
  return std::size_t(count);
}

}  // namespace nook
