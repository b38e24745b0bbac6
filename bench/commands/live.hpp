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

/// Adds --live, --live-address, --live-hold. `live` must outlive parsing. Returns --live.
command_line::Option add_live(command_line::Command command, Live& live);

/// An open live view, or none; without a view its functions do nothing.
class OpenView {
 public:
  /// Opens the page, prints its URL on stderr, and shows `begun` on the page and on `others`. Error: one
  /// line.
  static Result<OpenView> open(const Live& live, live::Snapshot begun,
                               std::vector<std::unique_ptr<live::Display>> others = {});

  /// Null: no view is open.
  [[nodiscard]] live::View* get() const { return view_.get(); }
  /// To be called after the page has shown the end of the runs. With --live-hold, waits until the command is
  /// interrupted, so that the page stays.
  void hold();

 private:
  std::unique_ptr<live::View> view_;
  std::string held_;  // the page's URL; empty: the page is not held
};

}  // namespace canhil::commands
