#include "bench/commands/subcommands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "bench/commands/exit_code.hpp"
#include "bench/report/file.hpp"
#include "bench/schedulability/message_set.hpp"
#include "bench/schedulability/report.hpp"
#include "dbc/parser/parse.hpp"

namespace canhil::commands {
namespace {

// The arguments as given on the command line.
struct Arguments {
  std::string file;
  std::optional<std::uint64_t> bitrate;
  std::optional<std::uint64_t> data_bitrate;
  std::optional<std::uint64_t> error_burst;
  std::optional<std::uint64_t> jitter_us;
  std::string queue = "priority";
  double errors_per_second = 0;
  double event_interval_ms = 0;
  bool json = false;
};

schedulability::ErrorModel errors_of(const Arguments& arguments) {
  if (arguments.errors_per_second <= 0) return {};
  return {.burst = static_cast<std::int64_t>(arguments.error_burst.value_or(1)),
          .interval_ns = std::llround(1e9 / arguments.errors_per_second)};
}

ExitCode execute(const Arguments& arguments) {
  if (arguments.error_burst && arguments.errors_per_second <= 0)
    return complain({"--error-burst: expected --errors-per-second with it"});
  const bool fifo = arguments.queue == "fifo";
  if (fifo && arguments.errors_per_second > 0)
    return complain({"--queue fifo: there is no bound with errors, expected no --errors-per-second with it"});
  auto inspection = dbc::inspect_file(arguments.file);
  if (!inspection) return complain(inspection.error());
  auto tolerated = schedulability::tolerated(*inspection, arguments.file);
  if (!tolerated) return complain(tolerated.error());
  const auto database = dbc::usable(std::move(*inspection), arguments.file);
  if (!database) return complain(database.error());
  const auto in_file = [&arguments](const Error& error) {
    return complain({fmt::format("{}: {}", arguments.file, error.message)});
  };
  const auto rates = schedulability::bit_rates(
      *database, {.nominal = static_cast<std::int64_t>(arguments.bitrate.value_or(0)),
                  .data = static_cast<std::int64_t>(arguments.data_bitrate.value_or(0))});
  if (!rates) return in_file(rates.error());
  const schedulability::Assumptions assumptions{
      .event_interval_ns = std::llround(arguments.event_interval_ms * 1e6),
      .jitter_ns = static_cast<std::int64_t>(arguments.jitter_us.value_or(0)) * 1000};
  auto streams = schedulability::streams_of(*database, assumptions, *rates);
  if (!streams) return in_file(streams.error());
  auto analysis = schedulability::analyse(
      arguments.file, std::move(*streams),
      {.rates = *rates,
       .queues = fifo ? schedulability::Queues::in_order : schedulability::Queues::by_priority,
       .errors = errors_of(arguments)});
  analysis.tolerated = std::move(*tolerated);
  const auto shown = arguments.json ? report::write_stdout(schedulability::json(analysis))
                                    : report::show(schedulability::table(analysis));
  if (!shown) return complain(shown.error());
  return schedulability::schedulable(analysis) ? ExitCode::pass : ExitCode::fail;
}

}  // namespace

void add_schedulability(command_line::Command app, int& code) {
  auto arguments = std::make_shared<Arguments>();
  const auto command =
      app.add_subcommand("schedulability", "worst-case response time of every message of a DBC");
  command.add_option("FILE", arguments->file, "the DBC").required();
  constexpr std::uint64_t slowest = 1'000;
  command.add_number("--bitrate", arguments->bitrate, "bit/s (the DBC's Baudrate)", slowest, 1'000'000);
  command.add_number("--data-bitrate", arguments->data_bitrate,
                     "bit/s of the data phase of FD frames (the DBC's BaudrateCANFD)", slowest, 20'000'000);
  command.add_number("--errors-per-second", arguments->errors_per_second,
                     "bus errors, each an error frame and a retransmission", 1e-6, 1e5);
  command.add_number("--error-burst", arguments->error_burst, "so many of them may come at once (1)", 1,
                     10'000);
  command.add_number("--event-interval-ms", arguments->event_interval_ms,
                     "least interval of event messages that give none", 1e-3, 1e9);
  command
      .add_option("--queue", arguments->queue,
                  "what every node sends first: the most urgent frame, or the oldest as Linux does")
      .one_of({"priority", "fifo"});
  command.add_number("--jitter-us", arguments->jitter_us,
                     "how late messages without GenMsgJitter may be queued (0)", 0, 1'000'000'000);
  command.add_flag("--json", arguments->json, "JSON instead of a table");
  command.on_given([&code, arguments] { code = static_cast<int>(execute(*arguments)); });
}

}  // namespace canhil::commands
