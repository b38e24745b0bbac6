#include "bench/accept/suite.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/drive/contract.hpp"
#include "bench/observe/values.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/files/text_file.hpp"
#include "messages/canhil.hpp"

namespace canhil::accept {
namespace {

namespace fs = std::filesystem;
using scenario::Limits;
using scenario::Section;
using scenario::Setting;

constexpr std::int64_t most_rows = 1000;

/// The name of the suite for a target that runs several estimators at once.
constexpr std::string_view several = "several";

// Reads one suite.toml and the scenarios that it names.
class Reader {
 public:
  Reader(fs::path folder, std::string_view text)
      : file_((folder / "suite.toml").string()), root_(Section::parse(text, file_)) {
    suite_.folder = std::move(folder);
  }

  Result<Suite> read() {
    suite_.title = root_.text("title");
    suite_.estimator = root_.text("estimator");
    const auto& known = drive::contract().estimators;
    alone_ = std::ranges::find(known, suite_.estimator) != known.end();
    if (!alone_ && suite_.estimator != several && !root_.error())
      root_.reject("estimator", fmt::format("'{}' is unknown", suite_.estimator),
                   fmt::format("one of: {}, {}", fmt::join(known, ", "), several));
    for (Section& section : root_.tables("requirement")) read_requirement(section);
    for (Section& section : tables("flight")) read_flight(section);
    for (Section& section : tables("parameter")) read_parameter(section);
    for (Section& section : tables("campaign")) {
      suite_.campaigns.push_back(section.text("file"));
      section.finish();
    }
    if (auto apply = root_.optional_table("apply")) {
      const std::string parameter = apply->one_of("parameter", drive::contract().parameters);
      suite_.apply.emplace(parameter, apply->plain_number("value", {}));
      apply->finish();
    }
    if (root_.has("dialogue")) suite_.dialogue = scenario(root_, "dialogue", {});
    root_.optional("dialogue");
    for (const char* key : {"parameter", "apply"}) {
      if (!suite_.dialogue) root_.refuse(key, "is given without 'dialogue'", "both");
    }
    root_.finish();
    if (const auto error = root_.error()) return tl::unexpected(*error);
    if (error_) return tl::unexpected(*error_);
    return std::move(suite_);
  }

 private:
  std::vector<Section> tables(std::string_view key) {
    if (root_.has(key)) return root_.tables(key);
    root_.optional(key);
    return {};
  }

  void read_requirement(Section& section) {
    Requirement requirement{
        .id = section.text("id"), .family = section.one_of("family", families), .text = section.text("text")};
    if (suite_.find(requirement.id) != nullptr)
      section.reject("id", fmt::format("'{}' is given twice", requirement.id), "each once");
    suite_.requirements.push_back(std::move(requirement));
    section.finish();
  }

  std::string requirement(Section& section, std::string_view key) {
    std::string id = section.text(key);
    if (section.has(key) && suite_.find(id) == nullptr && !section.error())
      section.reject(key, fmt::format("'{}' is not a requirement of this suite", id), "the id of one above");
    return id;
  }

  const Flight* flight(Section& section, std::string_view key) {
    const std::string name = section.text(key);
    const auto found = std::ranges::find(suite_.flights, name, &Flight::name);
    if (found != suite_.flights.end()) return &*found;
    if (section.has(key) && !section.error())
      section.reject(key, fmt::format("'{}' is not the name of an earlier flight", name), "the name of one");
    return nullptr;
  }

  scenario::Scenario scenario(Section& section, std::string_view key, const std::vector<Setting>& settings) {
    const std::string name = section.text(key);
    if (section.error()) return {};
    const auto refused = [&](const Error& error) {
      if (!error_) error_ = Error{fmt::format("{}: {}", section.where(key), error.message)};
    };
    const auto text = read_text_file(suite_.folder / name, "a scenario file", scenario::most_toml_bytes);
    if (!text) {
      refused(text.error());
      return {};
    }
    auto read = scenario::parse(*text, name, drive::contract(), settings);
    if (!read) {
      refused(read.error());
      return {};
    }
    if (alone_ && std::ranges::find(read->targets, suite_.estimator, &scenario::TargetSetup::estimator) ==
                      read->targets.end())
      section.reject(key, fmt::format("{} has no estimator {}", name, suite_.estimator),
                     "a scenario of the suite's estimator");
    return std::move(*read);
  }

