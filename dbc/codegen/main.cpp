// dbcgen: a DBC file to a C++ header, or to what a person wants to know of it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "dbc/codegen/generate.hpp"
#include "dbc/codegen/rules.hpp"
#include "dbc/parser/parse.hpp"

namespace {

struct Options {
  std::string dbc;
  std::string output;
  std::string name_space = "messages";
  bool quantisation = false;
};

int complain(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
  return 2;
}

int write_header(const canhil::dbc::Database& database, const Options& options) {
  const auto text = canhil::dbc::generate_header(database, options.name_space,
                                                 std::filesystem::path(options.dbc).filename().string());
  if (!text) return complain(text.error().message);
  if (options.output.empty()) {
    fmt::print("{}", *text);
    return 0;
  }
  std::ofstream file(options.output, std::ios::binary);
  file << *text << std::flush;
  return file
             ? 0
             : complain(fmt::format("{}: cannot be written, expected a path for the header", options.output));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Turns a DBC file into a C++ header of constexpr codecs."};
  app.add_option("dbc", options.dbc, "the DBC file")->required();
  app.add_option("-o,--output", options.output, "the header to write; standard output if not given");
  app.add_option("-n,--namespace", options.name_space, "namespace of the header");
  app.add_flag("--quantisation", options.quantisation,
               "print the resolution of every measurement against its sensor");
  CLI11_PARSE(app, argc, argv);

  const auto database = canhil::dbc::read_file(options.dbc);
  if (!database) return complain(database.error().message);
  if (options.quantisation) {
    fmt::print("{}", canhil::dbc::quantisation_table(*database));
    return 0;
  }
  return write_header(*database, options);
}
