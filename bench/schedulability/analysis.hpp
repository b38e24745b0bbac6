// Worst-case response times of the messages on a CAN bus: Davis, Burns, Bril, Lukkien, "Controller Area
// Network (CAN) schedulability analysis: refuted, revisited and revised", Real-Time Systems 35 (2007)
// 239-272.
//
// A response lasts from the event that makes a message due to the end of the intermission behind its frame.
// What it rests on: every node puts the message of highest priority forward at each arbitration (a priority
// queue), ids are unique, and a message becomes due no more often than its period says. Messages of one
// sample group become due together; the analysis lets all messages of the bus do so.
//
// For nodes that send in the order of queueing (SocketCAN's queues, and so the bench's and hil-target's own)
// there is a bound of its own: fifo_responses().
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dbc/wire/bit_length.hpp"

namespace canhil::schedulability {

/// Where the least interval between two frames of a message comes from.
enum class Release : std::uint8_t {
  cycle,     ///< sent cyclically, GenMsgCycleTime
  interval,  ///< sent on events, never closer than GenMsgDelayTime
  option,    ///< sent on events, never closer than the caller says of all such messages
  once       ///< sent on events of unknown interval: taken to be due once within any response on the bus
};

/// One message as the analysis sees it.
struct Stream {
  std::string name{};
  std::uint32_t id = 0;
  bool extended = false;
  std::string sender{};
  Release release = Release::cycle;
  std::int64_t period_ns = 0;  ///< least interval between two that become due; 0: Release::once
  std::optional<std::int64_t> deadline_ns{};
  std::int64_t jitter_ns = 0;  ///< at most so long after it became due is the message queued
  wire::BitLength length{};    ///< of its longest frame
};

/// Bus errors: `burst` of them at once, and one more every `interval_ns`. Each costs an error frame and a
/// retransmission (Tindell, Burns, Wellings 1995; Davis et al. 2007, section 3.4).
struct ErrorModel {
  std::int64_t burst = 0;  ///< 0: no errors
  std::int64_t interval_ns = 0;
};

struct Response {
  std::int64_t transmission_ns = 0;           ///< C
  std::int64_t blocking_ns = 0;               ///< B, the longest frame of lower priority
  std::optional<std::int64_t> response_ns{};  ///< R; none: the analysis finds no bound
  std::int64_t instances = 0;                 ///< so many of the message lie in the longest busy period
  std::int64_t worst_instance = 0;            ///< which of them, from 0, takes longest
};

/// What a node sends first: its frame of highest priority, or the oldest.
enum class Queues : std::uint8_t { by_priority, in_order };

/// What is asked of the bus.
struct Bus {
  wire::BitRates rates{};
  Queues queues = Queues::by_priority;
  ErrorModel errors{};
};

/// R of streams[index], with a blocking of so many ns. The streams in front of it, and no others, have higher
/// priority.
Response response(std::span<const Stream> streams, std::size_t index, std::int64_t blocking_ns,
                  const Bus& bus);

/// R of every stream; the streams are sorted by wire::arbitration_rank().
std::vector<Response> responses(std::span<const Stream> streams, const Bus& bus);

/// R of every stream where each sender queues its frames in the order in which they become ready, after the
/// idea of Davis, Kollmann, Pollex, Slomka, "Controller Area Network (CAN) schedulability analysis with FIFO
/// queues" (ECRTS 2011): a frame m of node N waits, from being queued at t on, for what is in front of it in
/// its own queue, for one frame of lower priority than all of N's, and for what other nodes have of higher
/// priority than the lowest L of N. With r_k the longest time from being queued to the end, all that is on
/// the bus at t was queued after t - r_k:
///   w_m = B_L + sum over k in N of ceil((r_k + J_k) / T_k) C_k - C_m
///             + sum over other k in hp(L) of ceil((w_m + r_k + J_k + tau_bit) / T_k) C_k
///   r_m = w_m + C_m,  R_m = J_m + r_m
/// Sound, not exact. The streams are sorted as above; the bus's error model is not looked at.
std::vector<Response> fifo_responses(std::span<const Stream> streams, const wire::BitRates& rates);

/// The share of the bus that all streams with a period take up.
double utilisation(std::span<const Stream> streams, const wire::BitRates& rates);

/// True if the message meets its deadline for sure; without a deadline: if there is a bound.
bool meets_deadline(const Stream& stream, const Response& response);

}  // namespace canhil::schedulability
