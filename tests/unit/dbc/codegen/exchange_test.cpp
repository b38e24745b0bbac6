// The hash of the messages that a run exchanges.
#include "dbc/codegen/exchange.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "dbc/parser/parse.hpp"
#include "messages/canhil.hpp"

namespace canhil::dbc {
namespace {

using Hashes = std::map<std::string, std::uint32_t>;

Hashes hashes_of(const std::string& text) {
  const auto database = parse(text, "canhil.dbc");
  EXPECT_TRUE(database) << database.error().message;
  Hashes hashes;
  for (const Exchange& exchange : exchanges(*database)) hashes[exchange.estimator] = exchange.hash24;
  return hashes;
}

class OfCanhil : public testing::Test {
 protected:
  [[nodiscard]] std::string with(const std::string& was, const std::string& is) const {
    EXPECT_NE(text_.find(was), std::string::npos) << was;
    std::string text = text_;
    for (std::size_t at = 0; (at = text.find(was, at)) != std::string::npos; at += is.size())
      text.replace(at, was.size(), is);
    return text;
  }
  // The names of the exchanges whose hash differs from that of canhil.dbc.
  [[nodiscard]] std::vector<std::string> changed_by(const std::string& text) const {
    std::vector<std::string> names;
    for (const auto& [estimator, hash] : hashes_of(text)) {
      if (!own_.contains(estimator) || own_.at(estimator) != hash) names.push_back(estimator);
    }
    return names;
  }

  std::ifstream file_{SOURCE_DIR "/dbc/canhil.dbc"};
  std::string text_{std::istreambuf_iterator<char>(file_), {}};
  Hashes own_ = hashes_of(text_);
};

TEST_F(OfCanhil, IsThatOfTheGeneratedHeader) {
  EXPECT_GE(own_.size(), 5U);
  for (const auto& [estimator, hash] : own_) EXPECT_EQ(messages::exchange_hash24(estimator), hash);
  EXPECT_EQ(messages::exchange_hash24("none"), own_.at(""));
  std::set<std::uint32_t> different;
  for (const auto& [estimator, hash] : own_) different.insert(hash);
  EXPECT_EQ(different.size(), own_.size());
}

TEST_F(OfCanhil, ANewSensorChangesOnlyTheExchangesOfItsEstimators) {
  const auto added = [](std::string text, std::string_view attribute) {
    text.insert(text.find("\nCM_ "),
                "\nBO_ 2000 Altimeter: 8 Gps\n SG_ height_m : 12|20@1+ (0.1,-10000) [0|0] \"m\" Target\n");
    return text.append(attribute);
  };
  EXPECT_THAT(changed_by(added(text_, "BA_ \"Estimators\" BO_ 2000 \"altimeter wind\";\n")),
              testing::ElementsAre("altimeter", "wind"));
  EXPECT_EQ(changed_by(added(text_, "")).size(), own_.size()) << "a message of every run";
}

TEST_F(OfCanhil, ANewNameOfAnEstimatorOrAParameterChangesNone) {
  EXPECT_THAT(changed_by(with("VAL_ 768 estimator ", "VAL_ 768 estimator 7 \"new\" ")), testing::IsEmpty());
}

TEST_F(OfCanhil, ADifferenceOnTheWireChangesTheExchangesThatHaveTheMessage) {
  EXPECT_THAT(changed_by(with("antenna_increment_roll_rad", "antenna_increment_roll_mrad")),
              testing::ElementsAre("los_rate"));
  EXPECT_THAT(changed_by(with("BA_ \"E2eDataId\" BO_ 129 16513;", "BA_ \"E2eDataId\" BO_ 129 513;")),
              testing::AllOf(testing::IsSupersetOf({"inflight_alignment", "transfer_alignment"}),
                             testing::Not(testing::Contains("los_rate"))));
  EXPECT_EQ(changed_by(with("elevator_deg : 12|12@1- (0.02,0)", "elevator_deg : 12|12@1- (0.01,0)")),
            std::vector<std::string>{"wind"});
  EXPECT_EQ(changed_by(with("SG_ dbc_hash : 23|24@1+ (1,0) [0|16777215] \"\" Bench",
                            "SG_ dbc_hash : 23|24@1+ (1,0) [0|5] \"\" Bench"))
                .size(),
            0U)
      << "the permitted range is not on the wire";
}

}  // namespace
}  // namespace canhil::dbc
