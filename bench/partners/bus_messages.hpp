// The messages of a bus by their names, as a partner hears and sends them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/scenario/binding.hpp"
#include "dbc/parser/database.hpp"
#include "dbc/protection/protection.hpp"
#include "dbc/wire/frame.hpp"
#include "dbc/wire/result.hpp"

namespace canhil::partners {

/// The messages of single frames of the DBCs of a binding, which must outlive this object.
class BusMessages {
 public:
  explicit BusMessages(const scenario::Binding& binding);

  /// The message of a name; null: there is none.
  [[nodiscard]] const dbc::Message* find(std::string_view name) const;
  /// What was expected instead of a name that is unknown: the name that was probably meant.
  [[nodiscard]] std::string instead_of(std::string_view name) const;
  /// The message of a frame; null: it is in no DBC.
  [[nodiscard]] const dbc::Message* of(const Frame& frame) const;
  /// "NAME SIGNAL=VALUE ...", the signals that the frame has, in their units. None: the frame has not the
  /// size of the message.
  [[nodiscard]] static std::optional<std::string> text(const dbc::Message& message, const Frame& frame);
  /// The next frame of a message: the signals that are not named keep their last values, 0 at first; with the
  /// message's counter and checksum. Error, one phrase: the message or a signal is unknown.
  Result<Frame> frame(std::string_view name, std::span<const std::pair<std::string_view, double>> values);

 private:
  struct Own {
    const dbc::Message* message = nullptr;
    std::shared_ptr<const protection::Protection> protection{};
    std::map<std::string, double, std::less<>> values{};  // as last sent
    protection::Sender counter{};
  };

  std::map<std::string_view, Own> by_name_;
  std::map<std::pair<std::uint32_t, bool>, const dbc::Message*> by_id_;
};

}  // namespace canhil::partners
