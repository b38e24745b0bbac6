// Worst-case response times of the messages on a CAN bus: Davis, Burns, Bril, Lukkien, "Controller Area
// Network (CAN) schedulability analysis: refuted, revisited and revised", Real-Time Systems 35 (2007)
// 239-272.
//
// A response begins when a message becomes due, and ends with the intermission after its frame.
// Assumptions: every node enters its highest-priority message into each arbitration (a priority queue), ids
// are unique, and a message becomes due no more often than its period allows. Messages of one sample group
// become due together; the analysis allows this for all messages of the bus.
//
// fifo_responses() gives bounds for nodes that send in order of queueing (SocketCAN's queues, and therefore
// the bench and hil-target).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dbc/wire/bit_length.hpp"

namespace canhil::schedulability {

/// The source of the minimum interval between two frames of a message.
enum class Release : std::uint8_t {
  cycle,     ///< sent cyclically, GenMsgCycleTime
  interval,  ///< sent on events, at intervals of at least GenMsgDelayTime
  option,    ///< sent on events, at a minimum interval that the caller assumes
  once       ///< sent on events at unknown intervals: assumed due once within any response
};

/// One message in the analysis.
struct Stream {
  std::string name{};
  std::uint32_t id = 0;
  bool extended = false;
  std::string sender{};
  Release release = Release::cycle;
  std::int64_t period_ns = 0;  ///< minimum interval between two releases; 0: Release::once
  std::optional<std::int64_t> deadline_ns{};
  std::int64_t jitter_ns = 0;  ///< the longest time from becoming due to being queued
  wire::BitLength length{};    ///< longest length of a frame
};

/// Bus errors: `burst` at once, then one every `interval_ns`. Each costs an error frame and a retransmission
/// (Tindell, Burns, Wellings 1995; Davis et al. 2007, section 3.4).
struct ErrorModel {
  std::int64_t burst = 0;  ///< 0: no errors
  std::int64_t interval_ns = 0;
};

struct Response {
  std::int64_t transmission_ns = 0;           ///< C
  std::int64_t blocking_ns = 0;               ///< B, transmission time of the longest frame of lower priority
  std::optional<std::int64_t> response_ns{};  ///< R; none: the analysis finds no bound
  std::int64_t instances = 0;                 ///< number of instances in the longest busy period
  std::int64_t worst_instance = 0;            ///< index of the instance with the longest response, from 0
};

/// The order in which a node sends its frames: by priority, or first in, first out.
enum class Queues : std::uint8_t { by_priority, in_order };

/// Parameters of the bus.
struct Bus {
  wire::BitRates rates{};
  Queues queues = Queues::by_priority;
  ErrorModel errors{};
};

/// R of streams[index], with a given blocking [ns]. The streams before it, and only these, have higher
/// priority.
Response response(std::span<const Stream> streams, std::size_t index, std::int64_t blocking_ns,
                  const Bus& bus);

/// R of every stream; the streams are sorted by wire::arbitration_rank().
std::vector<Response> responses(std::span<const Stream> streams, const Bus& bus);

/// R of every stream if each sender queues its frames in the order in which they become ready, following the
/// idea of Davis, Kollmann, Pollex, Slomka, "Controller Area Network (CAN) schedulability analysis with FIFO
/// queues" (ECRTS 2011). A frame m of node N that is queued at t waits for the frames before it in its own
/// queue, for one frame of lower priority than all of N's, and for frames of other nodes with higher priority
/// than L, the frame of N with the lowest priority. With r_k the longest time from queueing to the end, every
/// frame on the bus at t was queued after t - r_k:
///   w_m = B_L + sum over k in N of ceil((r_k + J_k) / T_k) C_k - C_m
///             + sum over other k in hp(L) of ceil((w_m + r_k + J_k + tau_bit) / T_k) C_k
///   r_m = w_m + C_m,  R_m = J_m + r_m
/// This bound is sufficient, not exact. The streams are sorted by wire::arbitration_rank(). Bus
/// errors are not taken into account.
std::vector<Response> fifo_responses(std::span<const Stream> streams, const wire::BitRates& rates);

/// The utilisation of the bus by all streams with a period.
double utilisation(std::span<const Stream> streams, const wire::BitRates& rates);

/// True if the message is guaranteed to meet its deadline; without a deadline: if there is a bound.
bool meets_deadline(const Stream& stream, const Response& response);

}  // namespace canhil::schedulability
