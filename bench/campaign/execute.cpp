#include "bench/campaign/execute.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <thread>

#include "bench/campaign/flights.hpp"

namespace canhil::campaign {
namespace {

constexpr auto commit_interval = std::chrono::milliseconds(200);

/// Passes finished runs from the workers to the single writing thread.
class Finishing {
 public:
  explicit Finishing(std::size_t workers) : workers_(workers) {}

  void add(Finished run) {
    const std::scoped_lock lock(mutex_);
    runs_.push_back(std::move(run));
  }
  void fail(Error error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  void worker_ends() {
    const std::scoped_lock lock(mutex_);
    if (--workers_ == 0) ended_.notify_one();
  }
  /// Waits until a commit interval has passed or all workers have ended. Returns the runs that have finished
  /// since the last call. Returns nullopt if the workers have ended and all runs were returned.
  std::optional<std::vector<Finished>> take() {
    std::unique_lock lock(mutex_);
    const bool ended = ended_.wait_for(lock, commit_interval, [&] { return workers_ == 0; });
    if (ended && runs_.empty()) return std::nullopt;
    return std::exchange(runs_, {});
  }
  [[nodiscard]] std::optional<Error> error() const {
    const std::scoped_lock lock(mutex_);
    return error_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t workers_;
  std::vector<Finished> runs_;
  std::optional<Error> error_;
};

/// Data shared by the workers.
struct Work {
  Flights flights;
  std::vector<Key> tasks;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> halt = false;
};

void fly(Work& work, Finishing& finishing, const std::atomic<bool>& stop) {
  while (!stop && !work.halt) {
    const std::size_t index = work.next++;
    if (index >= work.tasks.size()) break;
    auto flown = work.flights.fly(work.tasks[index]);
    if (stop) break;
    if (!flown) {
      finishing.fail(flown.error());
      work.halt = true;
      break;
    }
    if (*flown) finishing.add(std::move(**flown));
  }
  finishing.worker_ends();
}

/// All runs of the shard that are not stored yet, ordered by run number. Runs of different variants that have
/// the same number are compared in pairs; in this order, they are flown at nearly the same time.
std::vector<Key> open_tasks(const Campaign& campaign, const Shard& shard, std::vector<Key> stored) {
  std::ranges::sort(stored);
  std::vector<Key> tasks;
  for (std::uint64_t run = 0; run < campaign.runs; ++run) {
    for (std::size_t variant = 0; variant < campaign.variants.size(); ++variant) {
      const Key key{.variant = variant, .run = run};
      const auto number = static_cast<std::uint64_t>(row_id(key, campaign.runs));
      if (number % shard.count == shard.index && !std::ranges::binary_search(stored, key))
        tasks.push_back(key);
    }
  }
  return tasks;
}

/// Commits the workers' results until the workers end.
Result<void> write_all(Store& store, Finishing& finishing, Progress& progress, const Options& options) {
  while (const auto runs = finishing.take()) {
    if (!runs->empty()) {
      if (auto added = store.add(*runs); !added) {
        return failure(fmt::format("{}; {} of {} runs are kept, to be resumed", added.error().message,
                                   progress.stored + progress.done, progress.stored + progress.total));
      }
    }
    progress.done += runs->size();
    options.committed(*runs);
    options.progress(progress);
  }
  return {};
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<std::uint64_t> number_of_environment(const char* name, std::optional<std::uint64_t> fallback) {
  const char* text = std::getenv(name);
  if (text == nullptr && fallback) return *fallback;
  const auto value = whole_number(text == nullptr ? "" : text);
  if (!value) {
    return failure(fmt::format("environment {}='{}': expected a whole number, as SLURM_ARRAY_TASK_ID is set",
                               name, text == nullptr ? "" : text));
  }
  return *value;
}

}  // namespace

Result<Shard> parse_shard(const std::string& text) {
  const std::string_view all = text;
  if (const auto slash = all.find('/'); slash != std::string_view::npos) {
    const auto index = whole_number(all.substr(0, slash));
    const auto count = whole_number(all.substr(slash + 1));
    if (index && count && *index < *count) return Shard{.index = *index, .count = *count};
  }
  return failure(fmt::format("shard '{}': expected i/N with 0 <= i < N", text));
}

Result<Shard> shard_of_environment() {
  if (std::getenv("SLURM_ARRAY_TASK_ID") == nullptr) return Shard{};
  const auto id = number_of_environment("SLURM_ARRAY_TASK_ID", {});
  const auto count = number_of_environment("SLURM_ARRAY_TASK_COUNT", {});
  const auto first = number_of_environment("SLURM_ARRAY_TASK_MIN", 0);
  const auto step = number_of_environment("SLURM_ARRAY_TASK_STEP", 1);
  for (const auto* value : {&id, &count, &first, &step}) {
    if (!*value) return tl::unexpected(value->error());
  }
  const bool regular = *step > 0 && *id >= *first && (*id - *first) % *step == 0;
  const Shard shard{.index = regular ? (*id - *first) / *step : 0, .count = *count};
  if (!regular || shard.index >= shard.count) {
    return failure(fmt::format(
        "task {} of a Slurm array of {} from {} by {}: expected an array without gaps, or --shard", *id,
        *count, *first, *step));
  }
  return shard;
}

Result<Execution> execute(const Campaign& campaign, const Options& options, const std::atomic<bool>& stop) {
  const Identity identity = identity_of(campaign, options.target);
  auto store = options.resume ? Store::resume(options.file, identity, campaign.sources)
                              : Store::create(options.file, identity, campaign.sources);
  if (!store) return tl::unexpected(store.error());
  const auto stored = store->keys();
  if (!stored) return tl::unexpected(stored.error());

  Work work{.flights = Flights(campaign, options.target, options.file.parent_path(), stop),
            .tasks = open_tasks(campaign, options.shard, *stored)};
  if (auto prepared = work.flights.prepare(work.tasks); !prepared) return tl::unexpected(prepared.error());

  const std::size_t cores = options.threads > 0 ? options.threads : std::thread::hardware_concurrency();
  const std::size_t workers = std::clamp<std::size_t>(cores, 1, std::max<std::size_t>(1, work.tasks.size()));
  Finishing finishing(workers);
  Result<void> written;
  Progress progress{.stored = stored->size(), .total = work.tasks.size()};
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < workers; ++i) threads.emplace_back([&] { fly(work, finishing, stop); });
    written = write_all(*store, finishing, progress, options);
    work.halt = true;
  }
  if (!written) return tl::unexpected(written.error());
  store->close();
  if (const auto error = finishing.error()) {
    // Remove a results file without runs, because it would block the next attempt.
    std::error_code ignored;
    if (progress.stored + progress.done == 0) std::filesystem::remove(options.file, ignored);
    options.not_flown(*error);
    return tl::unexpected(*error);
  }
  return progress.done < progress.total ? Execution::interrupted : Execution::complete;
}

}  // namespace canhil::campaign
