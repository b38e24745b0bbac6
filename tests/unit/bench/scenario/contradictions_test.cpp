// Keys that are valid alone but contradict each other, or have no effect together: one error line.
#include <gtest/gtest.h>

#include "tests/unit/bench/scenario/texts.hpp"

namespace canhil::scenario {
namespace {

// A scenario of in-flight alignment, with `aid` as the text after [slave_imu].
std::string inflight(const std::string& aid, const std::string& parameters = "") {
  return with("[truth]", "[target.parameters]\n" + parameters + "[truth]",
              with("[slave_imu]", "[slave_imu]\n" + aid, with("transfer_alignment", "inflight_alignment")));
}

std::string error_with_aiding(const std::string& text) {
  DbcVocabulary with_aiding = contract;
  with_aiding.parameters.emplace_back("aiding");
  const Result<Scenario> result = parse(text, "s.toml", with_aiding);
  return result ? "no error" : result.error().message;
}

TEST(Contradictions, AHeadingOfWhichNothingIsKnownIsForSinCosOnly) {
  EXPECT_EQ(
      error_of(with("heading_deg = 5.0", "heading_deg = 600")),
      "s.toml:7: key 'target.initial_sigma.heading_deg': is more than a heading can be wrong by, expected at "
      "most 180, or algorithm sin_cos");
  EXPECT_EQ(error_of(with("heading_deg = 5.0", "heading_deg = 180")), "no error");
  DbcVocabulary with_sin_cos = contract;
  with_sin_cos.algorithms.emplace_back("sin_cos");
  EXPECT_TRUE(parse(with("heading_deg = 5.0", "heading_deg = 600", with("\"kalman\"", "\"sin_cos\"")),
                    "s.toml", with_sin_cos));
}

TEST(Contradictions, AMisspeltParameterIsOneOfItsEstimator) {
  const auto error = [](const DbcVocabulary& known) {
    const auto result = parse(with("[truth]", "[target.parameters]\nh2_cas = 1\n[truth]"), "s.toml", known);
    return result ? "no error" : result.error().message;
  };
  EXPECT_EQ(error(contract), "s.toml:9: key 'target.parameters.h2_cas': is unknown, expected 'h2_case'");
  DbcVocabulary by_estimator = contract;
  static constexpr std::array<std::string_view, 1> own{"velocity_noise_m2ps"};
  by_estimator.facts["transfer_alignment"].parameters = own;
  EXPECT_EQ(error(by_estimator),
            "s.toml:9: key 'target.parameters.h2_cas': is unknown, expected one of: velocity_noise_m2ps");
  // A parameter of another estimator is sent to the target, because the target may have it.
  EXPECT_TRUE(parse(with("[truth]", "[target.parameters]\nh2_case = 1\n[truth]"), "s.toml", by_estimator));
}

TEST(Contradictions, AnAidWhoseFixesNobodyTakes) {
  EXPECT_EQ(error_of(inside("[slave_imu]", "[gps]")),
            "s.toml:16: key 'gps': has fixes that no estimator takes, expected estimator inflight_alignment "
            "beside it");
  EXPECT_EQ(error_of(inside("[slave_imu]", "[ssbl]")),
            "s.toml:16: key 'ssbl': has fixes that no estimator takes, expected estimator inflight_alignment "
            "beside it");
  EXPECT_EQ(
      error_with_aiding(inflight("[ssbl]", "aiding = 1\n")),
      "s.toml:1: key 'gps': is missing, and parameter aiding = 1 takes no other fixes, expected a table, or "
      "aiding = 0");
  EXPECT_EQ(
      error_with_aiding(inflight("[gps]")),
      "s.toml:1: key 'ssbl': is missing, and parameter aiding = 0 takes no other fixes, expected a table, or "
      "aiding = 1");
  EXPECT_EQ(error_with_aiding(inflight("[gps]", "aiding = 1\n")), "no error");
  EXPECT_EQ(error_with_aiding(inflight("[ssbl]", "aiding = 0\n")), "no error");
  EXPECT_EQ(error_with_aiding(inflight("[ssbl]\n[gps]", "aiding = 1\n")), "no error")
      << "the other may be heard";
}

TEST(Contradictions, TimingOfWhatNobodySends) {
  DbcVocabulary known = contract;
  known.messages.emplace_back("FixUpdate");
  known.answers.emplace_back("FixUpdate");
  known.sent_by = {{"FixUpdate", "inflight_alignment"}, {"AlignUpdate", "transfer_alignment"}};
  const auto error = [&](const std::string& keys) {
    const auto result = parse(inside("[[check]]", keys + "\n[[check]]"), "s.toml", known);
    return result ? "no error" : result.error().message;
  };
  const std::string refused =
      "s.toml:17: key 'check[1].message': 'FixUpdate' is sent by inflight_alignment, which is not run in "
      "this "
      "scenario, expected a message of transfer_alignment";
  EXPECT_EQ(error("message = 'FixUpdate'\nkind = 'latency'\nbelow_ms = 5"), refused);
  EXPECT_EQ(error("message = 'FixUpdate'\nkind = 'output_period'\nwithin_percent = 5"), refused);
  EXPECT_EQ(error("message = 'AlignUpdate'\nkind = 'latency'\nbelow_ms = 5"), "no error");
  EXPECT_EQ(error("message = 'TargetHeartbeat'\nkind = 'output_period'\nwithin_percent = 5"), "no error");
}

TEST(Contradictions, ALowerLimitAboveTheUpper) {
  const auto check = [](const std::string& keys) {
    return error_of(inside("[[check]]", keys + "\n[[check]]"));
  };
  EXPECT_EQ(check("kind = 'answers'\ncoasting_at_least = 3\ncoasting_at_most = 2"),
            "s.toml:18: key 'check[1].coasting_at_least': is more than coasting_at_most, expected a lower "
            "limit below "
            "the upper one");
  EXPECT_EQ(check("kind = 'answers'\ncoasting_at_least = 2\ncoasting_at_most = 2"), "no error");
}

TEST(Contradictions, ADiveHasADepthAndAPeriod) {
  const auto spiral = [](const std::string& keys) {
    return error_of(with("\"rest\"", "\"spiral\"\nspeed_mps = 3\nturn_period_s = 60\n" + keys));
  };
  EXPECT_EQ(spiral("dive_depth_m = 1"),
            "s.toml:12: key 'truth.dive_depth_m': is given alone, expected dive_period_s beside it");
  EXPECT_EQ(spiral("dive_period_s = 60"),
            "s.toml:12: key 'truth.dive_period_s': is given alone, expected dive_depth_m beside it");
  EXPECT_EQ(spiral("dive_depth_m = 1\ndive_period_s = 60"), "no error");
}

TEST(Contradictions, KeysOfAnotherManoeuvre) {
  const auto engagement = [](const std::string& keys) {
    return error_of(
        "title = 'T'\nduration_s = 9\nseed = 1\n[target]\nestimator = 'los_rate'\nalgorithm = 'kalman'\n"
        "[seeker]\n[[check]]\nkind = 'miss_distance'\nbelow_m = 1\n[engagement]\nguidance = 'truth'\n" +
        keys);
  };
  for (const std::string key : {"manoeuvre_g", "manoeuvre_from_s", "manoeuvre_at_to_go_s"}) {
    EXPECT_EQ(engagement("manoeuvre = 'none'\n" + key + " = 1"),
              "s.toml:14: key 'engagement." + key +
                  "': has no effect here, expected manoeuvre = \"step\" or \"weave\"");
  }
  EXPECT_EQ(
      engagement("manoeuvre_period_s = 1"),
      "s.toml:13: key 'engagement.manoeuvre_period_s': has no effect here, expected manoeuvre = \"weave\"");
  EXPECT_EQ(engagement("manoeuvre = 'none'"), "no error");
  EXPECT_EQ(engagement("manoeuvre = 'weave'\nmanoeuvre_period_s = 1\nmanoeuvre_g = 2"), "no error");
}

}  // namespace
}  // namespace canhil::scenario
