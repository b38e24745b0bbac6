#include "bench/live/view.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <utility>

#include "dbc/text/escape.hpp"

namespace canhil::live {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// `look`: interval between reads of the queue, which must not fill up. `show`: shortest interval between
// updates of the displays. In real time, the view must work for clearly less than 1 % of the time; otherwise
// it would disturb more than 1 % of the flight's frames, and the p99 of their lateness would be wrong.
struct Pace {
  std::chrono::milliseconds look, show;
};
constexpr Pace usual{.look = 25ms, .show = 250ms}, real_time{.look = 100ms, .show = 500ms};
constexpr int rest = 9;  // ratio of pause to work: the displays work for at most a tenth of the time
constexpr auto longest_farewell = 1s;  // longest wait for viewers to receive the last snapshot
constexpr int low_nice = 10;

void run_below_others() {
  // Linux has a nice value for each thread: this changes only the current thread's value.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), low_nice));
}
void run_when_idle() {
  const sched_param parameters{};
  static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_IDLE, &parameters));
}

}  // namespace

View::View(std::vector<std::unique_ptr<Display>> displays, Snapshot begun)
    : displays_(std::move(displays)), snapshot_(std::move(begun)) {
  // The view's thread blocks all signals. So signals go to the thread that flies, which handles them at once.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

View::~View() { close(); }

void View::close() {
  closing_ = true;
  if (!thread_.joinable()) return;
  thread_.join();
  displays_.clear();
}

void View::Tap::departs(const drive::Departure& departure) {
  const std::scoped_lock lock(view_.mutex_);
  view_.feed_.follow(drive::growing_plants_of(departure.per_run_truth));
  view_.requests_.departure.emplace(departure);
  view_.requests_.landing = false;
  view_.asked_ = true;
}

// After landed(), the caller destroys the objects that the departure refers to. So landed() waits until the
// view no longer uses them.
void View::Tap::landed() {
  std::unique_lock lock(view_.mutex_);
  view_.feed_.follow({});
  view_.requests_.landing = true;
  view_.asked_ = true;
  // The flight now waits for the view, so the view's thread returns to normal scheduling, if that is
  // permitted.
  const sched_param parameters{};
  static_cast<void>(pthread_setschedparam(view_.thread_.native_handle(), SCHED_OTHER, &parameters));
  view_.landed_.wait(lock, [&] { return !view_.requests_.landing || view_.gave_up_; });
}

void View::show(Batch batch) {
  const std::scoped_lock lock(mutex_);
  requests_.batch = std::move(batch);
  asked_ = true;
}
void View::show(Flight flight) {
  const std::scoped_lock lock(mutex_);
  requests_.flight = std::move(flight);
  asked_ = true;
}
void View::show_ended(std::string why) {
  const std::scoped_lock lock(mutex_);
  requests_.ended = std::move(why);
  asked_ = true;
}

void View::look_at_requests() {
  if (!asked_.exchange(false)) return;
  const std::scoped_lock lock(mutex_);
  if (requests_.departure) {
    if (requests_.departure->real_time) run_when_idle();
    flight_.emplace(*requests_.departure);
    requests_.departure.reset();
  }
  if (std::exchange(requests_.landing, false)) {
    look_at_frames();
    if (flight_ && snapshot_.flight) flight_->update(*snapshot_.flight, feed_.dropped() == 0, true);
    flight_.reset();
    landed_.notify_all();
  }
  if (requests_.batch) snapshot_.batch = std::exchange(requests_.batch, {});
  if (requests_.flight) snapshot_.flight = std::exchange(requests_.flight, {});
  if (!requests_.ended.empty()) snapshot_.ended = std::exchange(requests_.ended, {});
}

void View::look_at_frames() {
  if (flight_) snapshot_.frames += feed_.drain(*flight_, flight_->plants());
  snapshot_.dropped = feed_.dropped();
}

void View::serve(std::chrono::milliseconds time) {
  for (const auto& display : displays_) display->run_for(time / static_cast<std::int64_t>(displays_.size()));
}

void View::show_all() {
  for (const auto& display : displays_) display->show(snapshot_);
}

// An error in the view, such as lack of memory, must not end the flight.
void View::run() {
  run_below_others();
  try {
    look_on();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hil-bench: the live view ended: %s\n", one_line(error.what()).c_str());
    give_up();
  }
}

void View::give_up() {
  const std::scoped_lock lock(mutex_);
  gave_up_ = true;
  flight_.reset();
  landed_.notify_all();
}

void View::look_on() {
  Clock::time_point next = Clock::now();
  while (!closing_) {
    const Pace pace = flight_ && flight_->real_time() ? real_time : usual;
    look_at_requests();
    look_at_frames();
    if (const auto began = Clock::now(); began >= next) {
      if (flight_ && snapshot_.flight) flight_->update(*snapshot_.flight, feed_.dropped() == 0);
      show_all();
      next = std::max(began + pace.show, Clock::now() + rest * (Clock::now() - began));
    }
    serve(pace.look);
  }
  look_at_requests();
  show_all();
  const auto until = Clock::now() + longest_farewell;
  const auto settled = [&] {
    return std::ranges::all_of(displays_, [](const auto& display) { return display->settled(); });
  };
  do {
    serve(usual.look);
  } while (!settled() && Clock::now() < until);
}

}  // namespace canhil::live
