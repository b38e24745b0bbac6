// The live view of a flight, a campaign or a matrix of faults: a thread of low priority, fed through a queue.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "bench/drive/onlooker.hpp"
#include "bench/drive/session.hpp"
#include "bench/live/display.hpp"
#include "bench/live/feed.hpp"
#include "bench/live/flight.hpp"

namespace canhil::live {

class View {
 public:
  /// Begins to show the snapshot `begun`. During a flight in real time, the thread of the view runs only when
  /// a CPU is idle, so the flight has priority on every CPU.
  View(std::vector<std::unique_ptr<Display>> displays, Snapshot begun);
  ~View();

  /// The onlooker for Options::onlooker. The onlooker can follow one flight after another, and must not be
  /// used after the view is destroyed.
  [[nodiscard]] drive::Onlooker& onlooker() { return onlooker_; }
  /// Replaces the displayed batch or flight. Any thread may call these functions.
  void show(Batch batch);
  void show(Flight flight);
  /// Shows that nothing was flown, and the reason.
  void show_ended(std::string why);
  /// Shows the last snapshot, waits at most a second until the viewers have received it, and stops. The
  /// destructor also calls this function.
  void close();

 private:
  class Tap final : public drive::Onlooker {
   public:
    explicit Tap(View& view) : view_(view) {}
    void departs(const drive::Departure& departure) override;
    void landed() override;
    void transmitted(const Frame& frame, std::int64_t t_ns, std::int64_t late_ns) override {
      view_.feed_.transmitted(frame, t_ns, late_ns);
    }
    void received(const Received& received) override { view_.feed_.received(received); }
    void foreign(const Received& received) override { view_.feed_.foreign(received); }
    void time_set(std::int64_t t_ns) override { view_.feed_.time_set(t_ns); }
    void interface_changed(bool up, std::int64_t t_ns) override { view_.feed_.interface_changed(up, t_ns); }

   private:
    View& view_;
  };
  // Requests from other threads to the view's thread.
  struct Requests {
    std::optional<drive::Departure> departure{};
    bool landing = false;
    std::optional<Batch> batch{};
    std::optional<Flight> flight{};
    std::string ended{};
  };

  void run();
  void look_on();
  void give_up();
  void look_at_requests();
  void look_at_frames();
  void serve(std::chrono::milliseconds time);
  void show_all();

  std::vector<std::unique_ptr<Display>> displays_;
  Feed feed_;
  Tap onlooker_{*this};
  std::mutex mutex_;
  std::condition_variable landed_;
  Requests requests_;
  bool gave_up_ = false;
  std::atomic<bool> asked_ = false, closing_ = false;
  // Only the view's thread uses snapshot_ and flight_.
  Snapshot snapshot_;
  std::optional<FlightInProgress> flight_{};
  std::thread thread_;
};

}  // namespace canhil::live
