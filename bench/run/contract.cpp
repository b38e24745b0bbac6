#include "bench/run/contract.hpp"

#include "bench/nodes/registry.hpp"
#include "messages/canhil.hpp"
#include "target/device/device.hpp"

namespace canhil::run {
namespace {

template <class E>
std::vector<std::string> names() {
  std::vector<std::string> all;
  all.reserve(messages::enumerators<E>.size());
  for (const E value : messages::enumerators<E>) all.emplace_back(name_of(value));
  return all;
}

/// Of the target that comes with this bench; another one's may differ.
std::map<std::string, std::vector<std::string>, std::less<>> parameters_by_estimator() {
  std::map<std::string, std::vector<std::string>, std::less<>> all;
  const target::Device device;
  for (const auto estimator : messages::enumerators<messages::Estimator>) {
    for (const auto parameter : messages::enumerators<messages::Parameter>) {
      if (device.range(estimator, parameter))
        all[std::string(name_of(estimator))].emplace_back(name_of(parameter));
    }
  }
  return all;
}

/// The DBC names the groups of an estimator's messages after it.
std::map<std::string, std::string, std::less<>> estimator_by_message() {
  constexpr std::pair<std::string_view, messages::Estimator> groups[] = {
      {"Align", messages::Estimator::transfer_alignment},
      {"Fix", messages::Estimator::inflight_alignment},
      {"LosRate", messages::Estimator::los_rate},
      {"Wind", messages::Estimator::wind}};
  std::map<std::string, std::string, std::less<>> all;
  for (const MessageInfo& info : messages::all_messages) {
    for (const auto& [group, estimator] : groups) {
      if (!info.answers.empty() && info.sample_group.starts_with(group))
        all[std::string(info.name)] = name_of(estimator);
    }
  }
  return all;
}

scenario::Contract make_contract() {
  scenario::Contract contract{.estimators = names<messages::Estimator>(),
                              .algorithms = names<messages::Algorithm>(),
                              .parameters = names<messages::Parameter>(),
                              .messages = {},
                              .fix_outcomes = names<messages::FixOutcome>(),
                              .answers = {},
                              .wind_outcomes = names<messages::WindOutcome>()};
  contract.parameters_of = parameters_by_estimator();
  contract.sent_by = estimator_by_message();
  contract.nodes = nodes::tables();
  std::erase(contract.estimators, name_of(messages::Estimator::none));
  for (const MessageInfo& info : messages::all_messages) {
    contract.messages.emplace_back(info.name);
    if (!info.answers.empty()) contract.answers.emplace_back(info.name);
  }
  return contract;
}

}  // namespace

scenario::Contract contract() {
  static const scenario::Contract built_in = make_contract();
  return built_in;
}

}  // namespace canhil::run
