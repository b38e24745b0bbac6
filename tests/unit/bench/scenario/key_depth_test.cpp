#include "bench/scenario/key_depth.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/scenario/section.hpp"

namespace canhil::scenario {
namespace {

std::string key_of(int parts, const std::string& part = "a") {
  std::string key = part;
  for (int i = 1; i < parts; ++i) key += "." + part;
  return key;
}

TEST(KeyDepth, UpToItsLimitIsRead) {
  EXPECT_FALSE(line_of_deep_key(key_of(most_key_parts) + " = 1\n"));
  EXPECT_FALSE(line_of_deep_key(
      "x = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5]"));
}

TEST(KeyDepth, BeyondItTheLineIsReported) {
  EXPECT_EQ(line_of_deep_key("x = 1\n\n" + key_of(most_key_parts + 1) + " = 1\n"), 3U);
  EXPECT_EQ(line_of_deep_key("x = 1\n[" + key_of(most_key_parts + 1, "\"a b\"") + "]\n"), 2U);
  EXPECT_EQ(line_of_deep_key("x = {" + key_of(most_key_parts + 1, "a ") + "= 1}"), 1U);
}

TEST(KeyDepth, DotsInTextsAndCommentsAreNoKey) {
  const std::string dots(100, '.');
  EXPECT_FALSE(line_of_deep_key("x = \"" + dots + "\"\ny = '" + dots + "' # " + dots));
  EXPECT_FALSE(line_of_deep_key("x = \"\"\"\n" + dots + "\n\\\"\"\"" + dots + "\"\"\"\n"));
  EXPECT_EQ(line_of_deep_key("x = '''\n'\n'''\n" + key_of(20)), 4U);
}

TEST(KeyDepth, AKeyOfFortyThousandPartsIsAnErrorOfTheFile) {
  const Section section = Section::parse("x = 1\n" + key_of(40'000) + " = 1\n", "s.toml");
  ASSERT_TRUE(section.error());
  EXPECT_EQ(section.error()->message, "s.toml:2: a key has more than 16 parts, expected at most that");
}

TEST(KeyDepth, ASettingOfThatManyPartsIsOneToo) {
  const std::vector<Setting> settings{{.key = key_of(40'000), .value = "1", .elements = {}, .line = 1}};
  const Section section = Section::parse("x = 1\n", "s.toml", settings);
  ASSERT_TRUE(section.error());
  EXPECT_EQ(section.error()->message, "s.toml: a key has more than 16 parts, expected at most that");
}

}  // namespace
}  // namespace canhil::scenario