  void read_flight(Section& section) {
    Flight flight{.name = section.text("name")};
    if (std::ranges::find(suite_.flights, flight.name, &Flight::name) != suite_.flights.end())
      section.reject("name", fmt::format("'{}' is given twice", flight.name), "each once");
    std::vector<Setting> settings;
    if (auto set = section.optional_table("set")) settings = set->settings();
    flight.scenario = scenario(section, "scenario", settings);
    flight.requirement = requirement(section, "requirement");
    if (section.has("reference")) flight.reference = requirement(section, "reference");
    section.optional("reference");
    flight.rows = static_cast<std::size_t>(section.optional_integer("rows", 1).value_or(12));
    if (flight.rows > most_rows) section.reject("rows", "are too many", fmt::format("at most {}", most_rows));
    if (auto same = section.optional_table("same_as")) {
      const Flight* other = this->flight(*same, "flight");
      flight.same_as = SameAs{.flight = other == nullptr ? "" : other->name,
                              .requirement = requirement(*same, "requirement"),
                              .steps = same->plain_number("steps", Limits::at_least(0), 0),
                              .relative = same->plain_number("relative", Limits::at_least(0), 0)};
      same->finish();
    }
    if (section.has("moves")) read_moves(section, flight);
    for (const char* key : {"beside", "response"}) {
      if (!section.has("moves")) section.refuse(key, "is given without 'moves'", "both");
    }
    section.optional("moves");
    flight.real_time = section.flag("real_time");
    flight.faults = section.flag("faults");
    section.finish();
    suite_.flights.push_back(std::move(flight));
  }

  /// Whether `name` has the form "Message.signal" and names a signal that a target with this estimator sends.
  [[nodiscard]] bool answered(std::string_view name) const {
    const std::size_t dot = std::min(name.find('.'), name.size());
    const auto message = std::ranges::find(messages::all_messages, name.substr(0, dot), &MessageInfo::name);
    if (message == messages::all_messages.end() || !is_targets(*message) || dot == name.size()) return false;
    const auto& sent_by = drive::contract().sent_by;
    const auto sender = sent_by.find(message->name);
    const bool of_another = sender != sent_by.end() && alone_ && sender->second != suite_.estimator;
    return !of_another && observe::signal_of(*message, name.substr(dot + 1)) != nullptr;
  }

  void read_moves(Section& section, Flight& flight) {
    const Flight* other = this->flight(section, "beside");
    const std::string response =
        section.has("response") ? requirement(section, "response") : flight.requirement;
    for (Section& moves : section.table_or_tables("moves")) {
      Move move = read_move(moves);
      if (other != nullptr) move.flight = other->name;
      move.requirement = response;
      flight.moves.push_back(std::move(move));
    }
  }

  [[nodiscard]] Move read_move(Section& section) const {
    const std::string signal = section.text("signal");
    const std::size_t dot = signal.find('.');
    if (section.has("signal") && !answered(signal) && !section.error())
      section.reject("signal", fmt::format("'{}' is in no message that {} sends", signal, suite_.estimator),
                     "Message.signal of an answer");
    Move move{.message = signal.substr(0, dot),
              .signal = dot == std::string::npos ? "" : signal.substr(dot + 1)};
    for (const char* key : {"to", "by", "first_at_s"}) section.optional(key);
    if (section.has("first_at_s")) {
      move.first_at_s = section.plain_number("first_at_s", Limits::at_least(0));
      for (const char* other : {"by", "to"})
        section.refuse(other, "is given beside 'first_at_s'", "one of them");
    } else if (section.has("by")) {
      move.by = section.interval("by", {});
      section.refuse("to", "is given beside 'by'", "one of them");
    } else if (!section.has("to")) {
      section.missing("to", "\"more\", \"less\", or in its place 'by': an array [low, high], or first_at_s");
    } else
      move.up = section.one_of("to", std::vector<std::string>{"more", "less"}) == "more";
    section.finish();
    return move;
  }

  void read_parameter(Section& section) {
    Parameter parameter{.name = section.one_of("name", drive::contract().parameters)};
    parameter.least = section.plain_number("least", {});
    parameter.most = section.plain_number("most", {});
    if (parameter.most < parameter.least)
      section.reject("most", fmt::format("is {:g}", parameter.most),
                     fmt::format("at least {:g}, the value of 'least'", parameter.least));
    parameter.whole = section.flag("whole");
    parameter.in_flight = section.flag("in_flight");
    section.finish();
    suite_.parameters.push_back(std::move(parameter));
  }

  std::string file_;
  Section root_;
  Suite suite_;
  bool alone_ = false;          // the suite is for one estimator, not for several
  std::optional<Error> error_;  // the first error in a file that the suite names
};

}  // namespace

const Requirement* Suite::find(std::string_view id) const {
  const auto found = std::ranges::find(requirements, id, &Requirement::id);
  return found == requirements.end() ? nullptr : &*found;
}

Result<Suite> read_suite(const fs::path& folder) {
  const auto text = read_text_file(folder / "suite.toml", "a suite", scenario::most_toml_bytes);
  if (!text) return tl::unexpected(text.error());
  return Reader(folder, *text).read();
}

Result<std::vector<fs::path>> suites_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (fs::exists(entry.path() / "suite.toml", error)) found.push_back(entry.path());
  }
  std::ranges::sort(found);
  if (found.empty())
    return failure(fmt::format("{}: has no suites, expected folders with suite.toml", folder.string()));
  return found;
}

}  // namespace canhil::accept
