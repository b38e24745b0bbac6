#include "bench/bindings/canhil.hpp"

#include <algorithm>

#include "bench/bindings/contract_text.hpp"
#include "bench/estimators/registry.hpp"
#include "bench/nodes/registry.hpp"
#include "bench/scenario/scenario.hpp"
#include "dbc/parser/parse.hpp"
#include "dbc/protection/profiles.hpp"
#include "dbc/protection/protection.hpp"
#include "messages/canhil.hpp"

namespace canhil::bindings {
namespace {

using protection::Protection;
using scenario::NodeSettings;
using scenario::NodeTable;

static_assert(messages::Sync::info.sender == bench_node && is_targets(messages::TargetHeartbeat::info));

struct Canhil final : scenario::Binding {
  Canhil() {
    messages = messages::all_messages;
    estimators = estimators::all();
    dbc_hash = messages::dbc_hash;
    for (const nodes::Kind* kind : nodes::all()) senders.emplace_back(kind->table.closes->sender);
    handshake = time_base = containers = closes_loop = answers_by_name = true;
  }

  // As dbc/wire/e2e.hpp writes it.
  [[nodiscard]] std::shared_ptr<const Protection> protection_of(const MessageInfo& message) const override {
    if (message.e2e_data_id == 0) return nullptr;
    protection::ProfileChoice choice;
    choice.data_id = message.e2e_data_id;
    const auto settings = protection::profile("autosar-e2e-11a", choice, message.size);
    return std::make_shared<const Protection>(
        Protection::make(settings.value(), {.id = message.id, .size = message.size}).value());
  }

  [[nodiscard]] std::vector<const dbc::Database*> databases() const override {
    static const dbc::Database database = dbc::parse(contract_text.front().text, "canhil.dbc").value();
    return {&database};
  }

  [[nodiscard]] const MessageInfo* closing_of(const NodeTable& node) const override { return node.closes; }

  [[nodiscard]] std::string_view sender_of(const MessageInfo& message) const override {
    return message.sender;
  }

  [[nodiscard]] bool is_played(const MessageInfo& message,
                               std::span<const NodeSettings> nodes) const override {
    return std::ranges::any_of(nodes, [&](const NodeSettings& node) {
      const MessageInfo* closes = node.table().closes;
      return closes != nullptr && is_in_group_of(message, *closes);
    });
  }

  [[nodiscard]] std::string_view estimator_of(const MessageInfo& message) const override {
    const auto closes_its_group = [&](std::string_view closing) {
      return is_in_group_of(message, *std::ranges::find(messages, closing, &MessageInfo::name));
    };
    for (const estimators::Estimator* one : estimators) {
      if (std::ranges::any_of(one->closing, closes_its_group)) return one->name;
    }
    return "";
  }

  [[nodiscard]] Result<void> fits(const scenario::Scenario& scenario,
                                  const world::FlightRecord& flight) const override {
    for (const nodes::Kind* kind : nodes::all()) {
      const NodeSettings* node = scenario.node(kind->table.key);
      if (node == nullptr || !node->is_modelled() || kind->fits == nullptr) continue;
      if (auto fits = kind->fits(*node, scenario, flight); !fits) return fits;
    }
    return {};
  }
};

}  // namespace

std::shared_ptr<const scenario::Binding> canhil() {
  static const auto binding = std::make_shared<const Canhil>();
  return binding;
}

}  // namespace canhil::bindings
