#include "bench/processes/program_protocol.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace canhil::processes::program_protocol {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ProgramProtocol, OpeningHasVersionDrawAndParameters) {
  const std::vector<Parameter> parameters{{"mass", 0.1}, {"table", "my data.csv"}, {"count", 3.0}};
  EXPECT_EQ(
      opening(parameters, {.role = "plant", .seed = 7, .run_index = 2}),
      "canhil-plant 1\nseed 7\nrun 2\nnumber mass 0.1\ntext table my data.csv\nnumber count 3\nstart\n");
}

TEST(ProgramProtocol, NumbersOfAStepAreReadBackExactly) {
  const double third = 1.0 / 3, tiny = std::numeric_limits<double>::denorm_min();
  const std::string line = step_line(0, 10'000, std::vector{third, tiny, -0.0, 5.0});
  EXPECT_EQ(line, "step 0 10000 0.3333333333333333 5e-324 -0 5\n");
  EXPECT_EQ(std::stod("0.3333333333333333"), third);
}

TEST(ProgramProtocol, DeclarationsGiveInputsAndOutputs) {
  Declared all;
  for (const char* line : {"input rudder rad start=-0.1", "input valve 1 steps",
                           "output attitude.heading rad turns", "output  level\tm "})
    ASSERT_TRUE(declare(line, all)) << line;
  ASSERT_EQ(all.inputs.size(), 2U);
  EXPECT_EQ(all.inputs[0].name, "rudder");
  EXPECT_EQ(all.inputs[0].si, "rad");
  EXPECT_EQ(all.inputs[0].start, -0.1);
  EXPECT_FALSE(all.inputs[0].steps);
  EXPECT_EQ(all.inputs[1].si, "");
  EXPECT_TRUE(all.inputs[1].steps);
  ASSERT_EQ(all.outputs.size(), 2U);
  EXPECT_TRUE(all.outputs[0].turns);
  EXPECT_EQ(all.outputs[1].name, "level");
  EXPECT_FALSE(all.outputs[1].turns);
}

TEST(ProgramProtocol, WrongDeclarationsAreOnePhrase) {
  Declared all;
  ASSERT_TRUE(declare("output level m", all));
  const auto error = [&](const char* line) { return declare(line, all).error().message; };
  EXPECT_THAT(error("hello"), HasSubstr("wrote 'hello': not a declaration"));
  EXPECT_THAT(error("output level"), HasSubstr("not a declaration"));
  EXPECT_THAT(error(""), HasSubstr("not a declaration"));
  EXPECT_THAT(error("output angle deg"), HasSubstr("unit 'deg' is unknown, expected one of 1, rad, rad/s"));
  for (const char* name : {"output 1st m", "output a-b m", "output a..b m", "output a. m", "output .a m"})
    EXPECT_THAT(error(name), HasSubstr("not a name")) << name;
  EXPECT_THAT(error("output level m"), HasSubstr("declared before"));
  for (const char* option : {"output other m turns", "output other m start=1", "input other m start=x",
                             "input other m start=inf", "input other m fast"})
    EXPECT_THAT(error(option), HasSubstr("is not an option here")) << option;
  EXPECT_TRUE(declare("input level m", all)) << "an input may have the name of an output";
  EXPECT_EQ(all.outputs.size(), 1U);
}

TEST(ProgramProtocol, DeclarationsHaveAnEnd) {
  Declared all;
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(declare("output a" + std::to_string(i) + " m", all));
  EXPECT_THAT(declare("output b m", all).error().message, HasSubstr("too many, expected at most 1000"));
}

class State : public testing::Test {
 protected:
  std::string error(std::string_view line) { return read_state(line, outputs, values).error().message; }
  std::vector<Variable> outputs{{.name = "level", .si = "m"}, {.name = "flow"}};
  std::vector<double> values = {8, 9};
};

TEST_F(State, HasANumberForEachOutput) {
  ASSERT_TRUE(read_state("state 0.1  -3e-2", outputs, values));
  EXPECT_THAT(values, ElementsAre(0.1, -0.03));
  ASSERT_TRUE(read_state("state\t+1 .5 ", outputs, values));
  EXPECT_THAT(values, ElementsAre(1, 0.5));
}

TEST_F(State, WithoutThemIsOnePhrase) {
  EXPECT_EQ(error("level = 3"), "wrote 'level = 3', expected 'state' and 2 numbers");
  EXPECT_EQ(error(""), "wrote '', expected 'state' and 2 numbers");
  EXPECT_EQ(error("state 1"), "wrote 'state 1': the number of values is 1, expected 2");
  EXPECT_EQ(error("state 1 2 3"), "wrote 'state 1 2 3': the number of values is 3, expected 2");
  EXPECT_EQ(error("state 1 nan"), "wrote nan for 'flow', expected a finite number");
  EXPECT_EQ(error("state -inf 1"), "wrote -inf for 'level', expected a finite number");
  EXPECT_EQ(error("state 1,5 1"), "wrote '1,5' for 'level', expected a number");
  EXPECT_EQ(error("state 1e999 1"), "wrote '1e999' for 'level', expected a number");
  EXPECT_EQ(error("state +-1 1"), "wrote '+-1' for 'level', expected a number");
}

TEST(ProgramProtocol, LinesAreShownEscapedAndShort) {
  EXPECT_EQ(shown("a\x1b[2J"), "'a\\x1b[2J'");
  EXPECT_EQ(shown(std::string(100, 'x')), "'" + std::string(80, 'x') + "...'");
  EXPECT_EQ(shown(std::string(79, 'x') + "\u00e4bc"), "'" + std::string(79, 'x') + "...'");
}

TEST(ProgramProtocol, ErrorsHaveText) {
  EXPECT_STREQ(error_text("error no mass"), "no mass");
  EXPECT_STREQ(error_text("error"), "");
  EXPECT_EQ(error_text("errors 1"), nullptr);
  EXPECT_EQ(error_text("state 1"), nullptr);
}

}  // namespace
}  // namespace canhil::processes::program_protocol
