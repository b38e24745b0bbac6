#include "bench/run/contract.hpp"

#include "bench/checks/judge.hpp"
#include "bench/estimators/registry.hpp"
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

scenario::Contract make_contract() {
  scenario::Contract contract{.estimators = names<messages::Estimator>(),
                              .algorithms = names<messages::Algorithm>(),
                              .parameters = names<messages::Parameter>(),
                              .messages = {},
                              .answers = {},
                              .check_kinds = checks::kinds(estimators::all()),
                              .known = estimators::all(),
                              .former_check_kinds = checks::former_kinds()};
  contract.parameters_of = parameters_by_estimator();
  contract.nodes = nodes::tables();
  std::erase(contract.estimators, name_of(messages::Estimator::none));
  for (const MessageInfo& info : messages::all_messages) {
    contract.messages.emplace_back(info.name);
    if (!info.answers.empty()) contract.answers.emplace_back(info.name);
    if (const estimators::Estimator* sender = estimators::sending(info))
      contract.sent_by[contract.messages.back()] = sender->name;
  }
  return contract;
}

}  // namespace

scenario::Contract contract() {
  static const scenario::Contract built_in = make_contract();
  return built_in;
}

}  // namespace canhil::run
