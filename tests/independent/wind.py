"""Wind of a glider without an air-speed sensor, written from docs/, the DBC and the spec of Park and Park (2019) alone.

    hil-bench accept --estimator wind --target 'python3 tests/independent/wind.py'
"""

import math
import os

for library in ("OMP", "OPENBLAS", "MKL"):
    os.environ[library + "_NUM_THREADS"] = "1"

import numpy as np  # noqa: E402  (reads the numbers of threads)

import defects  # noqa: E402  (names the folder of the kit)
import canhil_target  # noqa: E402
import wind_filter  # noqa: E402
import wind_model  # noqa: E402
from canhil_target import Parameter  # noqa: E402
from wind_filter import DEGREE, WIND  # noqa: E402
from wind_target import FINS, NAVIGATION, FinRecord, Target  # noqa: E402

AHEAD_US = 200_000  # navigation from further ahead is not believed
JUMPS_TO_RESTART = 25
PHYSICAL_SPEED_MPS, PHYSICAL_RATE_DEGPS, PHYSICAL_HEIGHT_M = 600.0, 300.0, (-1000.0, 30000.0)
STEEPEST_DEG = 85.0  # Euler angles are singular at 90 deg
SETTLING_S, MISTRUST_S = 1.0, 5.0  # degraded for this time after the start, and after a cause
VELOCITY = tuple(f"velocity_{axis}_mps" for axis in ("north", "east", "down"))
RATES = tuple(f"rate_{axis}_degps" for axis in "xyz")
ANGLES = ("roll_deg", "pitch_deg", "heading_deg")
AIR_VELOCITY = tuple(f"air_velocity_{axis}_mps" for axis in "xyz")


class NisMonitor:
    """An alarm while the mean NIS of about 20 updates is too large. chi2 with 9 degrees of freedom: mean 9, variance 18."""
    MEMORY = 20
    SIGMA = math.sqrt(18 / (2 * MEMORY - 1))  # of the exponentially weighted mean

    def __init__(self):
        self.mean, self.alarm = 9.0, False

    def see(self, nis):
        self.mean += (min(nis, 9 + 6 * math.sqrt(18)) - self.mean) / self.MEMORY
        self.alarm = self.mean > 9 + (2 if self.alarm else 6) * self.SIGMA


