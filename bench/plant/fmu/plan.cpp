#include "bench/plant/fmu/plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "bench/plant/fmu/running.hpp"
#include "dbc/text/escape.hpp"

namespace canhil::plant::fmu {
namespace {

double seconds(std::int64_t us) { return static_cast<double>(us) / 1e6; }

class Fmu final : public Plant {
 public:
  Fmu(std::shared_ptr<const FmuSettings> settings, std::shared_ptr<const TemporaryFolder> folder)
      : settings_(std::move(settings)),
        folder_(std::move(folder)),
        inputs_(settings_->inputs.size()),
        outputs_(settings_->outputs.size()) {}

  Result<void> start() {
    Setup setup = settings_->setup;
    const std::string unpacked = folder_->path().string();
    setup.folder = unpacked;
    setup.library = unpacked + "/" + setup.library;
    auto running = settings_->in_process ? start_here(setup, outputs_)
                                         : start_apart(setup, settings_->patience, outputs_);
    if (!running) return failed(running.error().message, "at its start");
    running_ = std::move(*running);
    return convert_outputs("at its start");
  }

  [[nodiscard]] std::span<const double> outputs() const override { return outputs_; }

  Result<void> step(std::int64_t from_us, std::int64_t to_us, std::span<const double> inputs) override {
    const std::string when = fmt::format("in the step from {} s to {} s", seconds(from_us), seconds(to_us));
    if (auto may = check_step(to_us - from_us); !may) return failed(may.error().message, when);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const auto value = settings_->inputs[i].from_si(inputs[i]);
      if (!value) return failed(value.error().message, when);
      inputs_[i] = *value;
    }
    const auto done = running_->step(seconds(from_us), seconds(to_us - from_us), inputs_, outputs_);
    if (!done) return failed(done.error().message, when);
    return convert_outputs(when);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> failed(std::string_view what, std::string_view when) const {
    return failure(one_line(fmt::format("FMU '{}' {}: {}", settings_->setup.fmu, when, what)));
  }
  Result<void> convert_outputs(std::string_view when) {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      outputs_[i] = settings_->outputs[i].to_si(outputs_[i]);
      if (!std::isfinite(outputs_[i]))
        return failed(fmt::format("output '{}' is {}", settings_->outputs[i].name, outputs_[i]), when);
    }
    return {};
  }
  /// An FMU that cannot vary its step takes steps of one length, a multiple of its internal step.
  Result<void> check_step(std::int64_t step_us) {
    if (settings_->step_may_vary) return {};
    if (step_us_ && *step_us_ != step_us)
      return failure(
          fmt::format("the steps before took {} s, expected this step to be equal, because "
                      "canHandleVariableCommunicationStepSize is false",
                      seconds(*step_us_)));
    step_us_ = step_us;
    const double internal_s = settings_->internal_step_s;
    const double steps = internal_s > 0 ? seconds(step_us) / internal_s : 1;
    constexpr double rounding = 1e-9;
    if (std::abs(steps - std::round(steps)) <= rounding * steps && steps > 0.5) return {};
    return failure(
        fmt::format("expected a step that is a multiple of fixedInternalStepSize, {} s", internal_s));
  }

  std::shared_ptr<const FmuSettings> settings_;
  std::shared_ptr<const TemporaryFolder> folder_;
  std::vector<double> inputs_, outputs_;
  std::optional<std::int64_t> step_us_{};
  std::unique_ptr<Running> running_;  // ends before its folder does
};

}  // namespace

double Element::to_si(double value) const {
  const bool same = conversion.factor == 1 && conversion.offset == 0;
  return same ? value : conversion.factor * value + conversion.offset;
}

Result<double> Element::from_si(double si) const {
  const bool same = conversion.factor == 1 && conversion.offset == 0;
  const double value = same ? si : (si - conversion.offset) / conversion.factor;
  if (type == Type::boolean) return static_cast<double>(value != 0);
  const double given = is_integer(type) ? std::round(value) : value;
  const Range range = range_of(type);
  // The largest Int64 and UInt64 are not doubles; the next larger double stands for them in the range.
  constexpr double exact = 9007199254740992.0;  // 2^53
  const bool below = is_integer(type) && range.most > exact ? given < range.most : given <= range.most;
  if (given >= range.least && below) return given;
  return failure(fmt::format("input '{}' is {}, which the type {} cannot hold", name, value, name_of(type)));
}

Result<std::unique_ptr<Plant>> FmuPlan::make(const Draw& /*draw*/) const {
  auto folder = unpacked();
  if (!folder)
    return failure(one_line(fmt::format("FMU '{}': {}", settings_->setup.fmu, folder.error().message)));
  auto plant = std::make_unique<Fmu>(settings_, std::move(*folder));
  if (auto started = plant->start(); !started) return tl::unexpected(started.error());
  return plant;
}

Result<std::shared_ptr<const TemporaryFolder>> FmuPlan::unpacked() const {
  const std::lock_guard lock(mutex_);
  if (folder_) return folder_;
  if (settings_->setup.library.empty()) return failure("was not read without an error");
  auto folder = TemporaryFolder::make("fmu");
  if (!folder) return tl::unexpected(folder.error());
  if (auto done = archive_.unpack((*folder)->path()); !done) return tl::unexpected(done.error());
  folder_ = std::move(*folder);
  return folder_;
}

}  // namespace canhil::plant::fmu
