#include "row_kinds.hpp"

namespace nook::test {

std::vector<BadInput> point_rows() {
  const std::string probe = "probe scene.toml --points points.csv --samples 4";
  return {
      {"no points at standard input", "probe scene.toml --points - --effect ro", 3,
       "standard input: there are no points"},
      {"no such points", "probe scene.toml --points none.csv", 3, "none.csv: no such file"},
      {"points are a folder",
       "probe scene.toml --points folder",
       3,
       "folder: not a regular file",
       {},
       {"folder"}},
      {"points are a FIFO",
       "probe scene.toml --points pipe",
       3,
       "pipe: not a regular file",
       {},
       {},
       {"pipe"}},
      {"point of 5 columns",
       probe,
       3,
       "points.csv:2: 5 columns",
       {{"points.csv", "px,py,pz,nx,ny,nz\n0,0,0,0,1\n"}}},
      {"first row of points with a typo",
       probe,
       3,
       "points.csv:1: 'O' is not a finite number",
       {{"points.csv", "O,0,0,0,0,1\n0,0,0,0,0,1\n"}}},
      {"point NaN",
       probe,
       3,
       "points.csv:1: 'nan' is not a finite number",
       {{"points.csv", "0,nan,0,0,0,1\n"}}},
      {"point beyond float",
       probe,
       3,
       "points.csv:1: '1e39' is not a finite number",
       {{"points.csv", "0,1e39,0,0,0,1\n"}}},
      {"point with a zero normal",
       probe,
       3,
       "points.csv:1: the normal is zero",
       {{"points.csv", "0,0,0,0,0,0\n"}}},
      {"RO point without a view",
       probe + " --effect ro",
       3,
       "points.csv:1: RO needs the view direction",
       {{"points.csv", "0,0,0,0,0,1\n"}}},
  };
}

}  // namespace nook::test