class Wind(canhil_target.Estimator):
    estimator = "wind"
    algorithms = ("ekf", "h_infinity", "adaptive_q")
    answers = {NAVIGATION: "Wind", FINS: None}
    parameters = {
        "output_interval_ms": Parameter(20, 1, 1000, while_running=True),
        "process_noise": Parameter(3, 0, 3, whole=True, while_running=True),
        "air_velocity_noise_mpsprts": Parameter(0.02, 0, 1000, while_running=True),
        "body_rate_noise_degpsprts": Parameter(0.2, 0, 1000, while_running=True),
        "attitude_noise_degprts": Parameter(0.01, 0, 100, while_running=True),
        "wind_noise_mpsprts": Parameter(0.3, 0, 1000, while_running=True),
        "glider_velocity_sigma_mps": Parameter(0.25, 0.001, 1000, while_running=True),
        "glider_rate_sigma_degps": Parameter(0.125, 0.001, 100, while_running=True),
        "glider_attitude_sigma_deg": Parameter(0.25, 0.001, 45, while_running=True),
        "theta_per_s": Parameter(1.5, 0, 1000, while_running=True),
        "theta_cap_per_s": Parameter(2, 0, 1000, while_running=True),
        "theta_rate_weight": Parameter(1, 0, 1e8, while_running=True),
        "adaptation_time_s": Parameter(0.3, 0.001, 1000, while_running=True),
        "adaptation_limit": Parameter(1e4, 1, 1e8, while_running=True),
        "initial_air_velocity_sigma_mps": Parameter(1, 0.001, 1000),
        "initial_rate_sigma_degps": Parameter(0.01, 0.0001, 100),
        "initial_wind_sigma_mps": Parameter(20, 0.001, 1000),
        "fins_late_ms": Parameter(30, 1, 10000, while_running=True),
        "fins_missing_ms": Parameter(100, 1, 10000, while_running=True),
        "glider_nav_coast_s": Parameter(2, 0, 10, while_running=True),
        "glider_nav_stale_ms": Parameter(100, 1, 1e6, while_running=True),
        "glider_nav_gate_mps": Parameter(50, 1, 1e6, while_running=True),
        "coefficient_sigma_percent": Parameter(5, 0, 100, while_running=True),
        "nav_velocity_bias_sigma_mps": Parameter(0.25, 0, 100, while_running=True),
        "nav_attitude_bias_sigma_deg": Parameter(0.25, 0, 45, while_running=True),
    }
    degraded = False

    def start(self, algorithm, parameters, initial):
        self.algorithm, self.parameter = algorithm, parameters
        self.settings = wind_filter.Settings(algorithm, parameters)
        self.fins, self.monitor = FinRecord(), NisMonitor()
        self.bank = None  # no filter runs
        self.now_us, self.newest_us = 0, -1  # the bench's time base, the newest sample
        self.used_s = self.predicted_s = self.started_s = 0.0  # newest sample that was used, time of the state, start of the filter
        self.mistrusted_s, self.marks = -math.inf, {}
        self.jumps, self.content, self.content_s = 0, None, 0.0
        self.height, self.refused, self.degraded = initial["height_m"], "", True
        self.begin(initial)

    def begin(self, initial):
        """The state before the first sample. Without an initial air velocity the wind is only known to be less than some 20 m/s."""
        p = self.parameter
        velocity, attitude = values_of(initial, VELOCITY), values_of(initial, ANGLES) * DEGREE
        sigma = [initial["tilt_sigma_deg"] * DEGREE] * 2 + [initial["heading_sigma_deg"] * DEGREE]
        self.initial, self.initial_us = None, round(initial["time_of_validity_us"])
        self.wind, self.wind_covariance = np.zeros(3), np.eye(3) * p["initial_wind_sigma_mps"] ** 2
        self.wind_sensitivity = np.zeros((3, wind_filter.CONSIDERED))
        if AIR_VELOCITY[0] in initial:
            sigmas = [[p["initial_air_velocity_sigma_mps"]] * 3, [p["initial_rate_sigma_degps"] * DEGREE] * 3, sigma,
                      [initial["velocity_sigma_mps"]] * 3]
            self.initial = wind_filter.from_air_velocity(values_of(initial, AIR_VELOCITY), values_of(initial, RATES) * DEGREE, attitude, velocity,
                                                         np.concatenate(sigmas) ** 2)
            self.remember(self.initial.x, self.initial.P, self.initial.sensitivity)

    def remember(self, x, covariance, sensitivity):
        """The wind, from which the filter can start again."""
        self.wind, self.wind_covariance, self.wind_sensitivity = x[WIND].copy(), covariance[WIND, WIND].copy(), sensitivity[WIND].copy()

    def sample(self, group, values, t_us):
        if self.settings.parameters != self.parameter:  # the bench may set parameters in flight
            self.settings = wind_filter.Settings(self.algorithm, self.parameter)
        self.refused = ""
        if group == FINS:
            deflections = [values[name + "_deg"] for name in ("elevator", "aileron", "rudder")]
            physical = all(abs(one) <= FinRecord.PHYSICAL_DEG for one in deflections)
            self.refused = self.fins.add(t_us * 1e-6, tuple(one * DEGREE for one in deflections), physical)
            return {}
        if t_us > self.now_us + AHEAD_US:
            self.refused = "bad_group"
            return self.answer("future")
        if t_us <= self.newest_us:
            self.refused = "late"
            return self.answer("out_of_order")
        self.newest_us = t_us
        outcome, fault = self.navigation(values, t_us * 1e-6)
        self.watch(t_us * 1e-6)
        answer = self.answer(outcome, fault)
        self.fins.gap_s = 0.0
        return answer

    # -- navigation --

    def navigation(self, values, t):
        """Processes a sample. Returns its outcome and its fault."""
        fault = self.fault_of(values, t)
        if fault == "invalid":
            self.refused = "bad_group"
        measured = np.concatenate([values_of(values, VELOCITY), values_of(values, RATES) * DEGREE, values_of(values, ANGLES) * DEGREE])
        coast = self.parameter["glider_nav_coast_s"]
        if self.bank is not None and t - self.used_s > coast:
            self.remember(self.bank.x, self.bank.reported(self.settings), np.zeros((12, wind_filter.CONSIDERED)))
            self.wind_covariance = self.wind_covariance + np.eye(3) * self.settings.density[9] * (t - self.predicted_s)
            self.bank = None
        if self.bank is None:
            if fault != "none":
                return "waiting", fault
            return self.begin_with(values, measured, t, coast), "none"
        elapsed = t - self.predicted_s
        self.predict(t)
        if not self.bank.is_sound():
            return self.stop_not_finite()
        if fault == "none":
            innovation = measured[:3] - wind_filter.expected(self.bank.x)[0][:3]
            if np.linalg.norm(innovation) > self.parameter["glider_nav_gate_mps"]:
                fault = "jump"
        self.jumps = self.jumps + 1 if fault == "jump" else 0
        if self.jumps >= JUMPS_TO_RESTART:  # a jump that stays is the truth; then nothing is known about the wind
            self.wind_covariance = np.eye(3) * self.parameter["initial_wind_sigma_mps"] ** 2
            self.wind, self.wind_sensitivity = self.bank.x[WIND].copy(), np.zeros((3, wind_filter.CONSIDERED))
            return self.begin_with(values, measured, t, coast), "none"
        if fault != "none":
            return "coasting", fault
        return self.update(values, measured, t, elapsed), "none"

    def fault_of(self, values, t):
        content = tuple(values[name] for name in (*VELOCITY, *RATES, *ANGLES, "height_m"))
        if content != self.content:
            self.content, self.content_s = content, t
        if values["navigation_validity"] != "valid":
            return "invalid"
        if not all(map(math.isfinite, content)):
            return "not_finite"
        largest = [max(map(abs, content[first:first + 3])) for first in (0, 3, 6)]
        if (any(value > limit for value, limit in zip(largest, (PHYSICAL_SPEED_MPS, PHYSICAL_RATE_DEGPS, 180.01)))
                or not PHYSICAL_HEIGHT_M[0] <= values["height_m"] <= PHYSICAL_HEIGHT_M[1]):
            return "not_physical"
        if abs(values["pitch_deg"]) > STEEPEST_DEG:
            return "pitch"
        return "stale" if t - self.content_s > self.parameter["glider_nav_stale_ms"] * 1e-3 else "none"

    def begin_with(self, values, measured, t, coast):
        """The filter starts with this sample: from the initial state if it is recent, otherwise from navigation and what is known of the wind."""
        age = (((round(t * 1e6) - self.initial_us) + 2**31) % 2**32 - 2**31) * 1e-6
        recent = self.initial is not None and 0 <= age <= coast
        begin = self.initial if recent else wind_filter.from_wind(self.wind, self.wind_covariance, self.wind_sensitivity, measured, self.settings)
        self.bank = wind_filter.Bank(begin, self.settings)
        self.monitor, self.jumps, self.started_s = NisMonitor(), 0, t
        self.predicted_s = t - age if recent else t
        if recent:
            if age > 0:
                self.predict(t)
            self.update(values, measured, t, max(age, wind_filter.LONGEST_STEP_S))
        else:
            self.used_s, self.height = t, values["height_m"]
        self.initial = None
        return "started"

    def predict(self, t):
        known = self.fins.age(t) * 1e3 <= self.parameter["fins_missing_ms"]
        self.height = self.bank.predict(t - self.predicted_s, self.fins.at, self.predicted_s, self.height, self.settings, known)
        self.predicted_s = t

    def update(self, values, measured, t, elapsed):
        try:
            self.bank.update(measured, elapsed, self.settings)
        except np.linalg.LinAlgError:
            return self.stop_not_finite()[0]
        if not self.bank.is_sound():
            return self.stop_not_finite()[0]
        self.used_s, self.height = t, values["height_m"]
        self.monitor.see(self.bank.of_filters("nis"))
        return "updated"

    def stop_not_finite(self):
        """The next sample starts the filter anew."""
        self.bank = None
        self.wind_covariance = np.eye(3) * self.parameter["initial_wind_sigma_mps"] ** 2
        return "non_finite", "none"

    # -- answers --

    def watch(self, t):
        """Whether the sigmas hold: not while the model has no deflections or is outside its range, nor while innovations contradict them."""
        late, missing = self.parameter["fins_late_ms"] * 1e-3, self.parameter["fins_missing_ms"] * 1e-3
        age = self.fins.age(t)
        self.marks = {"fins_late": max(age, self.fins.gap_s) > late, "fins_missing": age > missing, "fins_not_physical": self.fins.not_physical}
        outside = []
        if self.bank is not None:
            outside = wind_model.outside(self.bank.x, self.height, wind_model.standard_air(self.height)[1])
            self.marks.update({"outside_" + name: True for name in outside})
            self.marks["theta_capped"] = self.bank.capped
        settling = self.bank is None or t - self.started_s < SETTLING_S
        if not settling and (outside or self.marks["fins_missing"]):
            self.mistrusted_s = t
        self.degraded = settling or t - self.mistrusted_s < MISTRUST_S or self.monitor.alarm

    def answer(self, outcome, fault="none"):
        answer = {"outcome": outcome, "fault": fault, "started": self.bank is not None, "degraded": self.degraded, **self.marks}
        if self.bank is None:
            answer.update(of_wind(self.wind, self.wind_covariance))
            return answer
        x, covariance = self.bank.x, self.bank.reported(self.settings)
        north, east, _ = wind_model.body_to_ned(*x[6:9]) @ x[:3]
        answer.update(of_wind(x[WIND], covariance[WIND, WIND]), **of_track(covariance[9:11, 9:11], north, east))
        answer.update(zip(AIR_VELOCITY, x[:3].tolist()))
        answer.update(zip(ANGLES, (wind_filter.wrapped(x[6:9]) / DEGREE).tolist()))
        answer.update(zip(("innovation_north_mps", "innovation_east_mps", "innovation_down_mps"), self.bank.of_filters("innovation")[:3].tolist()))
        answer["nis"] = self.bank.of_filters("nis")
        return answer


