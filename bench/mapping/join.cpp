#include "bench/mapping/join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bench/mapping/put_together.hpp"
#include "bench/world/hash.hpp"

namespace canhil::mapping {
namespace {

bool have_one_id(const MessageInfo& a, const MessageInfo& b) {
  return a.id == b.id && a.extended == b.extended;
}

bool is_same(const dbc::Signal& a, const dbc::Signal& b) {
  return a.start_bit == b.start_bit && a.length == b.length && a.byte_order == b.byte_order &&
         a.type == b.type && a.scale == b.scale && a.offset == b.offset && a.multiplexor == b.multiplexor &&
         a.mux_ranges == b.mux_ranges;
}

bool is_same(const Source& a, const Source& b) {
  return is_same(*a.signal, *b.signal) && a.measurand == b.measurand && a.time == b.time &&
         a.value == b.value && a.factor == b.factor && a.invalid == b.invalid;
}

bool is_same(const PlayedMessage& a, const PlayedMessage& b) {
  const auto settings = [](const PlayedMessage& one) {
    return one.of.protection ? one.of.protection->settings() : protection::Settings{};
  };
  return a.of.message->size == b.of.message->size && a.of.message->fd == b.of.message->fd &&
         settings(a) == settings(b) &&
         std::ranges::is_permutation(a.sources, b.sources, [](const Source& one, const Source& other) {
           return is_same(one, other);
         });
}

bool is_same(const Play& a, const Play& b) {
  return a.sensor == b.sensor && a.period_us == b.period_us && a.latency_us == b.latency_us &&
         std::ranges::equal(a.messages, b.messages, [](const PlayedMessage& one, const PlayedMessage& other) {
           return one.of.index == other.of.index && is_same(one, other);
         });
}

class Joining {
 public:
  Joining(Mapping& all, Mapping& further)
      : all_(all),
        further_(further),
        target_(all.targets.emplace_back(std::move(further.targets.front()))),
        before_(all.infos.size()) {}

  Result<void> join() {
    for (MessageInfo& info : further_.infos) {
      if (auto placed = place(info); !placed) return placed;
    }
    for (Play& play : further_.plays) {
      if (auto added = add(play); !added) return added;
    }
    for (Hear& hear : further_.hears) {
      hear.of.index = place_of_[hear.of.index];
      hear.target = all_.targets.size() - 1;
      if (hear.answers) hear.answers = play_of_[*hear.answers];
      all_.hears.push_back(std::move(hear));
    }
    for (EventChannel& channel : further_.event_channels) {
      channel.request.index = place_of_[channel.request.index];
      if (channel.response) channel.response->index = place_of_[channel.response->index];
      if (std::ranges::find(all_.event_channels, channel.name, &EventChannel::name) !=
          all_.event_channels.end())
        channel.name = fmt::format("{}.{}", target_.name, channel.name);
      all_.event_channels.push_back(std::move(channel));
    }
    for (const auto& [group, index] : further_.by_group) all_.by_group.emplace(group, place_of_[index]);
    for (const sensors::Kind* one : further_.sensors) {
      if (std::ranges::find(all_.sensors, one) == all_.sensors.end()) all_.sensors.push_back(one);
    }
    std::ranges::move(further_.files, std::back_inserter(all_.files));
    all_.hash = world::fnv1a_64(fmt::format("{:x} {:x}", all_.hash, further_.hash));
    all_.dbc_hash = world::fnv1a_64(fmt::format("{:x} {:x}", all_.dbc_hash, further_.dbc_hash));
    return {};
  }

 private:
  // Finds the place of a message among the messages of all targets. A message that the bench sends to several
  // targets has one place. Messages that several targets send have a place each, even if they have one id.
  Result<void> place(MessageInfo& info) {
    const auto earlier = all_.infos.begin() + static_cast<std::ptrdiff_t>(before_);
    const auto found = std::find_if(all_.infos.begin(), earlier,
                                    [&](const MessageInfo& one) { return have_one_id(one, info); });
    if (found != earlier && is_targets(*found) != is_targets(info))
      return failure(fmt::format("{}: {} is sent by a target and by the bench, expected one of the two",
                                 target_.file, info.name));
    if (found != earlier && !is_targets(info)) {
      place_of_.push_back(static_cast<std::size_t>(found - all_.infos.begin()));
      return {};
    }
    all_.sent_by.push_back(further_.sent_by[place_of_.size()]);
    rename(info);
    place_of_.push_back(all_.infos.size());
    all_.infos.push_back(info);
    return {};
  }

  // Names of messages are unique, because scenarios, reports and logs name messages without their DBC.
  void rename(MessageInfo& info) {
    if (std::ranges::find(all_.infos, info.name, &MessageInfo::name) == all_.infos.end()) return;
    const auto message = std::ranges::find(target_.database.messages, info.name, &dbc::Message::name);
    message->name = fmt::format("{}.{}", target_.name, message->name);
    info.name = message->name;
  }

  Result<void> add(Play& play) {
    for (PlayedMessage& one : play.messages) one.of.index = place_of_[one.of.index];
    const auto same = std::ranges::find_if(all_.plays, [&](const Play& one) { return is_same(one, play); });
    play_of_.push_back(static_cast<std::size_t>(same - all_.plays.begin()));
    if (same != all_.plays.end()) return {};
    for (const PlayedMessage& one : play.messages) {
      if (is_played(one))
        return failure(
            fmt::format("{}: {} is sent to another target with other values or at other times, "
                        "expected the same play in both mappings",
                        target_.file, one.of.message->name));
    }
    play.name = play.messages.back().of.message->name;
    if (std::ranges::find(all_.plays, play.name, &Play::name) != all_.plays.end())
      play.name += " " + page_of(play.messages.back());
    all_.plays.push_back(std::move(play));
    return {};
  }

  // Whether a play of all targets sends a message with this page.
  [[nodiscard]] bool is_played(const PlayedMessage& message) const {
    return std::ranges::any_of(all_.plays, [&](const Play& play) {
      return std::ranges::any_of(play.messages, [&](const PlayedMessage& one) {
        return one.of.index == message.of.index && page_of(one) == page_of(message);
      });
    });
  }

  Mapping& all_;
  Mapping& further_;
  MappedTarget& target_;
  std::size_t before_;                 // number of messages of the targets before
  std::vector<std::size_t> place_of_;  // from the message's index in `further_`
  std::vector<std::size_t> play_of_;   // from the play's index in `further_`
};

}  // namespace

Result<void> join(Mapping& all, Mapping&& further) { return Joining(all, further).join(); }

Result<std::shared_ptr<const Mapping>> read_mappings(std::span<const std::string> files,
                                                     const ReadText& read) {
  std::shared_ptr<Mapping> all;
  for (const std::string& file : files) {
    auto one = read_alone(file, read);
    if (!one) return tl::unexpected(one.error());
    if (all == nullptr)
      all = std::move(*one);
    else if (auto joined = join(*all, std::move(**one)); !joined)
      return tl::unexpected(joined.error());
  }
  if (const auto wrong = put_together(*all)) return failure(*wrong);
  return all;
}

Result<std::shared_ptr<const Mapping>> read_mapping(const std::string& file, const ReadText& read) {
  return read_mappings({&file, 1}, read);
}

}  // namespace canhil::mapping
