// The live view as options of a command.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/live/view.hpp"
#include "dbc/command_line/command_line.hpp"

namespace canhil::commands {

/// The options of the live view as given on the command line.
struct Live {
  std::optional<int> port;
  std::string address;
  bool hold = false;
  [[nodiscard]] bool wanted() const { return port.has_value(); }
};

/// --live, --live-address, --live-hold. `live` must outlive parsing. Gives --live.
command_line::Option add_live(command_line::Command command, Live& live);

/// A live view that is open, or none: then its functions do nothing.
class OpenView {
 public:
  /// Opens the page, says on stderr where it is, and shows what has begun, there and on `others`. Error: one
  /// line.
  static Result<OpenView> open(const Live& live, live::Snapshot begun,
                               std::vector<std::unique_ptr<live::Display>> others = {});

  /// Null: there is none.
  [[nodiscard]] live::View* get() const { return view_.get(); }
  /// The end has been shown: with --live-hold the page stays until the command is interrupted.
  void hold();

 private:
  std::unique_ptr<live::View> view_;
  std::string held_;  // the URL; empty: it is not held
};

}  // namespace canhil::commands
