// The examples of docs/examples, started as a user starts them.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "tests/unit/bench/plant/read_plan.hpp"

namespace canhil::plant {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string ship_keys =
    "heading_deg = 350\nspeed_mps = 6\nturn_time_constant_s = 8\nturn_gain_per_s = 0.12\n"
    "actuator_lag_s = 0.5\nactuator_rate_degps = 4\nactuator_stop_deg = 30\nactuator_offset_deg = "
    "2\ngust_degps2 = 0.2\n";

// Commands that reach the stop and the largest rate, and go back and forth.
double rudder_at(int step) { return step < 1000 ? 0.9 : 0.3 * std::sin(0.01 * step); }

TEST(ProgramExamples, TheShipInPythonMovesAsTheOneOfTheBench) {
  const auto built_in = good_plan("steered_heading", ship_keys + "gust_s = [3, 12.5]\n");
  const auto program =
      good_plan("program", "command = 'python3 " SOURCE_DIR
                           "/docs/examples/plant/ship.py'\n[plant.parameters]\ngust_from_s = 3\n"
                           "gust_to_s = 12.5\n" +
                               ship_keys);
  ASSERT_TRUE(built_in && program);
  const auto name = [](const Variable& one) { return one.name + " " + one.si + (one.turns ? " turns" : ""); };
  EXPECT_TRUE(std::ranges::equal(built_in->inputs, program->inputs, {}, name, name));
  EXPECT_TRUE(std::ranges::equal(built_in->outputs, program->outputs, {}, name, name));
  const auto one = made(*built_in), other = made(*program);
  ASSERT_TRUE(one && other);
  double farthest = 0, turned = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector rudder{rudder_at(i)};
    ASSERT_TRUE(one->step(10'000 * i, 10'000 * (i + 1), rudder));
    const auto done = other->step(10'000 * i, 10'000 * (i + 1), rudder);
    ASSERT_TRUE(done) << done.error().message;
    for (std::size_t k = 0; k < built_in->outputs.size(); ++k)
      farthest = std::max(farthest, std::abs(one->outputs()[k] - other->outputs()[k]));
    turned = std::max(turned, std::abs(one->outputs()[0] - 350 * M_PI / 180));
  }
  EXPECT_LT(farthest, 1e-12);
  EXPECT_GT(turned, 0.5) << "the ship has to turn, so that the comparison means something";
}

TEST(ProgramExamples, TheTurntableInCTurnsAtTheCommandedRate) {
  const auto plan =
      good_plan("program", "command = '" TURNTABLE "'\n[plant.parameters]\nlargest_radps = 0.3\n");
  ASSERT_NE(plan, nullptr);
  const auto plant = made(*plan);
  double angle = 0;
  for (int i = 0; i < 1000; ++i) {
    const double rate = i < 500 ? 0.1 + 1e-3 * i : -0.7;
    angle += std::clamp(rate, -0.3, 0.3) * 1e-6 * 10'000;
    ASSERT_TRUE(plant->step(10'000 * i, 10'000 * (i + 1), std::vector{rate}));
    ASSERT_EQ(plant->outputs()[0], angle) << "17 digits carry each bit";
  }
}

// What the program writes, given the lines of the bench.
std::string answers_of_turntable(const std::string& lines) {
  const std::string file = test::own_folder() + "/lines";
  std::ofstream(file) << lines;
  FILE* output = popen((TURNTABLE " < " + file).c_str(), "r");
  std::string all;
  for (int c = std::getc(output); c != EOF; c = std::getc(output)) all += static_cast<char>(c);
  pclose(output);
  return all;
}

TEST(ProgramExamples, TheDialogueOfThePageIsReal) {
  std::ifstream page(SOURCE_DIR "/docs/plant-program.md");
  std::string from_bench, from_program;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("> ")) from_bench += line.substr(2) + "\n";
    if (line.starts_with("< ")) from_program += line.substr(2) + "\n";
  }
  EXPECT_THAT(from_bench, HasSubstr("start\nstep"));
  EXPECT_EQ(answers_of_turntable(from_bench), from_program);
}

class PythonModule : public testing::Test {
 protected:
  // Reads a plant of a class Plant, whose body this is.
  static PlanRead read(const std::string& body, const std::string& parameters = "") {
    std::ofstream(test::own_folder() + "/own.py") << "import random, sys\nsys.path.append('" SOURCE_DIR
                                                     "/python/canhil')\nimport partner\n\nclass Plant:\n"
                                                  << body << "\npartner.serve(Plant)\n";
    return read_plan("program", "command = 'python3 own.py'\n[plant.parameters]\n" + parameters);
  }
  static inline const std::string tank =
      "    inputs = {'valve': '1 steps start=1'}\n    outputs = {'level': 'm'}\n"
      "    def values(self): return [self.level]\n";
};

TEST_F(PythonModule, GivesTimesInputsAndParameters) {
  const auto plan =
      read(tank +
               "    def __init__(self, level, name='x'): self.level = level + len(name)\n"
               "    def step(self, t, dt, inputs): self.level += 100 * t + dt * inputs['valve']\n",
           "level = 0.5\nname = 'a  b'\n")
          .plan;
  ASSERT_NE(plan, nullptr);
  EXPECT_TRUE(plan->inputs.front().steps);
  EXPECT_EQ(plan->inputs.front().start, 1);
  const auto plant = made(*plan);
  EXPECT_THAT(values(*plant), ElementsAre(4.5));
  ASSERT_TRUE(plant->step(2'000'000, 2'250'000, std::vector{2.0}));
  EXPECT_THAT(values(*plant), ElementsAre(4.5 + 200 + 0.25 * 2));
}

TEST_F(PythonModule, LetsThePlantPrint) {
  const auto plan = read(tank +
                         "    def __init__(self): self.level = 1; print('made')\n"
                         "    def step(self, t, dt, inputs): print('step', flush=True)\n")
                        .plan;
  ASSERT_NE(plan, nullptr);
  EXPECT_TRUE(made(*plan)->step(0, 10'000, std::vector{0.0}));
}

TEST_F(PythonModule, DrawsTheSameNumbersInTheSameRun) {
  const auto plan =
      read(tank + "    level = 0\n    def step(self, t, dt, inputs): self.level = random.random()\n").plan;
  ASSERT_NE(plan, nullptr);
  const auto drawn = [&](const Draw& draw) {
    const auto plant = made(*plan, draw);
    EXPECT_TRUE(plant->step(0, 10'000, std::vector{0.0}));
    return plant->outputs()[0];
  };
  EXPECT_EQ(drawn({.seed = 1}), drawn({.seed = 1}));
  EXPECT_NE(drawn({.seed = 1}), drawn({.seed = 2}));
  EXPECT_NE(drawn({.seed = 1}), drawn({.seed = 1, .run_index = 1}));
}

TEST_F(PythonModule, ReportsExceptions) {
  EXPECT_THAT(read(tank + "    def __init__(self, area): pass\n", "aera = 1\n").error,
              HasSubstr("got an unexpected keyword argument 'aera'"));
  const auto plan =
      read(tank + "    level = 0\n    def step(self, t, dt, inputs): raise ValueError('dry\\nrun')\n").plan;
  ASSERT_NE(plan, nullptr);
  EXPECT_EQ(made(*plan)->step(0, 10'000, std::vector{0.0}).error().message,
            "program 'python3 own.py' at 0.01 s: reports 'ValueError: dry run'");
}

}  // namespace
}  // namespace canhil::plant
