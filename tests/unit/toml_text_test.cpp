#include "scene/toml_text.hpp"

#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace nook {
namespace {

class TomlText : public testing::Test {
 protected:
  void accepts(const std::string& text) {
    test::write_bytes(folder / "a.toml", text);
    EXPECT_EQ(read_toml_text(folder / "a.toml"), text);
  }
  void refuses(const std::string& text, const std::string& place) {
    test::write_bytes(folder / "a.toml", text);
    test::expect_error(ErrorKind::scene, "a.toml:" + place + ": nested deeper than 32",
                       [&] { read_toml_text(folder / "a.toml"); });
  }
  test::TemporaryFolder folder;
};

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST_F(TomlText, PassesWhatScenesHold) {
  accepts("");
  accepts("[camera]\neye = [1.5, -2.5, 3.25]  # [[[[\n");
  accepts("a = " + repeated("[", 32) + repeated("]", 32));
  accepts(repeated("a = [[1]]\n", 100));
  accepts(repeated("a.b.c = 1.5\n", 100));
}

TEST_F(TomlText, RefusesWhatNestsDeeper) {
  refuses("a = " + repeated("[", 33) + repeated("]", 33), "1:37");
  refuses("\na = " + repeated("{b = ", 33) + repeated("}", 33), "2:165");
  refuses("\n\n" + repeated("a.", 40) + "b = 1", "3:64");
  refuses("[" + repeated("a . ", 40) + "b]", "1:128");
}

TEST_F(TomlText, SkipsStringsAndComments) {
  const std::string deep = repeated("[", 40);
  accepts("a = \"" + deep + "\\\"" + deep + "\"");
  accepts("a = '" + deep + "\\'\nb = 1");
  accepts("a = \"\"\"\n" + deep + "\n\"\"\"\n");
  accepts("a = '''" + deep + "\n'" + deep + "'''");
  accepts("# " + deep);
  refuses("a = \"x\" " + deep, "1:41");
  refuses("a = ''\nb = " + deep, "2:37");
  refuses("a = \"not closed\nb = " + deep, "2:37");
}

TEST_F(TomlText, BoundsTheSize) {
  test::write_bytes(folder / "a.toml", std::string(largest_scene_file + 1, '\n'));
  test::expect_error(ErrorKind::scene, "too large", [&] { read_toml_text(folder / "a.toml"); });
}

}  // namespace
}  // namespace nook
