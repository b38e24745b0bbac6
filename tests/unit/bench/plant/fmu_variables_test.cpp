// The variables of FMUs: types, units, start values, arrays, parameters.
#include <numbers>

#include "tests/unit/bench/plant/made_fmu.hpp"

namespace canhil {
namespace {

using test::Described;
using testing::Test;

const std::string definitions2 =
    "<UnitDefinitions><Unit name='deg'><BaseUnit rad='1' factor='0.017453292519943295'/></Unit>"
    "<Unit name='degC'><BaseUnit K='1' offset='273.15'/></Unit>"
    "<Unit name='N'><BaseUnit kg='1' m='1' s='-2'/></Unit><Unit name='kn'/></UnitDefinitions>"
    "<TypeDefinitions><SimpleType name='Angle'><Real unit='deg' min='-90' max='90'/></SimpleType>"
    "<SimpleType name='Gear'><Enumeration><Item name='reverse' value='-1'/><Item name='drive' value='5'/>"
    "</Enumeration></SimpleType></TypeDefinitions>"
    "<DefaultExperiment stepSize='0.02'/>";

std::string definitions(int version) {
  std::string text = definitions2;
  if (version == 2) return text;
  const auto from = text.find("<SimpleType name='Angle'>"), to = text.find("</TypeDefinitions>");
  return text.replace(from, to - from,
                      "<Float64Type name='Angle' unit='deg' min='-90' max='90'/>"
                      "<EnumerationType name='Gear'><Item name='reverse' value='-1'/>"
                      "<Item name='drive' value='5'/></EnumerationType>");
}

/// Input `reference` and the output that has its value plus the parameter `offset`.
void add_pair(std::vector<Described>& all, const std::string& name, int reference, const std::string& type,
              const std::string& start, const std::string& more = "") {
  all.push_back({.name = name + ".in",
                 .reference = reference,
                 .type = type,
                 .causality = "input",
                 .more = fmt::format("start='{}' {}", start, more)});
  all.push_back({.name = name + ".out",
                 .reference = reference + 40,
                 .type = type,
                 .causality = "output",
                 .more = more});
}

std::vector<Described> variables_of(int version) {
  std::vector<Described> all;
  add_pair(all, "plain", 0, "Float64", "1.5");
  add_pair(all, "attitude.roll", 1, "Float64", "9", "declaredType='Angle'");
  add_pair(all, "temperature", 2, "Float64", "20", "unit='degC'");
  add_pair(all, "rise", 3, "Float64", "20", "unit='degC' relativeQuantity='true'");
  add_pair(all, "force", 4, "Float64", "0", "unit='N'");
  add_pair(all, "speed", 5, "Float64", "0", "unit='kn'");
  add_pair(all, "count", 6, "Int32", "-7");
  add_pair(all, "on", 7, "Boolean", "true");
  add_pair(all, "gear", 8, "Enumeration", "5", "declaredType='Gear'");
  if (version == 3) {
    int reference = 10;
    for (const char* type : {"Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "Int64", "UInt64"})
      add_pair(all, type, reference++, type, "3");
    const std::string sizes = "<Dimension start='2'/><Dimension start='3'/>";
    all.push_back({"matrix", 20, "Float64", "input", "start='1 2 3 4 5 6'", "", sizes});
    all.push_back({"matrix_out", 60, "Float64", "output", "", "", sizes});
  }
  all.push_back({"offset", 80, "Float64", "parameter", "start='0'", "variability='fixed'"});
  all.push_back({"title", 0, "String", "parameter", version == 2 ? "start='abc'" : "", "variability='fixed'",
                 version == 2 ? "" : "<Start value='abc'/>"});
  all.push_back({"length", 79, "Float64", "output"});
  all.push_back({"text_in", 1, "String", "input", version == 2 ? "start=''" : ""});
  all.push_back({"hidden", 81, "Float64", "local"});
  return all;
}

class Variables : public testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  const test::NothingLeft nothing_left_;
  const int version_ = std::get<0>(GetParam());
  const bool in_process_ = std::get<1>(GetParam());

  void SetUp() override {
    const std::string model = version_ == 2 ? "passing2" : "passing3";
    test::write_fmu(version_, model,
                    test::description_of(version_, model, variables_of(version_), definitions(version_)),
                    {{.name = "resources/"}, {.name = "resources/offset.txt", .content = "d"}});
  }
  [[nodiscard]] std::unique_ptr<plant::Plan> plan(const std::string& keys = "") const {
    return test::plan_of(keys, in_process_);
  }
};
INSTANTIATE_TEST_SUITE_P(Fmu, Variables, testing::Combine(testing::Values(2, 3), testing::Bool()));

const plant::Variable& find(const std::vector<plant::Variable>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &plant::Variable::name);
  EXPECT_NE(found, all.end()) << name;
  return found == all.end() ? all.front() : *found;
}
std::size_t index_of(const std::vector<plant::Variable>& all, std::string_view name) {
  return static_cast<std::size_t>(&find(all, name) - all.data());
}

TEST_P(Variables, InputsAndOutputsAreInSi) {
  const auto made = plan();
  const double deg = std::numbers::pi / 180;
  EXPECT_EQ(made->step_us, 20'000);
  EXPECT_EQ(find(made->inputs, "plain.in").si, "");
  EXPECT_EQ(find(made->inputs, "plain.in").start, 1.5);
  EXPECT_FALSE(find(made->inputs, "plain.in").steps);
  EXPECT_EQ(find(made->inputs, "attitude.roll.in").si, "rad");
  EXPECT_DOUBLE_EQ(find(made->inputs, "attitude.roll.in").start, 9 * deg);
  EXPECT_TRUE(find(made->outputs, "attitude.roll.out").turns);
  EXPECT_EQ(find(made->outputs, "temperature.out").si, "K");
  EXPECT_DOUBLE_EQ(find(made->inputs, "temperature.in").start, 293.15);
  EXPECT_DOUBLE_EQ(find(made->inputs, "rise.in").start, 20);
  EXPECT_EQ(find(made->outputs, "force.out").si, "");  // the bench has no name for it
  EXPECT_EQ(find(made->inputs, "count.in").start, -7);
  EXPECT_TRUE(find(made->outputs, "count.out").steps);
  EXPECT_EQ(find(made->inputs, "on.in").start, 1);
  EXPECT_EQ(find(made->inputs, "gear.in").start, 5);
  const auto known = [](std::string_view name) {
    return [name](const plant::Variable& one) { return one.name.starts_with(name); };
  };
  for (const char* name : {"text_in", "hidden", "time", "offset", "title"}) {
    EXPECT_TRUE(std::ranges::none_of(made->inputs, known(name))) << name;
    EXPECT_TRUE(std::ranges::none_of(made->outputs, known(name))) << name;
  }
}

TEST_P(Variables, EveryTypePassesThrough) {
  const auto made = plan();
  auto running = made->make({});
  ASSERT_TRUE(running) << running.error().message;
  std::vector<double> inputs;
  for (const auto& input : made->inputs) inputs.push_back(input.start);
  const auto expect_equal = [&] {
    const auto outputs = (*running)->outputs();
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const std::string name = made->inputs[i].name;
      std::string output = name;
      if (name.ends_with(".in"))
        output.replace(name.size() - 2, 2, "out");
      else
        output.replace(0, 6, "matrix_out");
      EXPECT_NEAR(outputs[index_of(made->outputs, output)], inputs[i], 1e-12) << output;
    }
  };
  expect_equal();  // at time 0, the outputs follow from the start values
  EXPECT_EQ((*running)->outputs()[index_of(made->outputs, "length")], 3 + 'd');
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& name = made->inputs[i].name;
    inputs[i] = name == "on.in" ? 0 : name == "gear.in" ? -1 : 7 + static_cast<double>(i);
  }
  const auto done = (*running)->step(0, 10'000, inputs);
  ASSERT_TRUE(done) << done.error().message;
  expect_equal();
}

TEST_P(Variables, WholeNumbersAreRoundedAndChecked) {
  const auto made = plan();
  auto running = made->make({});
  ASSERT_TRUE(running) << running.error().message;
  std::vector<double> inputs(made->inputs.size());
  inputs[index_of(made->inputs, "count.in")] = 2.6;
  inputs[index_of(made->inputs, "on.in")] = 0.5;
  ASSERT_TRUE((*running)->step(0, 10'000, inputs));
  EXPECT_EQ((*running)->outputs()[index_of(made->outputs, "count.out")], 3);
  EXPECT_EQ((*running)->outputs()[index_of(made->outputs, "on.out")], 1);
  inputs[index_of(made->inputs, "count.in")] = 3e9;
  const auto done = (*running)->step(10'000, 20'000, inputs);
  ASSERT_FALSE(done);
  EXPECT_EQ(
      done.error().message,
      "FMU 'model.fmu' in the step from 0.01 s to 0.02 s: input 'count.in' is 3000000000, which the type "
      "Int32 cannot hold");
}

TEST_P(Variables, ParametersAndStartValuesComeFromTheScenario) {
  const auto made = plan(
      "parameters.offset = 0.25\nparameters.title = 'four'\nparameters.plain.in = 8\n"
      "parameters.gear.in = 'reverse'\nparameters.on.in = false\n");
  EXPECT_EQ(find(made->inputs, "plain.in").start, 8);
  EXPECT_EQ(find(made->inputs, "gear.in").start, -1);
  auto running = made->make({});
  ASSERT_TRUE(running) << running.error().message;
  const auto output = [&](std::string_view name) {
    return (*running)->outputs()[index_of(made->outputs, name)];
  };
  EXPECT_EQ(output("plain.out"), 8.25);
  EXPECT_EQ(find(made->inputs, "on.in").start, 0);
  EXPECT_EQ(output("length"), 4 + 'd');
}

// A campaign sets parameters in this way.
TEST_P(Variables, SettingsReplaceParameters) {
  const auto setting = [](const std::string& key, const std::string& value) {
    return scenario::Setting{.key = "plant.parameters." + key, .value = value, .elements = {}, .line = 0};
  };
  const auto read = test::read_plant("file = 'model.fmu'\nparameters.offset = 1\n", "fmu",
                                     {setting("offset", "2.5"), setting("gear.in", "'reverse'")});
  ASSERT_EQ(read.error, "");
  EXPECT_EQ(find(read.plan->inputs, "gear.in").start, -1);
  auto running = read.plan->make({});
  ASSERT_TRUE(running) << running.error().message;
  EXPECT_EQ((*running)->outputs()[index_of(read.plan->outputs, "plain.out")], 1.5 + 2.5);
  EXPECT_EQ(test::read_plant("file = 'model.fmu'\n", "fmu", {setting("ofset", "1")}).error,
            "test.toml: key 'plant.parameters.ofset': is unknown, expected 'offset'");
}

std::string error_of(const std::string& parameters) {
  return test::read_plant("file = 'model.fmu'\n[plant.parameters]\n" + parameters).error;
}

TEST_P(Variables, WrongParametersAreRefused) {
  EXPECT_EQ(error_of("ofset = 1\n"),
            "test.toml:4: key 'plant.parameters.ofset': is unknown, expected 'offset'");
  EXPECT_EQ(error_of("offset = 'x'\n"),
            "test.toml:4: key 'plant.parameters.offset': is a string, expected a number");
  EXPECT_EQ(
      error_of("hidden = 1\n"),
      "test.toml:4: key 'plant.parameters.hidden': is computed by the FMU, expected a parameter or a start "
      "value");
  EXPECT_EQ(error_of("title = 1\n"),
            "test.toml:4: key 'plant.parameters.title': is a number, expected text on one line");
  EXPECT_EQ(error_of("count.in = 1.5\n"),
            "test.toml:4: key 'plant.parameters.count.in': is not whole, expected a whole number of at least "
            "-2147483648");
  EXPECT_EQ(
      error_of("count.in = 3_000_000_000\n"),
      "test.toml:4: key 'plant.parameters.count.in': 3000000000 is out of range, expected a whole number "
      "from -2147483648 to 2147483647");
  EXPECT_EQ(error_of("gear.in = 'drve'\n"),
            "test.toml:4: key 'plant.parameters.gear.in': 'drve' is unknown, expected 'drive'");
  EXPECT_EQ(error_of("gear.in = 2\n"),
            "test.toml:4: key 'plant.parameters.gear.in': 2 is no value of the enumeration, expected one of: "
            "reverse, drive");
  EXPECT_EQ(
      error_of("attitude.roll.in = 91\n"),
      "test.toml:4: key 'plant.parameters.attitude.roll.in': 91 is out of range, expected a number from "
      "-90 to 90");
}

// An array whose size is a structural parameter.
std::vector<Described> sized_variables() {
  const std::string size = "<Dimension valueReference='90'/>";
  return {{"n", 90, "UInt64", "structuralParameter", "start='3'", "variability='fixed'"},
          {"u", 0, "Float64", "input", "start='1 2 3'", "", size},
          {"y", 40, "Float64", "output", "", "", size},
          {"offset", 80, "Float64", "parameter", "start='5 6 7'", "variability='fixed'", size}};
}

class Arrays : public Test {
 protected:
  const test::NothingLeft nothing_left_;
  void SetUp() override {
    test::write_fmu(3, "passing3", test::description_of(3, "passing3", sized_variables()));
  }
};

std::vector<std::string> names_of(const std::vector<plant::Variable>& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.push_back(one.name);
  return names;
}

TEST_F(Arrays, HaveTheSizeOfTheStructuralParameter) {
  const auto made = test::plan_of("parameters = { 'offset[1]' = 0.5, 'u[2]' = 9 }\n");
  EXPECT_EQ(names_of(made->inputs), (std::vector<std::string>{"u[1]", "u[2]", "u[3]"}));
  EXPECT_EQ(made->inputs[1].start, 9);
  EXPECT_EQ(made->inputs[2].start, 3);
  auto running = made->make({});
  ASSERT_TRUE(running) << running.error().message;
  EXPECT_EQ((*running)->outputs()[1], 9.5);
}

TEST_F(Arrays, AScenarioChangesTheirSize) {
  const auto made = test::plan_of("parameters = { n = 2, 'offset[1]' = 0.5, 'offset[2]' = 1 }\n");
  EXPECT_EQ(names_of(made->outputs), (std::vector<std::string>{"y[1]", "y[2]"}));
  EXPECT_EQ(made->inputs[0].start, 0);
  auto running = made->make({});
  ASSERT_TRUE(running) << running.error().message;
  ASSERT_TRUE((*running)->step(0, 10'000, std::vector<double>{1, 2}));
  EXPECT_EQ((*running)->outputs()[1], 2.5);
}

TEST_F(Arrays, WrongElementsAreRefused) {
  EXPECT_EQ(error_of("offset = 1\n"),
            "test.toml:4: key 'plant.parameters.offset': is an array, expected its elements, such as "
            "\"offset[1]\"");
  EXPECT_EQ(error_of("'offset[4]' = 1\n"),
            "test.toml:4: key 'plant.parameters.offset[4]': is unknown, expected 'offset[1]'");
  EXPECT_EQ(
      error_of("n = 2\n'offset[1]' = 1\n"),
      "test.toml:3: key 'plant.parameters': has no offset[2], expected values for all 2 elements, because "
      "modelDescription.xml has 3");
  EXPECT_EQ(
      error_of("n = 1_000_000\n"),
      "test.toml:2: key 'plant.file': modelDescription.xml: variable 'u' has more than 100000 elements, "
      "expected at most that");
}

}  // namespace
}  // namespace canhil
