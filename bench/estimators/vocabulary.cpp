#include "bench/estimators/vocabulary.hpp"

#include <utility>

#include "bench/checks/estimator.hpp"

namespace canhil::estimators {

scenario::DbcVocabulary bound_to(scenario::DbcVocabulary of,
                                 std::shared_ptr<const scenario::Binding> binding) {
  of.estimators.clear();
  of.messages.clear();
  of.answers.clear();
  of.sent_by.clear();
  of.facts.clear();
  of.known = binding->estimators;
  for (const Estimator* one : of.known) {
    of.estimators.emplace_back(one->name);
    of.facts.emplace(one->name, one->facts);
  }
  for (const MessageInfo& info : binding->messages) {
    of.messages.emplace_back(info.name);
    if (!info.answers.empty()) of.answers.emplace_back(info.name);
    if (const std::string_view sender = binding->estimator_of(info); !sender.empty())
      of.sent_by.emplace(info.name, sender);
  }
  if (!binding->handshake) {  // nothing is set over the bus
    of.algorithms.clear();
    of.parameters.clear();
  }
  of.binding = std::move(binding);
  return of;
}

}  // namespace canhil::estimators
