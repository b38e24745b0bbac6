// Files that are no FMU that this bench can run: each is refused with one line, before or at the start.
#include <gmock/gmock.h>

#include "tests/unit/bench/plant/made_fmu.hpp"

namespace canhil {
namespace {

using test::Described;
using test::Packed;

const std::vector<Described> one_output{{"y", 40, "Float64", "output"}};

Packed described(const std::string& xml) { return {.name = "modelDescription.xml", .content = xml}; }

class BrokenFmu : public testing::Test {
 protected:
  const test::NothingLeft nothing_left_;

  /// What reading says about model.fmu, after the place of the key.
  static std::string refusal() {
    const std::string error = test::read_plant("file = 'model.fmu'\n").error;
    const std::string place = "test.toml:2: key 'plant.file': model.fmu: ";
    EXPECT_TRUE(error.starts_with(place)) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
    return error.substr(std::min(place.size(), error.size()));
  }
  static std::string refusal(const std::vector<Packed>& all) {
    test::write_zip("model.fmu", all);
    return refusal();
  }
  static std::string refusal_of(const std::string& xml) { return refusal({described(xml)}); }
  static std::string good(const std::string& definitions = "",
                          const std::vector<Described>& variables = one_output) {
    return test::description_of(3, "passing3", variables, definitions);
  }
};

std::string replaced(std::string text, std::string_view old, std::string_view with) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

TEST_F(BrokenFmu, IsNoZipArchive) {
  std::ofstream(test::own_folder() + "/model.fmu") << "no zip";
  EXPECT_EQ(refusal(), "is not a zip archive (Not a zip archive), expected an FMU");
  std::ofstream(test::own_folder() + "/model.fmu", std::ios::trunc).flush();
  EXPECT_EQ(refusal(), "has no modelDescription.xml, expected an FMU");
  EXPECT_EQ(
      test::read_plant("file = 'none.fmu'\n").error,
      "test.toml:2: key 'plant.file': none.fmu: cannot be read (No such file or directory), expected an "
      "FMU");
}

TEST_F(BrokenFmu, IsNotNamed) {
  const auto read = test::read_plant("");
  EXPECT_EQ(read.error, "test.toml:1: key 'plant.file': is missing, expected text on one line");
  EXPECT_FALSE(read.plan->make({}));
}

TEST_F(BrokenFmu, IsTruncatedAnywhere) {
  test::write_fmu(3, "passing3", good());
  const std::string whole = test::content_of(test::own_folder() + "/model.fmu");
  for (std::size_t size = 1; size < whole.size(); size += 1 + whole.size() / 40) {
    std::ofstream(test::own_folder() + "/model.fmu", std::ios::trunc)
        .write(whole.data(), static_cast<std::streamsize>(size));
    EXPECT_THAT(refusal(), testing::StartsWith("is not a zip archive")) << size;
  }
}

TEST_F(BrokenFmu, HasDamagedBytes) {
  test::write_fmu(3, "passing3", good());
  std::string whole = test::content_of(test::own_folder() + "/model.fmu");
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 60) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    std::ofstream(test::own_folder() + "/model.fmu", std::ios::trunc) << damaged;
    const auto read = test::read_plant("file = 'model.fmu'\n");
    if (!read.error.empty()) continue;
    // The damage is in the binary: unpacking finds it, unless the byte has no meaning.
    const auto made = read.plan->make({});
    if (!made) {
      EXPECT_THAT(made.error().message, testing::HasSubstr("model.fmu"));
    }
  }
}

TEST_F(BrokenFmu, ClimbsOutOfItsFolder) {
  for (const char* name : {"../outside", "/tmp/outside", "resources/../../outside", "a\\b", "./x", "a//b"})
    EXPECT_EQ(refusal({described(good()), {.name = name, .content = "x"}}),
              fmt::format("contains '{}', expected files below its own folder", name));
  EXPECT_EQ(
      refusal({described(good()), {.name = "resources/link", .content = "/etc/passwd", .mode = 0120777}}),
      "contains the link or device 'resources/link', expected files and folders");
  EXPECT_FALSE(std::filesystem::exists(test::own_folder() + "/outside"));
}

TEST_F(BrokenFmu, HasAFileTwice) {
  const auto twice = [](const std::string& one, const std::string& other) {
    test::write_fmu(3, "passing3", good(),
                    {{.name = "a1.txt", .content = one}, {.name = "a2.txt", .content = other}});
    const std::string path = test::own_folder() + "/model.fmu";
    std::string zip = test::content_of(path);
    for (auto at = zip.find("a2.txt"); at != std::string::npos; at = zip.find("a2.txt", at))
      zip[at + 1] = '1';
    std::ofstream(path, std::ios::trunc) << zip;
  };
  twice("x", "x");
  EXPECT_TRUE(test::plan_of()->make({}));
  twice("x", "y");
  EXPECT_EQ(refusal(), "contains 'a1.txt' twice with different contents, expected it once");
}

