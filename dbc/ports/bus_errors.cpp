#include "dbc/ports/bus_errors.hpp"

#include <fmt/format.h>
#include <linux/can/error.h>

#include <algorithm>
#include <array>
#include <utility>

namespace canhil {
namespace {

// Copies the error counters of the controller from an error frame. Since Linux 6.0, the flag CAN_ERR_CNT
// marks frames with counters. Earlier kernels put the counters, without a flag, into frames of the class
// "controller".
void take_counters(BusErrors& errors, const Frame& frame) {
  const bool flagged = (frame.id & CAN_ERR_CNT) != 0;
  const bool old = (frame.id & CAN_ERR_CRTL) != 0 && (frame.data[6] != 0 || frame.data[7] != 0);
  if (frame.size < CAN_ERR_DLC || (!flagged && !old)) return;
  errors.tx_counter = frame.data[6];
  errors.rx_counter = frame.data[7];
  errors.tx_counter_max = std::max(errors.tx_counter_max, frame.data[6]);
  errors.rx_counter_max = std::max(errors.rx_counter_max, frame.data[7]);
}

// Returns the bit of the larger error counter, or both bits if the counters are equal. can_change_state() of
// the kernel sets the bits in the same way.
std::uint8_t controller_bits(const ControllerNews& news, unsigned transmit, unsigned receive) {
  return static_cast<std::uint8_t>((news.tx_counter >= news.rx_counter ? transmit : 0U) |
                                   (news.rx_counter >= news.tx_counter ? receive : 0U));
}

}  // namespace

std::string_view name(BusEvent event) {
  switch (event) {
    case BusEvent::error_active:
      return "error active";
    case BusEvent::error_warning:
      return "error warning";
    case BusEvent::error_passive:
      return "error passive";
    case BusEvent::bus_off:
      return "bus off";
    case BusEvent::restarted:
      return "restarted";
    case BusEvent::down:
      return "down";
    case BusEvent::up:
      return "up";
  }
  return "?";
}

std::optional<BusEvent> add(BusErrors& errors, const Frame& frame) {
  std::optional<BusEvent> event;
  const auto count = [](bool said, std::uint64_t& counter) { counter += said ? 1 : 0; };
  const auto change = [&](bool said, std::uint64_t& counter, BusEvent to) {
    count(said, counter);
    if (said) event = to;
  };
  const auto says = [&](std::uint32_t class_bit) { return (frame.id & class_bit) != 0; };
  const auto controller = [&](unsigned bits) {
    return says(CAN_ERR_CRTL) && frame.size > 1 && (frame.data[1] & bits) != 0;
  };
  ++errors.frames;
  count(says(CAN_ERR_LOSTARB), errors.lost_arbitration);
  count(says(CAN_ERR_ACK), errors.no_ack);
  count(says(CAN_ERR_TX_TIMEOUT), errors.tx_timeout);
  count(says(CAN_ERR_PROT), errors.protocol);
  count(says(CAN_ERR_BUSERROR), errors.bus_error);
  count(says(CAN_ERR_TRX), errors.transceiver);
  count(controller(CAN_ERR_CRTL_RX_OVERFLOW), errors.rx_overflow);
  count(controller(CAN_ERR_CRTL_TX_OVERFLOW), errors.tx_overflow);
  take_counters(errors, frame);
  // The changes are in ascending order of severity, because the last change is the one that is returned.
  change(controller(CAN_ERR_CRTL_ACTIVE), errors.active, BusEvent::error_active);
  change(controller(CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING), errors.warning,
         BusEvent::error_warning);
  change(controller(CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE), errors.passive,
         BusEvent::error_passive);
  change(says(CAN_ERR_RESTARTED), errors.restarted, BusEvent::restarted);
  change(says(CAN_ERR_BUSOFF), errors.bus_off, BusEvent::bus_off);
  return event;
}

Frame error_frame(const ControllerNews& news) {
  Frame frame{.size = CAN_ERR_DLC, .error = true};
  switch (news.seen) {
    case SeenError::none:
      break;
    case SeenError::bit:
      frame.id |= CAN_ERR_PROT | CAN_ERR_BUSERROR;
      frame.data[2] = CAN_ERR_PROT_BIT | CAN_ERR_PROT_TX;
      break;
    case SeenError::stuff:
      frame.id |= CAN_ERR_PROT | CAN_ERR_BUSERROR;
      frame.data[2] = CAN_ERR_PROT_STUFF;
      break;
    case SeenError::acknowledgement:
      frame.id |= CAN_ERR_ACK | CAN_ERR_BUSERROR;
      break;
  }
  if (news.event == BusEvent::error_active) {
    frame.id |= CAN_ERR_CRTL;
    frame.data[1] = CAN_ERR_CRTL_ACTIVE;
  } else if (news.event == BusEvent::error_warning) {
    frame.id |= CAN_ERR_CRTL;
    frame.data[1] = controller_bits(news, CAN_ERR_CRTL_TX_WARNING, CAN_ERR_CRTL_RX_WARNING);
  } else if (news.event == BusEvent::error_passive) {
    frame.id |= CAN_ERR_CRTL;
    frame.data[1] = controller_bits(news, CAN_ERR_CRTL_TX_PASSIVE, CAN_ERR_CRTL_RX_PASSIVE);
  } else if (news.event == BusEvent::restarted) {
    frame.id |= CAN_ERR_RESTARTED;
  } else if (news.event == BusEvent::bus_off) {
    frame.id |= CAN_ERR_BUSOFF;
    return frame;  // without counters, because those of a bus-off controller have no meaning
  }
  frame.id |= CAN_ERR_CNT;
  frame.data[6] = static_cast<std::uint8_t>(std::min(news.tx_counter, 255));
  frame.data[7] = static_cast<std::uint8_t>(std::min(news.rx_counter, 255));
  return frame;
}

std::string to_text(const BusErrors& errors) {
  const std::array<std::pair<std::string_view, std::uint64_t>, 13> said{
      {{"bus off", errors.bus_off},
       {"restarted", errors.restarted},
       {"error passive", errors.passive},
       {"error warning", errors.warning},
       {"error active", errors.active},
       {"no acknowledgement", errors.no_ack},
       {"arbitration lost", errors.lost_arbitration},
       {"transmit timeout", errors.tx_timeout},
       {"protocol", errors.protocol},
       {"bus error", errors.bus_error},
       {"controller receive overflow", errors.rx_overflow},
       {"controller transmit overflow", errors.tx_overflow},
       {"transceiver", errors.transceiver}}};
  std::string text;
  for (const auto& [what, count] : said) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", what, count);
  }
  if (text.empty() && errors.frames > 0) text = "of an unknown class";
  if (errors.tx_counter_max > 0 || errors.rx_counter_max > 0)
    text +=
        fmt::format("; error counters at most tx {}, rx {}", errors.tx_counter_max, errors.rx_counter_max);
  return text;
}

}  // namespace canhil
