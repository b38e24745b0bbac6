// Whether somebody else sends what only the bench sends: then the target answers to both.
#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <string_view>

#include "bench/observe/observer.hpp"

namespace canhil::observe {

/// Counts frames of others that have the id of a message which the bench has sent in this run.
class Intruders final : public Observer {
 public:
  void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override;
  void received(const Received& received) override;
  /// By message.
  [[nodiscard]] const std::map<std::string_view, std::uint64_t>& frames() const { return frames_; }

 private:
  std::bitset<2048> ours_;  // by standard id
  std::map<std::string_view, std::uint64_t> frames_;
};

}  // namespace canhil::observe
