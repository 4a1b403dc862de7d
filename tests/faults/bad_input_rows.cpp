#include "bad_input_rows.hpp"

#include <iterator>
#include <sstream>

#include "row_kinds.hpp"

namespace nook::test {

std::vector<std::string> words(const std::string& command) {
  std::istringstream in(command);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<BadInput> bad_input_rows() {
  std::vector<BadInput> all;
  for (const auto& rows : {scene_rows(), mesh_rows(), effect_rows(), option_rows(), output_rows(),
                           device_rows(), point_rows(), bake_rows(), part_rows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

}  // namespace nook::test
