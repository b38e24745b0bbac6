// The provenance of a run (who ran what, where, and with which files) is the same in JSON, JUnit, page and
// text.
#include "bench/report/provenance.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/report/page.hpp"
#include "dbc/version/version.hpp"
#include "tests/unit/bench/report/finished_run.hpp"

namespace canhil::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// A run on a USB adapter against a program with a file among its arguments.
drive::Run signed_run() {
  drive::Run run = run_of();
  run.options.targets = {"python3 mine.py"};
  run.options.operator_name = "Ada <Lovelace>";
  run.seen.target_version = "0.7";
  run.adapters = {{.bus = "can0",
                   .kind = "usb",
                   .driver = "gs_usb",
                   .address = "1-4:1.0",
                   .vendor_id = "1d50",
                   .product_id = "606f",
                   .product = "candleLight",
                   .serial = "0042",
                   .usb_mbitps = 12}};
  run.files = {{"target", "/usr/bin/python3", {.sha256 = "ab01", .bytes = 1234, .modified_s = 86'400}},
               {"target argument", "mine.py", {.sha256 = "cd02", .bytes = 5, .modified_s = 86'400}},
               {"DBC", "canhil.dbc (built in)", {.sha256 = "ef03"}}};
  return run;
}

TEST(Provenance, SaysWhatWasTested) {
  const auto provenance = document(scenario_of(), signed_run()).at("provenance");
  EXPECT_EQ(provenance.at("target").dump(), R"({"program":"python3 mine.py","version":"0.7"})");
  EXPECT_EQ(provenance.at("version"), version_text());
  EXPECT_EQ(provenance.at("operator"), "Ada <Lovelace>");
  EXPECT_EQ(provenance.at("adapters").dump(),
            R"([{"bus":"can0","kind":"usb","driver":"gs_usb","address":"1-4:1.0","vendor_id":"1d50",)"
            R"("product_id":"606f","product":"candleLight","serial":"0042","usb_mbitps":12.0}])");
  EXPECT_EQ(
      provenance.at("files").at(1).dump(),
      R"({"role":"target argument","name":"mine.py","sha256":"cd02","bytes":5,"date":"1970-01-02T00:00:00Z"})");
  const auto& dbc = provenance.at("files").at(2);
  EXPECT_EQ(dbc.at("name"), "canhil.dbc (built in)");
  EXPECT_FALSE(dbc.contains("bytes") || dbc.contains("date"));
}

TEST(Provenance, IsTheSameInEveryForm) {
  const drive::Run run = signed_run();
  const std::string page = html(document(scenario_of(), run)).value();
  EXPECT_THAT(page, HasSubstr(">files: target argument: sha256</td><td data-label=\"value\">cd02<"));
  EXPECT_THAT(page, HasSubstr(">adapters: can0: serial</td><td data-label=\"value\">0042<"));
  EXPECT_THAT(page, HasSubstr(">operator</td><td data-label=\"value\">Ada &lt;Lovelace&gt;<"));
  const std::string xml = junit(scenario_of(), run);
  EXPECT_THAT(xml, HasSubstr("<property name=\"operator\" value=\"Ada &lt;Lovelace&gt;\"/>"));
  EXPECT_THAT(xml, HasSubstr("<property name=\"target_version\" value=\"0.7\"/>"));
  EXPECT_THAT(xml, HasSubstr("<property name=\"adapter\" value=\"can0: usb, gs_usb at 1-4:1.0, 1d50:606f "
                             "'candleLight', serial 0042\"/>"));
  EXPECT_THAT(xml, HasSubstr("<property name=\"sha256 of target\" value=\"ab01  /usr/bin/python3\"/>"));
  const std::string words = text(scenario_of(), run);
  EXPECT_THAT(words, HasSubstr(" · target 0.7 · operator Ada <Lovelace>\n"));
  EXPECT_THAT(words,
              HasSubstr("adapter can0: usb, gs_usb at 1-4:1.0, 1d50:606f 'candleLight', serial 0042\n"));
}

TEST(Provenance, OfNobodyAndNowhere) {
  drive::Run run = run_of();
  const auto provenance = [&] { return document(scenario_of(), run).at("provenance"); };
  EXPECT_EQ(provenance().at("target").dump(), R"({"program":"runs elsewhere"})");
  EXPECT_FALSE(provenance().contains("operator"));
  EXPECT_THAT(junit(scenario_of(), run), Not(HasSubstr("operator")));
  run.in_process = true;
  EXPECT_EQ(provenance().at("target").dump(), R"({"program":"in hil-bench itself"})");
}

TEST(Provenance, FindsTheCpuModel) {
  EXPECT_EQ(cpu_model("processor\t: 0\nmodel\t\t: 106\nmodel name\t: Some CPU @ 2 GHz\nflags: x\n"),
            "Some CPU @ 2 GHz");
  EXPECT_EQ(cpu_model("processor : 0\n"), "unknown");
  EXPECT_EQ(date_utc(0), "unknown");
  EXPECT_EQ(date_utc(86'400), "1970-01-02T00:00:00Z");
}

}  // namespace
}  // namespace canhil::report
