// Values that a user sets in place of those of a scenario file.
#include <gmock/gmock.h>

#include "bench/checks/kinds/heartbeat.hpp"
#include "bench/scenario/setting.hpp"
#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

using testing::HasSubstr;

std::string key_and_value(std::string_view text) {
  const auto settings = parse_setting(text);
  if (!settings) return settings.error().message;
  std::string all;
  for (const Setting& one : *settings) all += one.key + " = " + one.value + ";";
  return all;
}

TEST(Settings, AreValuesOfTomlElseStrings) {
  EXPECT_EQ(key_and_value("slave_imu.period_ms=5"), "slave_imu.period_ms = 5;");
  EXPECT_EQ(key_and_value("a=2.50"), "a = 2.5;");
  EXPECT_EQ(key_and_value("target.algorithm=robust_h2"), "target.algorithm = 'robust_h2';");
  EXPECT_EQ(key_and_value("target.algorithm=\"ekf\""), "target.algorithm = 'ekf';");
  EXPECT_EQ(key_and_value("a=true"), "a = true;");
  EXPECT_EQ(key_and_value("a=x = 1"), "a = 'x = 1';") << "the value is all after the first '='";
  EXPECT_EQ(parse_setting("a=1\nb = 2")->size(), 1U) << "not two keys";
  EXPECT_EQ(key_and_value("wind={ north_mps = 1, east_mps = -2 }"), "wind.east_mps = -2;wind.north_mps = 1;");
  EXPECT_EQ(parse_setting("a=[1, 2]")->front().elements, (std::vector<std::string>{"1", "2"}));
}

TEST(Settings, NeedAKey) {
  for (const std::string_view wrong : {"", "a", "=1", ".a=1", "a.=1", "a..b=1"})
    EXPECT_THAT(key_and_value(wrong), HasSubstr("expected KEY=VALUE")) << wrong;
}

Result<Scenario> with_setting(std::string_view text, const std::string& scenario) {
  return parse(scenario, "s.toml", contract, parse_setting(text).value());
}

TEST(Settings, AddTablesWhereTheKeyEndsWithAPlus) {
  const std::string one = "[{ name = 'second', kind = 'heartbeat', silent_at_most_s = 0.7 }]";
  const auto scenario = with_setting("check+=" + one, std::string(valid));
  ASSERT_TRUE(scenario) << scenario.error().message;
  ASSERT_EQ(scenario->checks.size(), 2U);
  EXPECT_EQ(rule_of<checks::Heartbeat>(scenario->checks[0]).silent_at_most_us, 500'000);
  EXPECT_EQ(rule_of<checks::Heartbeat>(scenario->checks[1]).silent_at_most_us, 700'000);
  const auto replaced = with_setting("check=" + one, std::string(valid));
  ASSERT_TRUE(replaced) << replaced.error().message;
  EXPECT_EQ(replaced->checks.size(), 1U);
  EXPECT_NE(replaced->hash, scenario->hash);
  EXPECT_THAT(with_setting("fault+=[{ kind = 'flood' }]", std::string(valid)).error().message,
              HasSubstr("key 'fault[1].kind'"))
      << "the scenario has no faults yet";
  for (const std::string_view wrong : {"check+=3", "title+=[{}]", "check+=[1]"})
    EXPECT_THAT(with_setting(wrong, std::string(valid)).error().message,
                HasSubstr("expected an array of tables"))
        << wrong;
}

TEST(Settings, NameATableOfAnArrayByItsNameOrItsNumber) {
  const std::string two =
      std::string(valid) + "[[check]]\nname = \"second\"\nkind = \"heartbeat\"\nsilent_at_most_s = 0.6\n";
  for (const auto& [text, first_us, second_us] :
       {std::tuple("check.second.silent_at_most_s=3", 500'000, 3'000'000),
        std::tuple("check.1.silent_at_most_s=4", 4'000'000, 600'000)}) {
    const auto scenario = with_setting(text, two);
    ASSERT_TRUE(scenario) << scenario.error().message;
    EXPECT_EQ(rule_of<checks::Heartbeat>(scenario->checks.at(0)).silent_at_most_us, first_us);
    EXPECT_EQ(rule_of<checks::Heartbeat>(scenario->checks.at(1)).silent_at_most_us, second_us);
    ASSERT_EQ(scenario->settings.size(), 1U);
    EXPECT_NE(scenario->hash, parsed(two).hash);
  }
  for (const std::string_view wrong : {"check.third.from_s=3", "check.3.from_s=3", "check.0.from_s=3"})
    EXPECT_THAT(with_setting(wrong, two).error().message,
                HasSubstr("expected the name of one, or its number from 1 to 2"));
  EXPECT_THAT(with_setting("check.second.form_s=3", two).error().message, HasSubstr("check[2].form_s"));
  EXPECT_THAT(with_setting("title.x=3", two).error().message,
              HasSubstr("'title' is a string, expected a table"));
}

}  // namespace
}  // namespace canhil::scenario
