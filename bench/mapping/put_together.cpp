#include "bench/mapping/put_together.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "bench/estimators/los_rate/quantities.hpp"
#include "bench/mapping/points.hpp"

namespace canhil::mapping {
namespace {

// Adds the quantities that the bench derives from those which the target reports.
void add_derived(MappedTarget& target) {
  const auto is_told = [&](const quantities::Quantity* of, ReportedSignal::What what) {
    return std::ranges::any_of(target.hears, [&](const Hear& hear) {
      return std::ranges::any_of(hear.reported_signals, [&](const ReportedSignal& one) {
        return one.quantity->quantity == of && one.what == what;
      });
    });
  };
  for (const ReferenceQuantity& one : reference_quantities()) {
    const auto has_all = [&](ReportedSignal::What what) {
      return std::ranges::all_of(one.of, [&](const auto* part) { return is_told(part, what); });
    };
    if (!one.of.empty() && has_all(ReportedSignal::What::value) &&
        (!one.of_sigmas || has_all(ReportedSignal::What::sigma)))
      target.quantities.push_back(one.quantity);
  }
}

// Whether answers contain both planes of the LOS rate, with which a missile is guided.
bool guides(const MappedTarget& target) {
  const auto is_answered = [&](const quantities::Quantity& plane) {
    const bool reported = std::ranges::find(target.quantities, &plane) != target.quantities.end();
    return reported && hear_of(target, &plane).answers.has_value();
  };
  return is_answered(quantities::los_rate_pitch) && is_answered(quantities::los_rate_yaw);
}

// The message of a play that carries a page which an earlier message carries too; null: there is none.
const PlayedMessage* repeated_page(const Mapping& mapping) {
  std::set<std::pair<std::size_t, std::string>> pages;
  for (const Play& play : mapping.plays) {
    for (const PlayedMessage& one : play.messages) {
      if (!pages.emplace(one.of.index, page_of(one)).second) return &one;
    }
  }
  return nullptr;
}

}  // namespace

std::string page_of(const PlayedMessage& message) {
  std::string page;
  for (const dbc::Signal& signal : message.of.message->signals) {
    if (!signal.multiplexor) continue;
    const auto source = std::ranges::find(message.sources, &signal, &Source::signal);
    page += fmt::format("{}{}={:g}", page.empty() ? "" : " ", signal.name,
                        source == message.sources.end() ? 0 : source->value);
  }
  return page;
}

namespace {

// Lists what a target reports. Error: it reports a quantity twice, or the sigma of a quantity that it does
// not report.
std::optional<std::string> list_quantities(MappedTarget& target) {
  const auto wrong = [&](const std::string& what) { return fmt::format("{}: {}", target.file, what); };
  auto& all = target.quantities;
  std::set<std::string_view> flags;
  for (const Hear& hear : target.hears) {
    for (const ReportedFlag& flag : hear.flags) {
      if (!flags.insert(flag.name).second)
        return wrong(fmt::format("the flag {} is reported twice, expected once", flag.name));
    }
    for (const ReportedSignal& telling : hear.reported_signals) {
      if (telling.what != ReportedSignal::What::value) continue;
      if (std::ranges::find(all, telling.quantity->quantity) != all.end())
        return wrong(fmt::format(
            "{} is reported twice, by {} too, expected once; a second report can be a quantity of your own: "
            "[quantities] \"{}.2\" = {{ unit = \"{}\", truth = \"{}\" }}",
            telling.quantity->quantity->name, hear.of.message->name, telling.quantity->quantity->name,
            telling.quantity->si, telling.quantity->quantity->name));
      all.push_back(telling.quantity->quantity);
    }
  }
  for (const Hear& hear : target.hears) {
    for (const ReportedSignal& telling : hear.reported_signals) {
      for (const ReferenceQuantity* of : {telling.quantity, telling.other}) {
        if (of == nullptr || std::ranges::find(all, of->quantity) != all.end()) continue;
        return wrong(
            fmt::format("{}.{} carries a sigma or correlation of {} without its value, expected both",
                        hear.of.message->name, telling.signal->name, of->quantity->name));
      }
    }
  }
  return std::nullopt;
}

// Presents a target as an estimator.
void present(Mapping& mapping, MappedTarget& target) {
  for (const Hear& hear : target.hears) {
    target.plain_marks.push_back(hear.of.message->name);
    for (const ReportedFlag& flag : hear.flags) {
      if (!flag.is_sign) target.plain_marks.push_back(flag.name);
    }
    if (hear.is_owed()) target.closing.push_back(hear.of.message->name);
  }
  if (mapping.guide == nullptr && guides(target)) mapping.guide = &target;
  add_derived(target);
  target.of_runs = target.quantities;
  if (mapping.guide == &target) target.of_runs.push_back(&quantities::los_rate_both);
  std::string columns;
  for (const quantities::Quantity* one : target.quantities) {
    if (find_reference_quantity(one->name) != nullptr)
      columns += (columns.empty() ? "" : " ") + std::string(one->name);
  }
  target.layout = find_layout(columns);
  target.estimator.emplace(estimator_of(target));
  mapping.presented.push_back(&*target.estimator);
}

}  // namespace

std::optional<std::string> put_together(Mapping& mapping) {
  const auto wrong = [&](const std::string& what) {
    return fmt::format("{}: {}", mapping.targets.back().file, what);
  };
  if (mapping.infos.size() > MessagePlaces::most)
    return wrong(
        fmt::format("{} messages, expected {} at the most", mapping.infos.size(), MessagePlaces::most));
  for (const MessageInfo& info : mapping.infos) {
    if (info.fd != mapping.infos.front().fd)
      return wrong(fmt::format("{} and {} have different formats, expected all CAN FD or all classic",
                               mapping.infos.front().name, info.name));
  }
  if (const PlayedMessage* twice = repeated_page(mapping))
    return wrong(fmt::format("{} has {} in two plays, expected each page once", twice->of.message->name,
                             page_of(*twice)));
  for (const Play& play : mapping.plays) {
    const std::string_view group = mapping.groups.emplace_back(play.name);
    for (const PlayedMessage& one : play.messages) {
      MessageInfo& info = mapping.infos[one.of.index];
      if (info.sample_group.empty())
        info.sample_group = group;  // else the message is a page of several plays
    }
  }
  for (const Hear& hear : mapping.hears) {
    MessageInfo& info = mapping.infos[hear.of.index];
    info.sample_group = hear.of.message->name;
    mapping.answers_by_name = mapping.answers_by_name || (hear.is_owed() && hear.echo);
    if (hear.is_owed()) info.answers = {&mapping.groups[*hear.answers], 1};
    if (hear.task_us > 0) info.cycle_time_us = hear.task_us;
  }
  for (auto next = mapping.hears.cbegin(); MappedTarget & target : mapping.targets) {
    const auto end = std::find_if(next, mapping.hears.cend(),
                                  [&](const Hear& hear) { return &mapping.targets[hear.target] != &target; });
    target.hears = {next, end};
    next = end;
    if (auto error = list_quantities(target)) return error;
    present(mapping, target);
  }
  for (const std::string& node : mapping.sent_by) {
    if (!node.empty() && std::ranges::find(mapping.senders, node) == mapping.senders.end())
      mapping.senders.push_back(node);
  }
  for (const EventChannel& one : mapping.event_channels)
    mapping.channels.push_back({.name = one.name,
                                .answers = one.response.has_value(),
                                .most_bytes = one.transport == EventChannel::Transport::frame
                                                  ? one.request.message->size
                                                  : transport::most_iso_tp_bytes});
  for (const Hear& hear : mapping.hears) {
    for (const ReportedFlag& flag : hear.flags) mapping.flags.push_back(flag.name);
    for (const ReportedSignal& one : hear.reported_signals) {
      if (one.what == ReportedSignal::What::value)
        mapping.reported.push_back(
            {.name = std::string(one.quantity->quantity->name), .si = std::string(one.quantity->si)});
    }
  }
  mapping.closes_loop = mapping.guide != nullptr;
  mapping.estimators = mapping.presented;
  mapping.messages = mapping.infos;
  return std::nullopt;
}

}  // namespace canhil::mapping