TEST_F(BrokenFmu, IsTooLargeWhenUnpacked) {
  test::write_fmu(3, "passing3", good());
  const std::string path = test::own_folder() + "/model.fmu";
  std::string zip = test::content_of(path);
  const auto entry = zip.find("PK\x01\x02");  // of the central directory; its size is at byte 24
  ASSERT_NE(entry, std::string::npos);
  zip.replace(entry + 24, 4, "\xff\xff\xff\xf0");
  std::ofstream(path, std::ios::trunc) << zip;
  EXPECT_EQ(refusal(), "unpacks to more than 2048 MiB, expected at most that");
}

TEST_F(BrokenFmu, HasAWrongDescription) {
  EXPECT_EQ(refusal({{.name = "readme.txt", .content = "x"}}),
            "has no modelDescription.xml, expected an FMU");
  EXPECT_EQ(refusal_of("<a>\n<b></a>"), "modelDescription.xml:2: is not XML (Start-end tags mismatch)");
  EXPECT_EQ(refusal_of("<a/>"), "modelDescription.xml: has no element fmiModelDescription, expected it");
  EXPECT_EQ(refusal_of(replaced(good(), "fmiVersion='3.0'", "fmiVersion='1.0'")),
            "modelDescription.xml: is of FMI version '1.0', expected 2.0 or 3.0");
  EXPECT_EQ(refusal_of(replaced(good(), "<CoSimulation", "<ModelExchange")),
            "modelDescription.xml: is for model exchange alone, expected an FMU for co-simulation");
  EXPECT_EQ(refusal_of(replaced(good(), "modelIdentifier='passing3'", "modelIdentifier='../x'")),
            "modelDescription.xml: modelIdentifier '../x', expected letters, digits and _");
  EXPECT_EQ(refusal_of(replaced(good(), "valueReference='40'", "valueReference='x'")),
            "modelDescription.xml: variable 'y': valueReference 'x', expected a value reference");
  EXPECT_EQ(refusal_of(good("", {{"u", 0, "Int8", "input", "start='200'"}})),
            "modelDescription.xml: variable 'u': start '200', expected a whole number that Int8 can hold");
  EXPECT_EQ(refusal_of(good("", {{"tick", 0, "Clock", "input", "intervalVariability='constant'"}})),
            "modelDescription.xml: variable 'tick' is an input clock, expected an FMU without input clocks");
}

TEST_F(BrokenFmu, HasNoBinaryForThisPlatform) {
  const std::string wanted = "expected binaries/" + test::platform(3) + "/passing3.so";
  EXPECT_EQ(refusal_of(good()), "has no binary, " + wanted);
  EXPECT_EQ(refusal({described(good()),
                     {.name = "binaries/x86_64-windows/passing3.dll", .content = "x"},
                     {.name = "binaries/riscv64-linux/passing3.so", .content = "x"}}),
            "has binaries for riscv64-linux, x86_64-windows alone, " + wanted);
}

/// The error of the start of model.fmu.
std::string error_at_start(bool in_process) {
  auto made = test::plan_of("", in_process)->make({});
  EXPECT_FALSE(made);
  return made ? "" : made.error().message;
}

TEST_F(BrokenFmu, HasABinaryThatCannotBeLoaded) {
  test::write_zip(
      "model.fmu",
      {described(good()), {.name = "binaries/" + test::platform(3) + "/passing3.so", .content = "no ELF"}});
  for (const bool in_process : {false, true}) {
    EXPECT_THAT(error_at_start(in_process),
                testing::StartsWith("FMU 'model.fmu' at its start: its binary cannot be loaded ("));
  }
}

TEST_F(BrokenFmu, LacksAFunction) {
  for (const int version : {2, 3}) {
    const std::string model = version == 2 ? "stepless2" : "stepless3";
    test::write_fmu(version, model, test::description_of(version, model, one_output));
    for (const bool in_process : {false, true}) {
      EXPECT_EQ(error_at_start(in_process),
                fmt::format("FMU 'model.fmu' at its start: its binary has no function fmi{0}DoStep, expected "
                            "those of FMI {0}.0",
                            version));
    }
  }
}

TEST_F(BrokenFmu, HasAnotherToken) {
  test::write_fmu(3, "passing3", replaced(good(), "{passing}", "{other}"));
  EXPECT_EQ(error_at_start(false),
            "FMU 'model.fmu' at its start: fmi3InstantiateCoSimulation returned no instance; the FMU's last "
            "message: wrong token");
  test::write_fmu(2, "passing2",
                  replaced(test::description_of(2, "passing2", one_output), "{passing}", "{other}"));
  EXPECT_EQ(
      error_at_start(true),
      "FMU 'model.fmu' at its start: fmi2Instantiate returned no instance; the FMU's last message: wrong "
      "guid {other}");
}

TEST_F(BrokenFmu, MayRunOnlyOncePerProcess) {
  test::write_fmu(
      3, "passing3",
      test::description_of(3, "passing3", one_output, "", "canBeInstantiatedOnlyOncePerProcess='true'"));
  EXPECT_EQ(
      test::read_plant("file = 'model.fmu'\nin_process = true\n").error,
      "test.toml:3: key 'plant.in_process': is true, but the FMU can be instantiated only once per process, "
      "expected a process of its own (false)");
}

}  // namespace
}  // namespace canhil
