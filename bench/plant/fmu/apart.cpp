// An FMU in a process of its own: the bench's side.
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include "bench/plant/fmu/channel.hpp"
#include "bench/plant/fmu/running.hpp"
#include "bench/processes/child_process.hpp"

namespace canhil::plant::fmu {
namespace {

using std::chrono::milliseconds;

/// The program stands beside the bench; programs that only tests start find the one of the build.
std::string server_program() {
  std::error_code unknown;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto beside = own.parent_path() / "hil-bench-fmu";
  return std::filesystem::exists(beside, unknown) ? beside.string() : CANHIL_FMU_PROGRAM;
}

class Apart final : public Running {
 public:
  Apart(Channel channel, processes::ChildProcess child, milliseconds patience)
      : channel_(std::move(channel)), child_(std::move(child)), patience_(patience) {}
  ~Apart() override {
    channel_.send("", Channel::Clock::now() + patience_);  // the program ends
    wait_for_end(processes::ChildProcess::usual_patience);
    child_.end(milliseconds(0));
  }

  Result<void> ask(const Writer& question, std::span<double> outputs) {
    const auto deadline = Channel::Clock::now() + patience_;
    std::string record;
    auto outcome = channel_.send(question.bytes(), deadline);
    if (outcome == Channel::Outcome::done) outcome = channel_.receive(record, deadline);
    if (outcome == Channel::Outcome::late) return kill();
    if (outcome == Channel::Outcome::closed) return failure(fmt::format("its process {}", ending()));
    RecordReader reader(record);
    if (!reader.take<bool>()) return failure(reader.take_text());
    reader.take(outputs);
    return reader.wrong() ? failure("its process gave a wrong answer") : Result<void>();
  }

  Result<void> step(double from_s, double step_s, std::span<const double> inputs,
                    std::span<double> outputs) override {
    Writer writer;
    writer.add(from_s);
    writer.add(step_s);
    writer.add(inputs);
    return ask(writer, outputs);
  }

 private:
  Result<void> kill() {
    child_.send_signal(SIGKILL);
    child_.end(processes::ChildProcess::short_patience);
    return failure(fmt::format("did not answer within {} s and was killed",
                               static_cast<double>(patience_.count()) / 1e3));
  }
  void wait_for_end(milliseconds patience) {
    const auto deadline = Channel::Clock::now() + patience;
    while (!child_.ended() && Channel::Clock::now() < deadline) std::this_thread::sleep_for(milliseconds(1));
  }
  std::string ending() {
    wait_for_end(processes::ChildProcess::short_patience);  // it closes its socket before it ends
    const bool ended = child_.ended().has_value();
    const auto end = child_.end(milliseconds(0));
    return ended ? to_text(end) : "closed the connection and was killed";
  }

  Channel channel_;
  processes::ChildProcess child_;
  milliseconds patience_;
};

}  // namespace

Started start_apart(const Setup& setup, milliseconds patience, std::span<double> outputs) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return failure(fmt::format("a socket pair cannot be made ({})", strerror(errno)));
  Channel own(ends[0]), other(ends[1]);
  const std::string program = server_program();
  auto child = processes::ChildProcess::start(program, {program}, {.input = ends[1]});
  if (!child) return failure(fmt::format("{} cannot be started ({})", program, child.error().message));
  other.close();
  auto apart = std::make_unique<Apart>(std::move(own), std::move(*child), patience);
  Writer writer;
  write_setup(writer, setup);
  if (auto started = apart->ask(writer, outputs); !started) return tl::unexpected(started.error());
  return apart;
}

}  // namespace canhil::plant::fmu
