// Tests files that cannot be read or written: the program prints one error line, and no data is lost.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/processes/hil/program.hpp"

namespace canhil::test {
namespace {

using testing::HasSubstr;

std::string quick() { return scenario("transfer_alignment_quick"); }
std::string in_process() { return fmt::format("run {} --bus in-process ", quick()); }

std::string copied(const std::string& file, const std::string& name) {
  std::filesystem::copy_file(file, scratch(name), std::filesystem::copy_options::overwrite_existing);
  return scratch(name);
}

TEST(BadFiles, ANameWithLineBreaksIsPrintedOnOneLine) {
  expect_one_line(hil_bench("run 'a\nb\x1b[31m.toml'"), "hil-bench: a\\nb\\x1b[31m.toml: cannot be read");
  expect_one_line(hil_bench(in_process() + "--json '/no/a\nb.json'"), "file '/no/a\\nb.json'");
  expect_one_line(hil_target("--replay 'a\nb.log'"), "cannot read log 'a\\nb.log'");
  expect_one_line(shell(DBCGEN " 'a\nb.dbc'"), "a\\nb.dbc: cannot be read");
}

TEST(BadFiles, AScenarioMayComeThroughAPipe) {
  const Ended ended = shell(fmt::format("cat {} | {} run /dev/stdin --bus in-process", quick(), HIL_BENCH));
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_EQ(ended.err, "");
}

TEST(BadFiles, AFolderThatIsGone) {
  const std::string gone = scratch("gone");
  expect_one_line(shell(fmt::format("mkdir {0}; cd {0}; rmdir {0}; {1} {2} --json x.json", gone, HIL_BENCH,
                                    in_process())),
                  "file 'x.json': cannot be written: No such file or directory");
}

TEST(BadFiles, AnOutputThatCannotBeIsRejectedBeforeTheRun) {
  std::ofstream(scratch("plain")) << "x";
  for (const std::string& path :
       {std::string("/proc/x"), scratch("plain/x"), scratch(std::string(250, 'n'))}) {
    for (const char* option : {"--json", "--junit", "--html", "--log"})
      expect_one_line(hil_bench(fmt::format("{} {} {}", in_process(), option, path)),
                      fmt::format("file '{}': cannot be written: ", path));
  }
}

TEST(BadFiles, WhatIsReadIsNotWrittenOver) {
  const std::string dbc = copied(SOURCE_DIR "/dbc/canhil.dbc", "mine.dbc");
  expect_one_line(hil_bench(fmt::format("{} --dbc {} --json {}", in_process(), dbc, dbc)),
                  "is the same file as");
  EXPECT_EQ(read(dbc), read(SOURCE_DIR "/dbc/canhil.dbc"));
  const std::string target = copied(HIL_TARGET, "my-target");
  expect_one_line(hil_bench(fmt::format("run {} --target {} --log {}", quick(), target, target)),
                  "is the same file as");
  EXPECT_TRUE(read(target) == read(HIL_TARGET));
  expect_one_line(shell(fmt::format("{} {} -o {}", DBCGEN, dbc, dbc)), "is the same file as");
  expect_one_line(shell(fmt::format("{} {} --source {}", DBCGEN, dbc, dbc)), "is the same file as");
  EXPECT_EQ(read(dbc), read(SOURCE_DIR "/dbc/canhil.dbc"));
  expect_one_line(shell(fmt::format("{0} {1} -o {2} --source {2}", DBCGEN, dbc, scratch("one.hpp"))),
                  "is the same file as");
}

TEST(BadFiles, AReaderThatGoesCostsNoOtherReport) {
  const std::string report = scratch("all_the_same.json");
  const Ended ended = shell(fmt::format("{{ {} {} --json {}; echo $? >{}; }} | true", HIL_BENCH, in_process(),
                                        report, scratch("code")));
  EXPECT_EQ(read(scratch("code")), "2\n");
  EXPECT_EQ(ended.err, "hil-bench: standard output: cannot be written: Broken pipe\n");
  EXPECT_EQ(read_json(report)["provenance"]["bus"], "in-process");
}

TEST(BadFiles, ALogOfTheTargetIsNotReplayed) {
  std::ofstream(scratch("target.log")) << "(1.000000) can0 300#BA8280B671410800 R\n";
  expect_one_line(hil_target("--replay " + scratch("target.log")),
                  "target.log: holds only frames of the target, expected the log of a run");
}

TEST(BadFiles, DbcgenWritesWhatItIsAskedForOrSaysWhyNot) {
  const std::string dbc = SOURCE_DIR "/dbc/canhil.dbc";
  const auto dbcgen = [&](const std::string& more) {
    return shell(fmt::format("{} {} {}", DBCGEN, dbc, more));
  };
  // dbcgen must not read the old content of its output file here: reading /dev/full never ends.
  expect_one_line(dbcgen("-o /dev/full"), "file '/dev/full': is not a regular file");
  expect_one_line(dbcgen(">/dev/full"),
                  "dbcgen: standard output: cannot be written: No space left on device\n");
  expect_one_line(dbcgen("-n 'a b;'"), "--namespace: 'a b;' is not a valid C++ namespace");
  expect_one_line(dbcgen("-n ''"), "--namespace: is empty");
  expect_one_line(dbcgen("--load --json"),
                  "expected one of --quantisation, --load, --json, --fd, --fd-header, --c and --python");
  std::ofstream(scratch("none.dbc")) << "BS_:\nBU_: A\n";
  expect_one_line(shell(fmt::format("{} {}", DBCGEN, scratch("none.dbc"))),
                  "none.dbc: no messages in the DBC, expected at least one");
  expect_one_line(hil_bench(fmt::format("schedulability {} --bitrate 500000 >/dev/full", dbc)),
                  "hil-bench: standard output: cannot be written: No space left on device\n");
}

TEST(BadFiles, AnOptionIsNoValueOfAnother) {
  expect_one_line(
      hil_bench(in_process() + "--json --lockstep"),
      "--json: '--lockstep' looks like an option, expected a value (a file of that name: ./--lockstep)");
  EXPECT_FALSE(std::filesystem::exists("--lockstep"));
}

TEST(BadBuses, ANodeHasOneBus) {
  expect_one_line(
      hil_bench(fmt::format("run {} --bus-of master_ins=local:a --bus-of MasterIns=local:b", quick())),
      "--bus-of 'MasterIns=local:b': MasterIns has a bus already, expected each node once");
}

TEST(BadBuses, AWireWithADataPhaseSlowerThanTheRest) {
  const auto run = [](const std::string& settings) {
    return hil_bench(fmt::format("run {} --bus 'in-process?{}'", quick(), settings));
  };
  expect_one_line(run("bitrate=500000&data-bitrate=100000"),
                  "data-bitrate=100000 is slower than bitrate=500000, expected at least that");
  expect_one_line(run("bitrate=500000&"), "'' is not understood, expected bitrate=1000..1000000");
  expect_one_line(
      hil_bench("schedulability " SOURCE_DIR "/dbc/canhil.dbc --bitrate 500000 --data-bitrate 100000"),
      "canhil.dbc: data phase at 100000 bit/s, expected at least the bit rate, 500000");
}

}  // namespace
}  // namespace canhil::test