def values_of(values, names):
    return np.array([values[name] for name in names])


def of_wind(wind, covariance):
    """The wind, its sigmas and correlations, and the horizontal wind as speed and direction."""
    north, east, down = wind.tolist()
    sigma = np.sqrt(covariance.diagonal())
    correlation = (covariance / np.outer(sigma, sigma)).tolist()
    sigma = sigma.tolist()
    speed = max(math.hypot(north, east), 1e-3)  # below it, the direction is not known anyway
    along, across = (north / speed, east / speed), (-east / speed, north / speed)
    return {"wind_north_mps": north, "wind_east_mps": east, "wind_down_mps": down,
            "wind_speed_mps": speed, "wind_from_deg": math.atan2(-east, -north) / DEGREE % 360,
            "wind_sigma_north_mps": sigma[0], "wind_sigma_east_mps": sigma[1], "wind_sigma_down_mps": sigma[2],
            "wind_correlation_ne": correlation[0][1], "wind_correlation_nd": correlation[0][2], "wind_correlation_ed": correlation[1][2],
            "wind_speed_sigma_mps": sigma_along(covariance[:2, :2], along),
            "wind_from_sigma_deg": sigma_along(covariance[:2, :2], across) / speed / DEGREE}


def of_track(covariance, north, east):
    """Sigmas along the horizontal air velocity and to the right of it."""
    speed = max(math.hypot(north, east), 1e-3)
    return {"along_track_sigma_mps": sigma_along(covariance, (north / speed, east / speed)),
            "cross_track_sigma_mps": sigma_along(covariance, (-east / speed, north / speed))}


def sigma_along(covariance, direction):
    return math.sqrt(max(float(np.dot(direction, covariance @ direction)), 0.0))


if __name__ == "__main__":
    defects.main(Wind, sign_of="aileron_deg", delay_of=(*VELOCITY, *RATES, *ANGLES), make_target=Target)
