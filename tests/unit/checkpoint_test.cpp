#include "film/film_part_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

namespace nook::test {
namespace {

// Samples [first, end) of every pixel of a film of 5 x 3, with made-up sums.
FilmPart made_up_part(std::uint32_t first, std::uint32_t end) {
  FilmPart part;
  part.identity = {{"seed", "7"}, {"scene", "abc"}};
  part.metadata = {{"nook/seed", "7"}};
  part.layers = {"", "ro2."};
  part.aovs = {"variance"};
  part.samples_per_pixel = 16;
  part.films = {Film(5, 3, 0x1p32f, 0x1p30f, 4), Film(5, 3, 0x1p31f, 0x1p28f, 4)};
  part.held = {{0, 15, first, end}};
  part.planned = {{0, 15, 0, 16}};
  std::minstd_rand random(first + 1);
  for (Film& film : part.films)
    for (std::size_t i = 0; i < film.pixels(); ++i) {
      film.sum[i] = random() * 0x100000001ull;
      film.sum_square[i] = random() * 0x10001ull;
      film.replicates[i] = film.camera_samples[i] = end - first;
      film.hits[i] = std::uint32_t(random() % (end - first + 1));
    }
  part.counts = {end - first, 10, 1};
  part.render_seconds = 0.25;
  part.surface = {{"Z", std::vector<float>(15, 2.5f)}};
  return part;
}

void expect_same(const FilmPart& a, const FilmPart& b) {
  EXPECT_EQ(a.identity, b.identity);
  EXPECT_EQ(a.metadata, b.metadata);
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_EQ(a.aovs, b.aovs);
  EXPECT_EQ(a.samples_per_pixel, b.samples_per_pixel);
  EXPECT_EQ(a.held, b.held);
  EXPECT_EQ(a.planned, b.planned);
  EXPECT_EQ(a.finished, b.finished);
  EXPECT_EQ(a.counts.camera_rays, b.counts.camera_rays);
  EXPECT_EQ(a.counts.rejected, b.counts.rejected);
  ASSERT_EQ(a.films.size(), b.films.size());
  for (std::size_t e = 0; e < a.films.size(); ++e) {
    EXPECT_EQ(a.films[e].sum_scale, b.films[e].sum_scale);
    EXPECT_EQ(a.films[e].sum, b.films[e].sum);
    EXPECT_EQ(a.films[e].sum_square, b.films[e].sum_square);
    EXPECT_EQ(a.films[e].replicates, b.films[e].replicates);
    EXPECT_EQ(a.films[e].camera_samples, b.films[e].camera_samples);
    EXPECT_EQ(a.films[e].hits, b.films[e].hits);
  }
  ASSERT_EQ(a.surface.size(), b.surface.size());
  for (std::size_t c = 0; c < a.surface.size(); ++c) EXPECT_EQ(a.surface[c].values, b.surface[c].values);
}

TEST(Checkpoint, ComesBackAsItWas) {
  TemporaryFolder folder;
  const FilmPart part = made_up_part(4, 9);
  write_film_part(folder / "a.nook", part);
  expect_same(read_film_part(folder / "a.nook"), part);
  FilmPart empty = made_up_part(0, 1);
  for (Film& film : empty.films) film = Film(5, 3, 0x1p32f, 0x1p30f, 4);
  empty.held.clear();
  write_film_part(folder / "b.nook", empty);
  expect_same(read_film_part(folder / "b.nook"), empty);
}

TEST(Checkpoint, EveryTruncationIsFound) {
  TemporaryFolder folder;
  write_film_part(folder / "a.nook", made_up_part(4, 9));
  const std::string bytes = read_bytes(folder / "a.nook");
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    write_bytes(folder / "b.nook", bytes.substr(0, size));
    expect_error(ErrorKind::scene, "b.nook: ", [&] { read_film_part(folder / "b.nook"); });
  }
  write_bytes(folder / "b.nook", bytes + "x");
  expect_error(ErrorKind::scene, "b.nook: truncated or damaged", [&] { read_film_part(folder / "b.nook"); });
}

TEST(Checkpoint, EveryFlippedBitIsFound) {
  TemporaryFolder folder;
  write_film_part(folder / "a.nook", made_up_part(4, 9));
  const std::string bytes = read_bytes(folder / "a.nook");
  std::minstd_rand random(5);
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string flipped = bytes;
    flipped[at] = char(flipped[at] ^ (1 << random() % 8));
    write_bytes(folder / "b.nook", flipped);
    expect_error(ErrorKind::scene, "b.nook: ", [&] { read_film_part(folder / "b.nook"); });
  }
}

TEST(Checkpoint, FullDiskKeepsTheOlderFile) {
  TemporaryFolder folder;
  const FilmPart older = made_up_part(0, 2);
  write_film_part(folder / "a.nook", older);
  {
    FileSizeLimit limit(500);
    expect_error(ErrorKind::output, "a.nook",
                 [&] { write_film_part(folder / "a.nook", made_up_part(0, 9)); });
  }
  EXPECT_EQ(folder.entries(), 1);
  expect_same(read_film_part(folder / "a.nook"), older);
}

TEST(Checkpoint, PartsJoinInAnyOrderToTheSame) {
  const std::vector<FilmPart> parts = {made_up_part(0, 5), made_up_part(5, 6), made_up_part(6, 16)};
  std::vector<std::size_t> order = {0, 1, 2};
  FilmPart first = parts[0];
  join_film_part(first, "0", parts[1], "1");
  EXPECT_FALSE(first.complete());
  join_film_part(first, "0", parts[2], "2");
  EXPECT_TRUE(first.complete());
  do {
    FilmPart joined = parts[order[0]];
    join_film_part(joined, "a", parts[order[1]], "b");
    join_film_part(joined, "a", parts[order[2]], "c");
    expect_same(joined, first);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Checkpoint, RefusesWhatDoesNotBelongTogether) {
  const FilmPart part = made_up_part(0, 5);
  FilmPart joined = part;
  expect_error(ErrorKind::scene, "b: samples 4 to 4 of 15 pixels are in another part already",
               [&] { join_film_part(joined, "a", made_up_part(4, 9), "b"); });
  FilmPart other = made_up_part(5, 9);
  other.identity[0].second = "8";
  expect_error(ErrorKind::scene, "a and b differ in seed: 7 and 8",
               [&] { join_film_part(joined, "a", other, "b"); });
  other = made_up_part(5, 9);
  other.films.pop_back();
  expect_error(ErrorKind::scene, "a and b are not parts of one picture",
               [&] { join_film_part(joined, "a", other, "b"); });
  other = made_up_part(5, 9);
  std::get<std::vector<float>>(other.surface[0].values)[3] = 1;
  expect_error(ErrorKind::scene, "a and b differ in their channel Z",
               [&] { join_film_part(joined, "a", other, "b"); });
  expect_same(joined, part);
}

}  // namespace
}  // namespace nook::test
