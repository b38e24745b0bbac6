"""An independent estimator of the LOS rate: Kalman filter, gains by range (Na and Lee), low-pass filter; as a target of the bench."""

import os

os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")  # before numpy: threads cost more than matrices of this size

import math  # noqa: E402
from typing import NamedTuple, Optional  # noqa: E402

import defects  # noqa: E402
from canhil_target import Estimator, Parameter  # noqa: E402
from los_rate_estimate import ACCELERATION, PUSH, RATE, TURN, Estimate  # noqa: E402
from los_rate_gains import Noise, low_pass_gain, range_gain  # noqa: E402
from los_rate_inputs import Approach, Motion  # noqa: E402

FAULTS = ("error_angle", "field_of_view", "antenna", "acceleration", "range_invalid", "range_stale", "range_jump", "closing_speed_invalid")


class Monitor:
    """Watches the normalised innovation squared (NIS): its mean over some 20 updates against the 2 degrees of freedom."""
    MEMORY = 20
    ALARM, QUIET = 2 + 6 * math.sqrt(4 / (2 * MEMORY - 1)), 2 + 2 * math.sqrt(4 / (2 * MEMORY - 1))  # the NIS has the variance 4

    def __init__(self):
        self.mean, self.degraded = 2.0, False

    def step(self, nis):
        self.mean += (nis - self.mean) / self.MEMORY
        self.degraded = self.mean > (self.QUIET if self.degraded else self.ALARM)


class Seen(NamedTuple):
    """The values of a sample in both planes, yaw + j pitch, accelerations a_y - j a_z; None: marked invalid."""
    range_m: Optional[float]
    closing_speed_mps: Optional[float]
    error_rad: Optional[complex]
    turn_rate_radps: Optional[complex]
    roll_rate_radps: Optional[complex]
    acceleration_mps2: Optional[complex]


def read(values, interval):
    def if_valid(what, value):
        return value if values[what + "_validity"] == "valid" else None

    turned = complex(values["antenna_increment_yaw_rad"], values["antenna_increment_pitch_rad"])
    return Seen(if_valid("range", values["range_m"]),
                if_valid("closing_speed", values["closing_speed_mps"]),
                if_valid("error", complex(values["error_yaw_rad"], values["error_pitch_rad"])),
                if_valid("antenna", turned / interval),
                if_valid("antenna", complex(values["antenna_increment_roll_rad"] / interval)),
                if_valid("acceleration", complex(values["missile_acceleration_y_mps2"], -values["missile_acceleration_z_mps2"])))


