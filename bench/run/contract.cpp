#include "bench/run/contract.hpp"

#include "messages/canhil.hpp"

namespace canhil::run {
namespace {

template <class E>
std::vector<std::string> names() {
  std::vector<std::string> all;
  all.reserve(messages::enumerators<E>.size());
  for (const E value : messages::enumerators<E>) all.emplace_back(name_of(value));
  return all;
}

}  // namespace

scenario::Contract contract() {
  scenario::Contract contract{.estimators = names<messages::Estimator>(),
                              .algorithms = names<messages::Algorithm>(),
                              .parameters = names<messages::Parameter>(),
                              .messages = {},
                              .fix_outcomes = names<messages::FixOutcome>(),
                              .answers = {},
                              .wind_outcomes = names<messages::WindOutcome>()};
  std::erase(contract.estimators, name_of(messages::Estimator::none));
  for (const MessageInfo& info : messages::all_messages) {
    contract.messages.emplace_back(info.name);
    if (!info.answers.empty()) contract.answers.emplace_back(info.name);
  }
  return contract;
}

bool frames_round() { return wire::lsb(messages::SlaveImuDeltaTheta::info.signals[0]) != 0; }

}  // namespace canhil::run
