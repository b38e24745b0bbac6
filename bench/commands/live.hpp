// Options with which a command shows the live view.
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

/// Adds the options --live, --live-address and --live-hold. `live` must outlive parsing. Returns the option
/// --live.
command_line::Option add_live(command_line::Command command, Live& live);

/// An open live view, or no view. Without a view, the functions of this class do nothing.
class OpenView {
 public:
  /// Opens the page, prints its URL on stderr, and shows `begun` on the page and on `others`. An Error has
  /// one line.
  static Result<OpenView> open(const Live& live, live::Snapshot begun,
                               std::vector<std::unique_ptr<live::Display>> others = {});

  /// The view; null if no view is open.
  [[nodiscard]] live::View* get() const { return view_.get(); }
  /// Must be called after the page has shown the end of the runs. With --live-hold, waits until the command
  /// is interrupted, so that the page stays available.
  void hold();

 private:
  std::unique_ptr<live::View> view_;
  std::string held_;  // the page's URL; empty: hold() does not wait
};

}  // namespace canhil::commands