class Filter(Estimator):
    estimator = "los_rate"
    algorithms = ("combined", "switched_table", "kalman", "low_pass")
    answers = {"Seeker": "LosRate"}
    parameters = {
        "jerk_density_m2ps5": Parameter(300, 1e-3, 1e6),
        "thermal_noise_pitch_radpm2": Parameter(1e-10, 1e-14, 1e-6),
        "thermal_noise_yaw_radpm2": Parameter(1e-10, 1e-14, 1e-6),
        "glint_noise_pitch_m": Parameter(0.5, 1e-3, 100),
        "glint_noise_yaw_m": Parameter(0.5, 1e-3, 100),
        "constant_noise_pitch_rad": Parameter(0, 0, 0.1),
        "constant_noise_yaw_rad": Parameter(0, 0, 0.1),
        "sample_period_ms": Parameter(5, 0.5, 50),
        "los_rate_sigma_radps": Parameter(0.05, 1e-6, 10),
        "target_acceleration_sigma_mps2": Parameter(40, 1e-3, 1e4),
        "start_up_s": Parameter(2.5, 0, 100),
        "gap_limit_ms": Parameter(50, 0, 1e4),
        "low_pass_bandwidth_radps": Parameter(8, 0.1, 200),
        "low_pass_damping": Parameter(math.sqrt(0.5), 0.1, 5),
        "range_max_m": Parameter(1e4, 100, 1e5),
        "closing_speed_max_mps": Parameter(2000, 10, 1e4),
        "blind_range_m": Parameter(50, 0, 1e4),
        "range_sigma_m": Parameter(15, 0, 1e3),
        "range_gate_m": Parameter(100, 1, 1e5),
        "closing_speed_gate_mps": Parameter(100, 1, 1e4),
        "relock_samples": Parameter(10, 1, 1e4, whole=True),
        "range_unchanged_limit_ms": Parameter(100, 0, 1e4),
        "field_of_view_rad": Parameter(0.15, 1e-3, 0.6),
        "antenna_rate_sigma_radps": Parameter(0.5, 0, 100),
        "missile_acceleration_sigma_mps2": Parameter(100, 0, 1e4),
        "antenna_rate_bias_sigma_radps": Parameter(0, 0, 1),
    }

    def start(self, algorithm, parameters, initial):
        self.algorithm, self.p = algorithm, dict(parameters)
        p = self.p
        self.noises = [Noise(p[f"thermal_noise_{plane}_radpm2"], p[f"glint_noise_{plane}_m"], p[f"constant_noise_{plane}_rad"])
                       for plane in ("yaw", "pitch")]
        self.period = 1e-3 * p["sample_period_ms"]
        self.gap_limit_s = 1e-3 * p["gap_limit_ms"] + 1e-6  # a gap of the limit itself is bridged; 1 us is the resolution of the times
        self.approach = Approach(p["range_gate_m"], p["closing_speed_gate_mps"], p["relock_samples"], 1e-3 * p["range_unchanged_limit_ms"])
        self.turning = Motion(p["antenna_rate_sigma_radps"], self.gap_limit_s)
        self.rolling = Motion(p["antenna_rate_sigma_radps"], self.gap_limit_s)
        self.pushing = Motion(p["missile_acceleration_sigma_mps2"], self.gap_limit_s)
        self.monitor = Monitor()
        self.estimate = self.t = None
        self.whole_at = self.start_up_ends = 0.0
        self.after_whole = False

    def sample(self, group, values, t_us):
        t = 1e-6 * t_us
        interval = 1e-6 * values["interval_us"] or self.period
        dt = interval if self.t is None else t - self.t
        self.t = t
        gap = max(dt - interval, 0.0)
        gap = gap if gap > 0.1 * interval else 0.0  # a sample that is a little late has no gap before it

        seen = read(values, interval)
        wrong = self.approach.step(seen.range_m, seen.closing_speed_mps, dt)
        measured = seen.error_rad
        if measured is None:
            wrong.append("error_angle")
        elif max(abs(measured.real), abs(measured.imag)) > self.p["field_of_view_rad"]:
            wrong.append("field_of_view")
            measured = None
        if seen.turn_rate_radps is None:
            wrong.append("antenna")
        if seen.acceleration_mps2 is None:
            wrong.append("acceleration")
        fault = min(wrong, key=FAULTS.index, default="none")

        if self.estimate is not None:
            outcome, nis = self.step(measured, seen, dt, gap)
        elif measured is not None and self.approach.known:
            outcome, nis = self.first(measured, seen, dt, gap)
        else:
            return {"outcome": "waiting", "fault": fault}
        return self.answer(outcome, fault, nis)

    # -- range --

    def least_range_m(self):
        return max(self.p["blind_range_m"], 3 * self.p["range_sigma_m"], 10 * self.period * self.approach.speed.value, 20.0)

    def range_m(self):
        """The range for the equations, which do not hold at a smaller one than the least usable range."""
        return max(self.approach.range.value, self.least_range_m())

    def variances(self):
        return [noise.variance(self.range_m()) for noise in self.noises]

    # -- estimate --

    def first(self, measured, seen, dt, gap):
        p = self.p
        gyro_bias = p["antenna_rate_bias_sigma_radps"] if self.algorithm == "combined" else 0.0
        self.estimate = Estimate(measured, self.variances(), p["los_rate_sigma_radps"], p["target_acceleration_sigma_mps2"], gyro_bias)
        self.move(seen, dt, gap)
        self.whole_at, self.after_whole = self.t, True
        self.start_up_ends = self.t + p["start_up_s"]
        return "started", 0.0

    def move(self, seen, dt, gap):
        return self.turning.step(seen.turn_rate_radps, dt, gap), self.rolling.step(seen.roll_rate_radps, dt, gap), \
            self.pushing.step(seen.acceleration_mps2, dt, gap)

    def step(self, measured, seen, dt, gap):
        """Predicts, and corrects the prediction if there is a measurement. Returns outcome and NIS."""
        (turn_rate, not_turned_s, turn_sigmas), (roll_rate, _, _), (acceleration, not_pushed_s, push_sigmas) = self.move(seen, dt, gap)
        self.estimate.consider(TURN, turn_sigmas, lasts=seen.turn_rate_radps is None)
        self.estimate.consider(PUSH, push_sigmas, lasts=seen.acceleration_mps2 is None)
        range_m = math.inf if self.algorithm == "low_pass" else self.range_m()  # the low-pass filter knows neither range nor accelerations
        self.estimate.predict(dt, range_m, self.approach.speed.value, turn_rate * dt, roll_rate.real * dt, acceleration,
                              self.p["jerk_density_m2ps5"], not_turned_s, not_pushed_s)
        steady = self.after_whole and not_turned_s == not_pushed_s == 0
        if self.t - self.whole_at - (dt - gap) > self.gap_limit_s:  # the covariance is far from the stationary one, and so is the gain
            self.start_up_ends = self.t + self.p["start_up_s"]
        self.after_whole = None not in (measured, seen.turn_rate_radps, seen.acceleration_mps2)
        if self.after_whole:
            self.whole_at = self.t
        if measured is None:
            return "coasting", 0.0
        nis = self.estimate.innovate(measured, self.variances())
        self.monitor.step(nis)
        starts_up = self.algorithm in ("combined", "switched_table") and self.t < self.start_up_ends
        self.estimate.update(self.gain(dt, steady and not starts_up))
        return "start_up" if starts_up else "updated", nis

    def gain(self, dt, steady):
        """steady: the covariance is the stationary one, so that range and closing speed define the gain."""
        if self.algorithm == "low_pass":
            both = *low_pass_gain(self.p["low_pass_bandwidth_radps"], self.p["low_pass_damping"], dt), 0.0
            return self.estimate.gain_of(both, both)
        r, vc = self.range_m(), self.approach.speed.value
        outside = abs(vc) > self.p["closing_speed_max_mps"] or (self.algorithm == "combined" and r > self.p["range_max_m"])
        if self.algorithm == "kalman" or not steady or outside:
            return self.estimate.kalman_gain()
        noises = [noise.dominant(r) for noise in self.noises] if self.algorithm == "switched_table" else self.noises
        yaw, pitch = (range_gain(noise, self.p["jerk_density_m2ps5"], r, vc, self.period) for noise in noises)
        return self.estimate.gain_of(yaw, pitch)

    # -- answer --

    def answer(self, outcome, fault, nis):
        estimate = self.estimate
        if not math.isfinite(abs(estimate.rate) + abs(estimate.acceleration)):
            raise ArithmeticError("the estimate is not finite")
        rate_sigma_yaw, rate_sigma_pitch = estimate.sigmas(RATE)
        acceleration_sigma_y, acceleration_sigma_z = estimate.sigmas(ACCELERATION)
        return {"outcome": outcome, "fault": fault, "nis": nis,
                "blind": int(self.approach.range.value < self.least_range_m()), "degraded": int(self.monitor.degraded),
                "los_rate_pitch_radps": estimate.rate.imag, "los_rate_yaw_radps": estimate.rate.real,
                "los_rate_sigma_pitch_radps": rate_sigma_pitch, "los_rate_sigma_yaw_radps": rate_sigma_yaw,
                "target_acceleration_y_mps2": estimate.acceleration.real, "target_acceleration_z_mps2": -estimate.acceleration.imag,
                "target_acceleration_sigma_y_mps2": acceleration_sigma_y, "target_acceleration_sigma_z_mps2": acceleration_sigma_z}


if __name__ == "__main__":
    defects.main(Filter, sign_of="antenna_increment_pitch_rad", delay_of=("error_pitch_rad", "error_yaw_rad"))
