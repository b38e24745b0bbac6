// Worst-case response times of the messages on a CAN bus: Davis, Burns, Bril, Lukkien, "Controller Area
// Network (CAN) schedulability analysis: refuted, revisited and revised", Real-Time Systems 35 (2007)
// 239-272.
//
// A response begins when a message becomes due, and ends with the intermission after the message's frame.
// Assumptions: every node has a priority queue, i.e. takes part in each arbitration with its waiting message
// of highest priority; ids are unique; and the time between two releases of a message is at least its period.
// The messages of one sample group become due together. The analysis covers this case, because it allows all
// messages of the bus to become due together.
//
// fifo_responses() computes bounds for nodes that send their frames in the order of queueing. The bench and
// hil-target are such nodes, because the queues of SocketCAN keep this order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dbc/wire/bit_length.hpp"

namespace canhil::schedulability {

/// Where the minimum interval between two frames of a message comes from.
enum class Release : std::uint8_t {
  cycle,     ///< sent cyclically, with the cycle time GenMsgCycleTime
  interval,  ///< sent on events, at intervals of at least GenMsgDelayTime
  option,    ///< sent on events, at a minimum interval that the caller assumes
  once       ///< sent on events at unknown intervals; assumed to become due once in any response
};

/// One message in the analysis.
struct Stream {
  std::string name{};
  std::uint32_t id = 0;
  bool extended = false;
  std::string sender{};
  Release release = Release::cycle;
  std::int64_t period_ns = 0;  ///< minimum interval between two releases; 0 for Release::once
  std::optional<std::int64_t> deadline_ns{};
  std::int64_t jitter_ns = 0;  ///< the longest time from becoming due to being queued
  wire::BitLength length{};    ///< longest length of a frame
};

/// Bus errors: first `burst` errors at the same time, then one error every `interval_ns`. Each error costs an
/// error frame and a retransmission (Tindell, Burns, Wellings 1995; Davis et al. 2007, section 3.4).
struct ErrorModel {
  std::int64_t burst = 0;  ///< number of errors at the same time; 0: the bus has no errors
  std::int64_t interval_ns = 0;
};

struct Response {
  std::int64_t transmission_ns = 0;           ///< C, duration of the longest frame of the message
  std::int64_t blocking_ns = 0;               ///< B, duration of the longest frame of lower priority
  std::optional<std::int64_t> response_ns{};  ///< R; nullopt: the analysis finds no bound
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

/// The response of streams[index]; `blocking_ns` is the blocking by lower priorities. The streams before
/// streams[index] have higher priority, all others have lower priority.
Response response(std::span<const Stream> streams, std::size_t index, std::int64_t blocking_ns,
                  const Bus& bus);

/// The response of every stream. The streams must be sorted by wire::arbitration_rank().
std::vector<Response> responses(std::span<const Stream> streams, const Bus& bus);

/// The response of every stream if each node sends its frames in the order of queueing (FIFO). The method
/// follows the idea of Davis, Kollmann, Pollex, Slomka, "Controller Area Network (CAN) schedulability
/// analysis with FIFO queues" (ECRTS 2011). Let L be the frame that has the lowest priority among the frames
/// of a node N. A frame m of N waits for three kinds of frames: the frames before m in the queue of N; one
/// frame with a lower priority than L; and frames that other nodes send with a higher priority than L. These
/// frames of other nodes are called hp(L). Let r_k be the longest time from the queueing of a frame k to the
/// end of its transmission. Then every frame k that is on the bus at time t was queued after t - r_k. T, J
/// and C are the period, the jitter and the duration of a frame, B is the blocking and tau_bit the bit time.
/// Hence:
///   w_m = B_L + sum over k in N of ceil((r_k + J_k) / T_k) C_k - C_m
///             + sum over k in hp(L) of ceil((w_m + r_k + J_k + tau_bit) / T_k) C_k
///   r_m = w_m + C_m,  R_m = J_m + r_m
/// This bound is sufficient, not exact. The streams must be sorted by wire::arbitration_rank(). Bus errors
/// are not taken into account.
std::vector<Response> fifo_responses(std::span<const Stream> streams, const wire::BitRates& rates);

/// The utilisation of the bus by all streams with a period.
double utilisation(std::span<const Stream> streams, const wire::BitRates& rates);

/// True if the response time of the message has a bound, and this bound does not exceed the deadline (if the
/// message has a deadline).
bool meets_deadline(const Stream& stream, const Response& response);

}  // namespace canhil::schedulability
