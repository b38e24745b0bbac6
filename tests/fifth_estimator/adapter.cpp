// Connects the baro-inertial height filter to the bus: receives the groups SlaveImu and Barometer, sends the
// group Height.
#include <array>
#include <optional>

#include "dbc/wire/time_base.hpp"
#include "target/device/adapters.hpp"
#include "target/device/fix_queue.hpp"
#include "target/device/imu_stream.hpp"
#include "target/device/tuned_adapter.hpp"
#include "tests/fifth_estimator/vertical_channel.hpp"

namespace canhil::target {
namespace {

using namespace messages;

constexpr double ug = 1e-6 * 9.80665;

using Row = ParameterTable<baro_inertial::Settings>::Row;
constexpr std::array rows{
    Row{Parameter::accel_bias_sigma_ug, 300, 0, 1e6, false, false,
        "1-sigma of the accelerometer bias at the start.",
        [](baro_inertial::Settings& s, double v) { s.accel_bias_sigma_0 = v * ug; }},
    Row{Parameter::accel_noise_ugprthz, 50, 0, 1e6, false, true, "White noise assumed of the accelerometer.",
        [](baro_inertial::Settings& s, double v) { s.accel_noise_density = v * ug; }},
    Row{Parameter::fix_noise_vertical_m, 1, 1e-3, 1e4, false, true, "White noise assumed of a fix, 1-sigma.",
        [](baro_inertial::Settings& s, double v) { s.barometer_sigma = v; }},
    Row{Parameter::gate_nis, 0, 0, 1e6, false, true,
        "Fixes with a larger normalised innovation squared (NIS) are refused; 0: no gate.",
        [](baro_inertial::Settings& s, double v) { s.gate = v; }},
};

class BaroInertialAdapter final : public TunedAdapter<baro_inertial::Settings> {
 public:
  BaroInertialAdapter() : TunedAdapter(rows) {}

  [[nodiscard]] Estimator estimator() const override { return Estimator::baro_inertial; }

  bool reset(Algorithm algorithm) override {
    if (algorithm != Algorithm::kalman) return false;
    reset_parameters();
    imu_.reset();
    group_.discard();
    return true;
  }

  void start(const InitialState& initial) override {
    tuning_.height_sigma_0 = initial.position_sigma;
    tuning_.velocity_sigma_0 = initial.velocity_sigma;
    channel_.start(nav_of(initial), tuning_);
    imu_.start(initial.t_us, 0);
    pending_.clear();
  }

  Health receive(const Frame& frame, std::uint8_t counter, Context context) override {
    const auto step = [this](const strapdown::ImuIncrement& imu, std::int64_t) {
      channel_.propagate(imu, tuning_);
    };
    const auto reached = [&] {
      if (!channel_.finite()) return numeric_fault(context);
      return pending_.reached(imu_.now_us(), [&](const At<double>& fix) { return answer(fix, context); });
    };
    if (const auto health = imu_.receive(frame, counter, context, step, reached)) return *health;
    if (frame.id == BarometerHeight::info.id && completes<BarometerHeight>(group_, frame, counter, context)) {
      const auto& measured = group_.get<BarometerHeight>();
      const At<double> fix{unwrap_us(measured.time_of_validity_us, context.now_us), counter,
                           measured.height_m};
      if (fix.t_us < imu_.now_us()) {
        ++context.losses.late;  // this simple adapter stores no earlier states, so it drops a late fix
      } else if (fix.t_us == imu_.now_us()) {
        return answer(fix, context);
      } else if (!pending_.push(fix)) {
        drop_group(context);
      }
    }
    return Health::good;
  }

  Health tick(Context context) override { return imu_.tick(context); }

 private:
  Health answer(const At<double>& fix, Context& context) {
    const bool used = channel_.update(fix.value, tuning_) == baro_inertial::Outcome::used;
    const Eigen::Vector3d sigma = channel_.P().diagonal().cwiseMax(0).cwiseSqrt();
    context.answers.send(
        HeightEstimate{.height_m = channel_.nav().height, .velocity_down_mps = channel_.nav().v_eb_n.z()});
    context.answers.send(HeightSigma{.height_sigma_m = sigma(0), .velocity_sigma_down_mps = sigma(1)});
    context.answers.send(
        HeightBias{.accel_bias_z_ug = channel_.bias() / ug, .accel_bias_sigma_z_ug = sigma(2) / ug});
    context.answers.send(HeightUpdate{.cause_time_us = wrap_us(fix.t_us),
                                      .cause_counter = fix.counter,
                                      .nis = channel_.nis(),
                                      .used = static_cast<std::uint8_t>(used)});
    return Health::good;
  }

  baro_inertial::VerticalChannel channel_;
  ImuStream imu_;
  SampleGroup<BarometerHeight> group_;
  FixQueue<double, 8> pending_;
};

}  // namespace

std::unique_ptr<Adapter> make_baro_inertial_adapter() { return std::make_unique<BaroInertialAdapter>(); }

}  // namespace canhil::target
