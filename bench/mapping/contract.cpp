#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>

#include "bench/estimators/vocabulary.hpp"
#include "bench/mapping/mapping.hpp"
#include "bench/mapping/player.hpp"
#include "bench/scenario/scenario.hpp"
#include "bench/scenario/section.hpp"
#include "dbc/files/text_file.hpp"
#include "dbc/parser/codec.hpp"

namespace canhil::mapping {
namespace {

namespace fs = std::filesystem;
using scenario::Section;

constexpr std::size_t most_bytes = std::size_t{16} << 20U;

}  // namespace

Result<std::string> read_from_disk(const std::string& file) {
  return read_text_file(file, "a file of a mapping", most_bytes);
}

std::shared_ptr<const protection::Protection> Mapping::protection_of(const MessageInfo& message) const {
  const auto index = static_cast<std::size_t>(&message - messages.data());
  for (const Play& play : plays) {
    for (const PlayedMessage& one : play.messages) {
      if (one.of.index == index && one.of.protection)
        return std::make_shared<const protection::Protection>(*one.of.protection);
    }
  }
  return nullptr;
}

bool Mapping::is_played(const MessageInfo& message, std::span<const scenario::NodeSettings> /*nodes*/) const {
  return !is_targets(message);
}

Mapping::Carried Mapping::carried(const sensors::Kind& sensor) const {
  Carried all{.samples = false, .times = false, .intervals = false, .values = 0, .flags = 0};
  for (const Play& play : plays) {
    const bool triggers = play.sensor != nullptr && play.sensor->key == sensor.key;
    if (triggers) all.samples = true;
    for (const PlayedMessage& message : play.messages) {
      for (const Source& source : message.sources) {
        if (source.measurand == nullptr) {
          if (triggers && source.time) all.times = true;
          if (triggers && source.invalid) all.flags = ~std::uint32_t{0};
          continue;
        }
        if (source.measurand->sensor->key != sensor.key) continue;
        all.samples = true;
        all.values |= std::uint64_t{1} << source.measurand->index;
        if (source.measurand->over == sensors::Over::rate) all.intervals = true;
        if (source.invalid) all.flags |= source.measurand->output().flags;
      }
    }
  }
  return all;
}

std::vector<const dbc::Database*> Mapping::databases() const {
  std::vector<const dbc::Database*> all;
  for (const MappedTarget& target : targets) all.push_back(&target.database);
  return all;
}

std::string_view Mapping::sender_of(const MessageInfo& message) const {
  return sent_by[static_cast<std::size_t>(&message - messages.data())];
}

std::string_view Mapping::estimator_of(const MessageInfo& message) const {
  const auto index = static_cast<std::size_t>(&message - messages.data());
  const auto hear = std::ranges::find(hears, index, [](const Hear& one) { return one.of.index; });
  return hear == hears.end() ? std::string_view() : targets[hear->target].name;
}

Result<std::vector<std::uint8_t>> Mapping::encoded(
    std::size_t channel, std::span<const std::pair<std::string, double>> values) const {
  const EventChannel& of = event_channels[channel];
  if (of.transport != EventChannel::Transport::frame)
    return failure("are for a channel that sends one frame, and this one has a transport protocol");
  std::vector<dbc::NamedValue> named;
  for (const auto& [name, value] : values) {
    const dbc::Signal* signal = dbc::find_signal(*of.request.message, name);
    if (signal != nullptr && !dbc::holds(*signal, value))
      return failure(fmt::format("are wrong: {:g} does not fit into {}", value, name));
    named.push_back({name, value});
  }
  return dbc::encode(*of.request.message, named);
}

bool Mapping::is_of_events(const MessageInfo& message) const {
  const auto index = static_cast<std::size_t>(&message - messages.data());
  return std::ranges::any_of(event_channels, [&](const EventChannel& one) {
    return one.request.index == index || (one.response && one.response->index == index);
  });
}

Result<void> Mapping::fits(const scenario::Scenario& scenario, const world::FlightRecord& /*flight*/) const {
  return Player::check(*this, scenario);
}

Frame Mapped::frame(std::span<const std::uint8_t> bytes) const {
  Frame frame{.id = message->id,
              .size = static_cast<std::uint8_t>(bytes.size()),
              .extended = message->extended,
              .fd = message->fd,
              .brs = message->fd};
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}

Places::Places(const Mapping& mapping)
    : by_id_(mapping.messages), by_group_(mapping.by_group), hears_(mapping.messages.size()) {
  for (std::size_t index = 0; index < hears_.size(); ++index) {
    const MessageInfo& info = mapping.messages[index];
    for (std::size_t i = 0; i < mapping.hears.size(); ++i) {
      const dbc::Message& heard = *mapping.hears[i].of.message;
      if (heard.id == info.id && heard.extended == info.extended) hears_[index].push_back(i);
    }
  }
  for (std::size_t i = 0; i < mapping.hears.size(); ++i) {
    const Mapped& heard = mapping.hears[i].of;
    index_of_.push_back(heard.index);
    if (!heard.message->j1939_transport()) continue;
    const bool any = by_group_.contains(wire::j1939_group(heard.message->id));
    (any ? from_any_ : from_[wire::j1939_source(heard.message->id)]).push_back(i);
  }
  for (auto& [source, all] : from_) all.insert(all.end(), from_any_.begin(), from_any_.end());
}

const quantities::Layout* find_layout(std::string_view columns) {
  struct Own {
    std::vector<const quantities::Quantity*> reported;
    quantities::Layout layout;
  };
  static std::mutex mutex;
  static std::map<std::string, Own, std::less<>> known;
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(columns); found != known.end()) return &found->second.layout;
  Own own;
  for (std::string_view rest = columns; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    const ReferenceQuantity* one = find_reference_quantity(rest.substr(0, end));
    if (one == nullptr) return nullptr;
    own.reported.push_back(one->quantity);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  Own& kept = known.emplace(columns, std::move(own)).first->second;
  kept.layout = {.kept = kept.reported};
  return &kept.layout;
}

Result<scenario::DbcVocabulary> contract_of(std::string_view text, const std::string& file,
                                            const scenario::DbcVocabulary& own, const ReadText& read,
                                            std::span<const scenario::Setting> settings) {
  Section root = Section::parse(text, file, settings);
  if (root.error() || !root.has("target")) return own;
  std::vector<std::string> files;
  for (Section& target : root.table_or_tables("target")) {
    if (!target.has("mapping")) continue;
    const std::string name = target.text("mapping");
    if (name.empty()) target.finish();
    if (const auto error = root.error()) return tl::unexpected(*error);
    files.push_back((fs::path(file).parent_path() / name).string());
  }
  if (files.empty()) return own;
  auto mappings = read_mappings(files, read);
  if (!mappings) return tl::unexpected(mappings.error());
  return estimators::bound_to(own, std::move(*mappings));
}

}  // namespace canhil::mapping
