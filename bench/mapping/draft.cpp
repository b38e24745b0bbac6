#include "bench/mapping/draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "bench/mapping/guess.hpp"
#include "bench/mapping/reading.hpp"
#include "bench/scenario/setting.hpp"

namespace canhil::mapping {
namespace {

bool receives(const dbc::Message& message, std::string_view node) {
  return std::ranges::any_of(message.signals, [&](const dbc::Signal& one) {
    return std::ranges::find(one.receivers, node) != one.receivers.end();
  });
}

std::string commented(std::string_view text) {
  std::string all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    all += end == 0                ? "\n"
           : text.starts_with('#') ? fmt::format("{}\n", text.substr(0, end))
                                   : fmt::format("# {}\n", text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

// A line for a signal: what it carries, or a comment with its unit.
std::string line_of(const std::string& key, const dbc::Signal& signal, const std::string& quantity,
                    std::set<std::string>& used) {
  const bool first = !quantity.empty() && used.insert(quantity).second;
  const std::string unit = signal.unit.empty() ? "" : fmt::format(" [{}]", signal.unit);
  if (first) return fmt::format("{} = \"{}\" {}{}\n", key, quantity, unit.empty() ? "" : " #", unit);
  const char* what = is_counter(signal)    ? "a counter: [[protection]] below, or `echo`"
                     : is_checksum(signal) ? "a checksum: [[protection]] below"
                                           : "which quantity?";
  return fmt::format("# {} = \"\" #{} {}\n", key, unit, what);
}

std::string play_of(const dbc::Message& message, std::set<std::string>& used) {
  std::string text = fmt::format("\n[[play]]\nmessages = [\"{}\"]\n", message.name);
  if (message.cycle_time_us == 0) text += "every_ms = 10 # the DBC has no cycle time\n";
  text += "[play.signals]\n";
  const std::size_t before = used.size();
  for (const dbc::Signal& signal : message.signals)
    text += line_of(fmt::format("\"{}.{}\"", message.name, signal.name), signal,
                    guess_played(message, signal), used);
  if (is_multiplexed(message))
    return "\n# Is multiplexed: see 'Formats' in docs/mapping.md." + commented(text);
  return used.size() > before ? text : commented(text);
}

std::string hear_of(const dbc::Message& message, std::set<std::string>& used) {
  std::string text = fmt::format(
      "\n[[hear]]\nmessage = \"{}\"\n# answers = \"\" # the play that it answers, if it is no message of a "
      "task of its own\n"
      "# echo = {{ signal = \"\", of = \"\" }} # the counter or time of the sample that it "
      "repeats\n[hear.signals]\n",
      message.name);
  for (const dbc::Signal& signal : message.signals)
    text += line_of(signal.name, signal, guess_reported(message, signal), used);
  return text;
}

std::string protection_of(const dbc::Message& message) {
  const auto counter = std::ranges::find_if(message.signals, is_counter);
  const auto checksum = std::ranges::find_if(message.signals, is_checksum);
  const bool has_checksum = checksum != message.signals.end();
  if (counter == message.signals.end() && !has_checksum) return "";
  std::string text = fmt::format("\n[[protection]]\nmessages = [\"{}\"]\n", message.name);
  if (counter != message.signals.end())
    text += fmt::format("counter = {{ signal = \"{}\" }}\n", counter->name);
  if (has_checksum)
    text += fmt::format("checksum = {{ signal = \"{}\", model = \"CRC-8/SAE-J1850\" }}\n", checksum->name);
  // A counter may be of anything, and no DBC tells how a checksum is computed.
  return commented(text);
}

// The key of the limit of an error, with a value to begin with; empty: no limit is known.
std::string limit_of(std::string_view si) {
  return si == "rad"     ? "below_deg = 5"
         : si == "rad/s" ? "below_degps = 1"
         : si == "m"     ? "below_m = 20"
         : si == "m/s"   ? "below_mps = 1"
                         : "";
}

std::string sensor_of(const sensors::Kind& sensor, std::int64_t period_us) {
  const double period_ms = 1e-3 * static_cast<double>(period_us);
  if (sensor.of == nullptr)
    return fmt::format("\n[{}] # without errors; docs/scenario-reference.md has the keys\nperiod_ms = {:g}\n",
                       sensor.key, period_ms);
  std::string text = fmt::format("\n[[sensor]]\nname = \"{}\"\nkind = \"{}\"\nperiod_ms = {:g}\n", sensor.key,
                                 sensor.of->key, period_ms);
  if (!sensor.of->only_named) return text;
  for (const sensors::Output& output : sensor.outputs.values)
    text += fmt::format("[sensor.values.{}]\ntruth = \"0\" # an expression of true values: docs/mapping.md\n",
                        output.name);
  return text;
}

// The line that an error names; 0: none.
std::size_t line_in(std::string_view message) {
  const std::size_t colon = message.find(": ");
  const std::string_view place = message.substr(0, colon);
  const std::string_view number = place.substr(place.rfind(':') + 1);
  std::size_t line = 0;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), line);
  return read.ptr == number.data() + number.size() ? line : 0;
}

}  // namespace

Blocks draft_of_mapping(const dbc::Database& database, std::string_view device, const std::string& dbc) {
  Blocks blocks{
      fmt::format("# A draft: names and units told which signal carries what. Check every line, above all "
                  "the signs: the bench has\n"
                  "# the axes forward, right, down and north, east, down; a minus before a quantity turns "
                  "its sign. docs/mapping.md\n"
                  "# explains the keys; hil-bench dbc check lists what is left out.\ndbc = {}\n",
                  scenario::toml_string(dbc))};
  std::set<std::string> played, reported;
  for (const dbc::Message& message : database.messages) {
    if (message.sender != device && receives(message, device)) blocks.push_back(play_of(message, played));
  }
  for (const dbc::Message& message : database.messages) {
    if (message.sender == device) blocks.push_back(hear_of(message, reported));
  }
  for (const dbc::Message& message : database.messages) {
    if (message.sender == device || receives(message, device)) blocks.push_back(protection_of(message));
  }
  return blocks;
}

Blocks draft_of_scenario(const Mapping& mapping, const std::string& file) {
  Blocks blocks{fmt::format(
      "# A draft: a flight with turns, sensors without errors, and a check for each quantity. "
      "docs/scenarios.md explains\n"
      "# the keys.\ntitle = {}\nduration_s = 20.0\nseed = 1\n\n[target]\nmapping = "
      "{}\n\n[truth]\nlatitude_deg = 48.0\n"
      "longitude_deg = 11.0\nheight_m = 500.0\ntrajectory = \"s_path\"\nspeed_mps = "
      "15.0\nheading_deg = 45.0\n"
      "heading_amplitude_deg = 30\nturn_period_s = 10.0\n",
      scenario::toml_string("Draft: " + mapping.targets.front().name), scenario::toml_string(file))};
  std::vector<const sensors::Kind*> written;
  for (const Play& play : mapping.plays) {
    std::vector<const sensors::Kind*> needed{play.sensor};
    for (const PlayedMessage& message : play.messages) {
      for (const Source& source : message.sources)
        needed.push_back(source.measurand == nullptr ? nullptr : source.measurand->sensor);
    }
    for (const sensors::Kind* sensor : needed) {
      if (sensor == nullptr || std::ranges::find(written, sensor) != written.end()) continue;
      written.push_back(sensor);
      std::int64_t period_us = play.period_us;
      for (const Play& other : mapping.plays) {
        if (other.sensor == sensor) period_us = std::min(period_us, other.period_us);
      }
      blocks.push_back(sensor_of(*sensor, period_us));
    }
  }
  // Tables of the file's own come before arrays of tables only for the reader's eye; TOML does not mind.
  std::stable_partition(blocks.begin() + 1, blocks.end(),
                        [](const std::string& one) { return !one.starts_with("\n[["); });
  for (const quantities::Quantity* quantity : mapping.targets.front().quantities) {
    const ReferenceQuantity* reference = find_reference_quantity(quantity->name);
    const std::string limit = reference == nullptr || !reference->has_truth() ? "" : limit_of(reference->si);
    if (limit.empty()) continue;
    // The bench derives the horizontal error from latitude and longitude.
    const bool ground = is_on_the_ground(*reference);
    const std::string block =
        fmt::format("\n[[check]]\nkind = \"error\"\nquantity = \"{}\"\nfrom_s = 5\n{}\n",
                    ground ? "position.horizontal" : quantity->name, ground ? "below_m = 20" : limit);
    if (std::ranges::find(blocks, block) == blocks.end()) blocks.push_back(block);
  }
  blocks.emplace_back("\n[[check]]\nkind = \"bus_load\"\nbitrate_kbitps = 500\nbelow_percent = 60\n");
  return blocks;
}

Draft joined(Blocks blocks, const std::function<std::optional<Error>(const std::string& text)>& read) {
  for (;;) {
    std::string text;
    for (const std::string& block : blocks) text += block;
    auto error = read(text);
    if (!error) return {.text = std::move(text)};
    std::size_t line = line_in(error->message), lines = 0;
    const auto wrong = std::ranges::find_if(blocks, [&](const std::string& block) {
      lines += static_cast<std::size_t>(std::ranges::count(block, '\n'));
      return line <= lines;
    });
    const std::string without = wrong == blocks.end() ? "" : commented(*wrong);
    if (line == 0 || wrong == blocks.begin() || wrong == blocks.end() || without == *wrong)
      return {.text = std::move(text), .error = std::move(error)};
    *wrong = fmt::format("\n# {}{}", error->message.substr(error->message.find(": ") + 2), without);
  }
}

}  // namespace canhil::mapping
