#pragma once
// Applies late measurements. Keeps the last increments. Increments change only a part of the state
// (State::ins); for each increment, the value of this part before the increment is kept too. A measurement
// that is valid at an earlier epoch is applied at that epoch, and then the later increments are processed
// again. The result is bit-identical to the result without a delay.
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace canhil::filtering {

/// Keeps the increments of the last `longest_us` microseconds, but at most `Capacity` increments. Epochs are
/// the ends of increments, in integer microseconds of the measurements' time base. Every step and update of a
/// State must be made by the same History. The Model defines:
///   types State (with a member `ins`: the part that an increment changes), Increment, Measurement, Settings,
///     UpdateResult with a member `outcome` of enum Outcome (ok, not_reached, out_of_order,
///     older_than_history, ...)
///   step(state, increment, settings)
///   update(state, earlier, share, measurement, settings): applies a measurement. If earlier == nullptr, the
///     measurement is valid at the state's epoch. Otherwise the measurement is older by the fraction `share`
///     of the last increment, and `*earlier` is the value of State::ins at the start of this increment
///   keep_refusal(state, tried): copies the members that a refused update changes from `tried` to `state`
///   applied_at(t_us, now_us, settings): the epoch at which to apply a measurement that is valid at t_us
/// For a filter that also predicts between measurements, Predictions > 0 is the largest number of predictions
/// within the history, and the Model also defines
///   prediction_is_due(state, settings), predict(state, settings)
template <class Model, std::size_t Capacity, std::size_t Predictions = 0>
class History {
 public:
  using State = typename Model::State;
  using Settings = typename Model::Settings;
  using Increment = typename Model::Increment;
  using Measurement = typename Model::Measurement;
  using UpdateResult = typename Model::UpdateResult;
  using Outcome = typename Model::Outcome;

  /// Starts at start_us. Forgets each epoch that becomes older than longest_us, and the oldest epoch when
  /// Capacity is reached.
  explicit History(std::int64_t start_us, std::int64_t longest_us = std::numeric_limits<std::int64_t>::max())
      : longest_us_(longest_us) {
    entries_.reserve(Capacity);
    restart(start_us);
  }

  /// Clears the history; the state's epoch is start_us.
  void restart(std::int64_t start_us) {
    first_ = count_ = prediction_count_ = 0;
    now_us_ = last_update_us_ = start_us;
    forgotten_us_ = std::numeric_limits<std::int64_t>::min();
  }

  /// Advances the state by an increment that ends at t_us, and stores the increment.
  void propagate(State& state, const Increment& increment, std::int64_t t_us, const Settings& settings) {
    while (count_ == Capacity || (count_ > 0 && now_us_ - at(0).before_us > longest_us_)) {
      first_ = (first_ + 1) % Capacity;
      --count_;
    }
    const std::size_t place = (first_ + count_++) % Capacity;
    if (place == entries_.size())
      entries_.push_back({state.ins, increment, now_us_});
    else
      entries_[place] = {state.ins, increment, now_us_};
    now_us_ = t_us;
    step(state, increment, t_us, settings);
  }

  /// Applies a measurement that is valid at valid_us. If this time is between two epochs, applies the
  /// measurement at the later epoch; the Model then interpolates linearly the quantity that is compared with
  /// the measurement. A measurement that is refused as not_reached, out_of_order (valid before the last
  /// update) or older_than_history does not change the state.
  UpdateResult update(State& state, const Measurement& measurement, std::int64_t valid_us,
                      const Settings& settings) {
    if (valid_us > now_us_) return refused(Outcome::not_reached);
    const std::int64_t t_us = Model::applied_at(valid_us, now_us_, settings);
    if (t_us < last_update_us_) return refused(Outcome::out_of_order);
    std::size_t epoch = count_;  // epoch i < count_ is the start of increment i; epoch count_ is now
    while (epoch > 0 && epoch_us(epoch - 1) >= t_us) --epoch;
    const bool between = epoch_us(epoch) != t_us;
    if ((between && epoch == 0) || epoch_us(epoch) < forgotten_us_)
      return refused(Outcome::older_than_history);

    State then = state_at(state, epoch);
    const double share = between ? static_cast<double>(epoch_us(epoch) - t_us) /
                                       static_cast<double>(epoch_us(epoch) - epoch_us(epoch - 1))
                                 : 0;
    UpdateResult result =
        Model::update(then, between ? &at(epoch - 1).before : nullptr, share, measurement, settings);
    if (result.outcome != Outcome::ok) {
      Model::keep_refusal(state, then);
      return result;
    }
    last_update_us_ = epoch_us(epoch);
    prediction_count_ = 0;  // earlier predictions are not needed again, later ones are repeated below
    for (std::size_t i = epoch; i < count_; ++i) {
      at(i).before = then.ins;
      step(then, at(i).increment, epoch_us(i + 1), settings);
    }
    state = then;
    return result;
  }

  /// The newest epoch.
  [[nodiscard]] std::int64_t now_us() const { return now_us_; }

 private:
  struct Entry {
    decltype(State::ins) before;
    Increment increment;
    std::int64_t before_us = 0;
  };
  struct Prediction {
    State before;
    std::int64_t t_us = 0;
  };

  static UpdateResult refused(Outcome outcome) {
    UpdateResult result;
    result.outcome = outcome;
    return result;
  }
  Entry& at(std::size_t i) { return entries_[(first_ + i) % Capacity]; }
  std::int64_t epoch_us(std::size_t i) { return i < count_ ? at(i).before_us : now_us_; }

  void step(State& state, const Increment& increment, std::int64_t t_us, const Settings& settings) {
    Model::step(state, increment, settings);
    if constexpr (Predictions > 0) {
      if (!Model::prediction_is_due(state, settings)) return;
      remember_prediction(state, t_us);
      Model::predict(state, settings);
    }
  }

  // Stores the state before the filter predicts at t_us. If there is no room, drops the oldest stored state:
  // epochs before its time can then no longer be reached.
  void remember_prediction(const State& state, std::int64_t t_us) {
    if (prediction_count_ == Predictions) {
      forgotten_us_ = predictions_.front().t_us;
      for (std::size_t i = 1; i < prediction_count_; ++i) predictions_[i - 1] = predictions_[i];
      --prediction_count_;
    }
    predictions_[prediction_count_++] = {state, t_us};
  }

  // The state at an epoch: `ins` has its value at that epoch, the other members have their values from just
  // before the first prediction after that epoch.
  State state_at(const State& now, std::size_t epoch) {
    const State* then = &now;
    for (std::size_t i = prediction_count_; i > 0 && predictions_[i - 1].t_us > epoch_us(epoch); --i)
      then = &predictions_[i - 1].before;
    State state = *then;
    state.ins = epoch < count_ ? at(epoch).before : now.ins;
    Model::keep_refusal(state, now);
    return state;
  }

  std::vector<Entry> entries_;  // grows to Capacity without allocation: a target need not construct entries
                                // that it never uses
  std::array<Prediction, Predictions> predictions_;
  std::int64_t longest_us_;
  std::size_t first_ = 0, count_ = 0, prediction_count_ = 0;
  std::int64_t now_us_ = 0, last_update_us_ = 0;
  std::int64_t forgotten_us_ = 0;  // states before this epoch have been dropped
};

}  // namespace canhil::filtering
