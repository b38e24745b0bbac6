// dbcgen: a DBC file to a C++ header, or to what a person wants to know of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "dbc/codegen/exact.hpp"
#include "dbc/codegen/generate.hpp"
#include "dbc/codegen/json.hpp"
#include "dbc/codegen/load.hpp"
#include "dbc/codegen/rules.hpp"
#include "dbc/parser/parse.hpp"

namespace {

struct Options {
  std::string dbc;
  std::string output;
  std::string name_space = "messages";
  bool exact = false;
  bool quantisation = false;
  bool load = false;
  bool json = false;
};

int complain(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
  return 2;
}

int print(const std::string& text) {
  fmt::print("{}", text);
  return 0;
}

int write_header(const canhil::dbc::Database& database, const Options& options) {
  const auto text = canhil::dbc::generate_header(database, options.name_space,
                                                 std::filesystem::path(options.dbc).filename().string());
  if (!text) return complain(text.error().message);
  if (options.output.empty()) return print(*text);
  std::ofstream file(options.output, std::ios::binary);
  file << *text << std::flush;
  return file
             ? 0
             : complain(fmt::format("{}: cannot be written, expected a path for the header", options.output));
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{"Turns a DBC file into a C++ header of constexpr codecs."};
  app.add_option("dbc", options.dbc, "the DBC file")->required();
  app.add_option("-o,--output", options.output, "the header to write; standard output if not given");
  app.add_option("-n,--namespace", options.name_space, "namespace of the header");
  app.add_flag("--exact", options.exact,
               "carry every scaled signal as a 64-bit float in CAN FD frames: nothing is rounded");
  app.add_flag("--quantisation", options.quantisation,
               "print the resolution of every measurement against its sensor");
  app.add_flag("--load", options.load, "print the worst-case bus load of every sender");
  app.add_flag("--json", options.json, "print the database as JSON");
  CLI11_PARSE(app, argc, argv);

  auto database = canhil::dbc::read_file(options.dbc);
  if (database && options.exact) database = canhil::dbc::exact(*database, options.dbc);
  if (!database) return complain(database.error().message);
  if (options.quantisation) return print(canhil::dbc::quantisation_table(*database));
  if (options.load) return print(canhil::dbc::load_table(*database));
  if (options.json) return print(canhil::dbc::to_json(*database) + "\n");
  return write_header(*database, options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 2;
  }
}
