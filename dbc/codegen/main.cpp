// dbcgen: converts a DBC file to C++, C99, Python, JSON or CAN FD, and prints tables about it.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string_view>

#include "dbc/codegen/fd.hpp"
#include "dbc/codegen/generate.hpp"
#include "dbc/codegen/json.hpp"
#include "dbc/codegen/kit.hpp"
#include "dbc/codegen/load.hpp"
#include "dbc/codegen/rules.hpp"
#include "dbc/command_line/command_line.hpp"
#include "dbc/files/command_files.hpp"
#include "dbc/files/output_file.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/text/escape.hpp"
#include "dbc/version/version.hpp"

namespace {

struct Options {
  std::string dbc;
  std::string output;
  std::string name_space = "messages";
  std::string source;
  std::string include;
  bool quantisation = false;
  bool load = false;
  bool json = false;
  bool fd = false;
  bool fd_header = false;
  bool c = false;
  bool python = false;
};

int complain(const std::string& line) {
  fmt::print(stderr, "{}\n", canhil::one_line(line));
  return 2;
}

int print(const std::string& text) {
  const bool taken = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (taken && std::fflush(stdout) == 0) return 0;
  return complain(fmt::format("dbcgen: standard output: cannot be written: {}", std::strerror(errno)));
}

canhil::Result<std::string> text_for(const canhil::dbc::Database& database, const Options& options) {
  const std::string name = std::filesystem::path(options.dbc).filename().string();
  if (options.fd) return canhil::dbc::fd_text(database, name);
  if (options.fd_header) return canhil::dbc::fd_header(database, options.name_space, name);
  if (options.c) return canhil::dbc::c_header(database, name);
  if (options.python) return canhil::dbc::python_module(database, name);
  return canhil::dbc::generate_header(database, options.name_space, name);
}

bool holds(const std::string& path, const std::string& text) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown))
    return false;  // the content of a device might have no end
  std::ifstream file(path, std::ios::binary);
  return file && std::string{std::istreambuf_iterator<char>(file), {}} == text;
}

// Writes `text` to a file. If the file already has this content, the function does not write the file. So the
// file keeps its modification time, and sources that include it are not recompiled.
int write_file(const std::string& path, const std::string& text) {
  if (holds(path, text)) return 0;
  const auto written = canhil::check_writable(path).and_then([&] { return canhil::write_file(path, text); });
  return written ? 0 : complain("dbcgen: " + written.error().message);
}

int write(const canhil::dbc::Database& database, const Options& options) {
  const auto text = text_for(database, options);
  if (!text) return complain(text.error().message);
  if (!options.source.empty()) {
    const std::string name = std::filesystem::path(options.dbc).filename().string();
    const int code = write_file(
        options.source, canhil::dbc::generate_source(database, options.name_space, name, options.include));
    if (code != 0) return code;
  }
  return options.output.empty() ? print(*text) : write_file(options.output, *text);
}

// True for a C++ namespace: one or more identifiers separated by '::', such as messages::fd.
bool is_namespace(std::string_view name) {
  static const std::regex parts("[A-Za-z_][A-Za-z0-9_]*(::[A-Za-z_][A-Za-z0-9_]*)*");
  return std::regex_match(name.begin(), name.end(), parts);
}

// Returns why the options are rejected; an empty string: they are accepted.
std::string refused(const Options& options) {
  canhil::CommandFiles files;
  files.reads("DBC", options.dbc);
  files.writes_file("--output", options.output);
  files.writes_file("--source", options.source);
  if (const auto distinct = files.check_distinct(); !distinct) return distinct.error().message;
  if (!is_namespace(options.name_space))
    return fmt::format("--namespace: '{}' is not a valid C++ namespace", options.name_space);
  const int asked = options.quantisation + options.load + options.json + options.fd + options.fd_header +
                    options.c + options.python;
  if (asked > 1) return "expected one of --quantisation, --load, --json, --fd, --fd-header, --c and --python";
  return {};
}

int run(int argc, char** argv) {
  Options options;
  canhil::command_line::Program program{"Turns a DBC file into a C++ header of constexpr codecs.",
                                        canhil::version_line("dbcgen")};
  program.add_option("dbc", options.dbc, "the DBC file").required();
  program.add_option("-o,--output", options.output, "the file to write; standard output if not given");
  program.add_option("-n,--namespace", options.name_space, "namespace of the header");
  program.add_option("--source", options.source,
                     "also write the definitions that the header declares, to this file");
  program.add_option("--include", options.include, "the path by which that file includes the header");
  program.add_flag("--quantisation", options.quantisation,
                   "print the resolution of every measurement relative to its sensor's noise");
  program.add_flag("--load", options.load, "print the worst-case bus load of every sender");
  program.add_flag("--json", options.json, "print the database as JSON");
  program.add_flag("--fd", options.fd,
                   "write the same contract for CAN FD, one frame a sample group, as a DBC file");
  program.add_flag("--fd-header", options.fd_header,
                   "write the layout of the CAN FD containers as a C++ header");
  program.add_flag("--c", options.c, "write the contract as a C99 header, for docs/examples/kit");
  program.add_flag("--python", options.python,
                   "write the contract as a Python module, for docs/examples/kit");
  program.refuse_no_values();
  const auto parsed = program.parse(argc, argv);
  if (!parsed) return complain(fmt::format("dbcgen: {}; see dbcgen --help", parsed.error().message));
  if (*parsed) return **parsed;

  if (const std::string why = refused(options); !why.empty())
    return complain(fmt::format("dbcgen: {}; see dbcgen --help", why));

  auto database = canhil::dbc::read_file(options.dbc);
  if (!database) return complain(database.error().message);
  if (database->messages.empty())
    return complain(fmt::format("{}: no messages in the DBC, expected at least one", options.dbc));
  if (options.quantisation) return print(canhil::dbc::quantisation_table(*database));
  if (options.load) return print(canhil::dbc::load_table(*database));
  if (options.json) return print(canhil::dbc::to_json(*database) + "\n");
  return write(*database, options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return canhil::command_line::finish("dbcgen", run(argc, argv));
  } catch (const std::exception& error) {
    return complain(fmt::format("dbcgen: {}", error.what()));
  }
}
