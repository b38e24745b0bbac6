// The bank of filters: its weights and its mixture compared with their definition, and its response to
// changes.
#include "target/estimators/wind/bank.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "target/estimators/filtering/cholesky.hpp"
#include "tests/unit/target/estimators/wind/flown.hpp"

namespace canhil::wind {
namespace {

Settings likeliest() {
  Settings settings;
  settings.algorithm = Algorithm::adaptive_q;
  settings.process_noise = ProcessNoise::likeliest;
  settings.density.rate = 0.2 * rad_per_deg;
  return settings;
}

Bank released(const RecordedRun& run, const BankDesign& design) {
  Bank bank = initial(design);
  for (State& state : bank.states) state = run.release();
  return bank;
}

// Passes the bank and the result of each sample to `inspect`.
template <class Inspect>
void fly(const RecordedRun& run, const BankDesign& design, const Inspect& inspect) {
  Bank bank = released(run, design);
  FinHistory fins;
  for (std::size_t k = 0; k < run.y.size(); ++k) {
    fins.push(RecordedRun::t_us(k), run.inputs[k].fins, design.of[0].airframe.deflection_most);
    const UpdateResult result = step(bank, run.navigation(k), fins, design);
    inspect(k, bank, result);
  }
}

TEST(WindBank, OfOneFilterIsThatFilterBitForBit) {
  const RecordedRun run;
  for (const ProcessNoise noise :
       {ProcessNoise::block_diagonal, ProcessNoise::correlated, ProcessNoise::aerodynamic}) {
    Settings settings = likeliest();
    settings.process_noise = noise;
    const Flown flown = fly(run, settings);
    fly(run, make_bank(settings), [&](std::size_t k, const Bank& bank, const UpdateResult& result) {
      ASSERT_EQ(bank.x, flown.states[k].x);
      ASSERT_EQ(bank.P, reported_covariance(flown.states[k], settings));
      ASSERT_EQ(result.nis, flown.results[k].nis);
      ASSERT_EQ(bank.weight[0], 1);
    });
  }
}

TEST(WindBank, ForgetsWhatWasLikely) {
  const RecordedRun run;
  const BankDesign design = make_bank(likeliest());
  Bank bank = released(run, design);
  FinHistory fins;
  for (std::size_t k = 0; k < 10; ++k) {
    fins.push(RecordedRun::t_us(k), run.inputs[k].fins, 1);
    const double J = bank.surprise[0];
    State alone = bank.states[0];
    const double now = step(alone, run.navigation(k), fins, design.of[0]).surprise;
    step(bank, run.navigation(k), fins, design);
    EXPECT_DOUBLE_EQ(bank.surprise[0], J * (k == 0 ? 1 : std::exp(-0.02 / 1.0)) + now);
  }
}

TEST(WindBank, WeighsByLikelihoodsAndAddsTheSpread) {
  const RecordedRun run;
  const BankDesign design = make_bank(likeliest());
  fly(run, design, [&](std::size_t, const Bank& bank, const UpdateResult&) {
    const auto& J = bank.surprise;
    const double odds = design.odds[1] / design.odds[0] * std::exp((J[0] - J[1]) / 2);
    EXPECT_NEAR(bank.weight[0] + bank.weight[1], 1, 1e-12);
    EXPECT_NEAR(bank.weight[1], odds / (1 + odds), 1e-12);
    const StateVector x = bank.weight[0] * bank.states[0].x + bank.weight[1] * bank.states[1].x;
    EXPECT_LT((bank.x - x).cwiseAbs().maxCoeff(), 1e-9);
    Covariance P = Covariance::Zero();
    for (std::size_t i = 0; i < bank_most; ++i) {
      const StateVector d = bank.states[i].x - x;
      P += bank.weight[i] * (reported_covariance(bank.states[i], design.of[i].settings) + d * d.transpose());
    }
    EXPECT_LT((bank.P - P).cwiseAbs().maxCoeff(), 1e-9);
    ASSERT_EQ(bank.P, bank.P.transpose());
    ASSERT_TRUE(filtering::is_positive_definite<12>(bank.P));
  });
}

// The surprise is -2 ln of a Gaussian density without its constant term, here computed by dense algebra.
TEST(WindBank, SurpriseIsThatOfTheInnovation) {
  const RecordedRun run;
  const Design design = make_design(likeliest());
  State state = run.release();
  StateVector x = state.x;
  Covariance P = state.P;
  const GroundVelocity at = ground_velocity(x);
  filtering::Matrix<9, 12> H = filtering::Matrix<9, 12>::Zero();
  H.topLeftCorner<3, 3>() = at.C_bn;
  H.block<3, 3>(0, attitude_at) = at.by_attitude;
  H.block<3, 3>(0, wind_at).setIdentity();
  H.block<6, 6>(3, rate_at).setIdentity();
  const Settings& s = design.settings;
  Observation variance;
  variance << Eigen::Vector3d::Constant(s.velocity_sigma * s.velocity_sigma),
      Eigen::Vector3d::Constant(s.rate_sigma * s.rate_sigma),
      Eigen::Vector3d::Constant(s.attitude_sigma * s.attitude_sigma);
  filtering::Matrix<9, 9> S = H * P * H.transpose();
  S.diagonal() += variance;
  const Observation nu = innovation_of(run.y[0], x, at);
  const double expected = nu.dot(S.inverse() * nu) + std::log(S.determinant());
  EXPECT_NEAR(update(x, P, run.y[0], 0.02, design).surprise, expected, 1e-6 * std::abs(expected));
}

// A wind change of 15 m/s within 2 s must not be taken for an error of a coefficient.
TEST(WindBank, BelievesInGustsWhileThereAreSome) {
  const RecordedRun run;
  const BankDesign design = make_bank(likeliest());
  Bank bank = released(run, design);
  FinHistory fins;
  double before = 0, largest = 0;
  for (std::size_t k = 0; k < 600; ++k) {
    fins.push(RecordedRun::t_us(k), run.inputs[k].fins, design.of[0].airframe.deflection_most);
    Navigation navigation = run.navigation(k);
    // The glider moves with the air, so the ground velocity changes with the wind.
    if (k > 300) navigation.v_eb_n.x() += 7.5 * std::min(0.02 * static_cast<double>(k - 300), 2.0);
    step(bank, navigation, fins, design);
    if (k == 300) before = bank.weight[1];
    largest = std::max(largest, bank.weight[1]);
  }
  EXPECT_LT(before, 0.1);
  EXPECT_GT(largest, 0.9);
}

TEST(WindBank, AFilterThatIsAskedForLaterBeginsWhereTheFirstIs) {
  const RecordedRun run;
  Settings settings = likeliest();
  settings.process_noise = ProcessNoise::aerodynamic;
  const BankDesign one = make_bank(settings), two = make_bank(likeliest());
  Bank bank = released(run, one);
  FinHistory fins;
  for (std::size_t k = 0; k < 100; ++k) {
    fins.push(RecordedRun::t_us(k), run.inputs[k].fins, 1);
    step(bank, run.navigation(k), fins, one);
  }
  Bank later = bank;
  step(later, run.navigation(100), fins, two);
  EXPECT_GT(later.weight[1], 0);
  EXPECT_LT((later.states[1].x - later.states[0].x).norm(), 1);
  step(later, run.navigation(101), fins, one);
  EXPECT_EQ(later.weight[1], 0);
  EXPECT_EQ(later.x, later.states[0].x);
}

}  // namespace
}  // namespace canhil::wind
