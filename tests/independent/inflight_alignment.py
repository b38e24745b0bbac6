"""In-flight alignment: an INS that is aligned in motion by position fixes. EKF, UKF and a filter of sine and cosine of the heading error.

Written from docs/, the DBC and the reproduction notes of Kang, Kim, Park (2006); nothing is taken from hil-target.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before numpy is loaded
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import copy  # noqa: E402
import math  # noqa: E402

import numpy as np  # noqa: E402

import defects  # noqa: E402  (finds the folder of the kit)
import canhil_target  # noqa: E402
from canhil_target import Parameter  # noqa: E402
from inflight_alignment_ins import Ins, Sample, turn_of  # noqa: E402
from inflight_alignment_kalman import DEG, DEGPH, UG, Motion  # noqa: E402
from inflight_alignment_psi import Ekf, Ukf  # noqa: E402
from inflight_alignment_sincos import SinCos  # noqa: E402
from inflight_alignment_target import Silent, Target  # noqa: E402

GAP_LIMIT_US = 200_000  # a longer gap of the IMU is not bridged
SAME_TIME_US = 20  # times are rounded to 1 us, intervals to 10 us
OLDEST_FIX_US, STEP_US = 2_000_000, 1_000_000  # the oldest late fix that is used; the filter's step without fixes
UNAIDED_US = 2_000_000  # after this time without a used fix, the answers are predictions
UNRESOLVED_SIGMA_DEG = 30.0
# The mean NIS of the last 20 fixes or so, exponentially weighted, has the standard deviation sqrt(6/39) about 3 if the filter is consistent.
NIS_MEMORY, NIS_ALARM, NIS_QUIET, NIS_LARGEST = 20, 3 + 6 * math.sqrt(6 / 39), 3 + 2 * math.sqrt(6 / 39), 30.0

AXES, NED, ANGLES = ("x", "y", "z"), ("north", "east", "down"), ("roll", "pitch", "heading")


def signals(name, axes, values):
    """{name.format(axis): value}, for three axes."""
    return {name.format(axis): float(value) for axis, value in zip(axes, values)}


class Filter(canhil_target.Estimator):
    estimator = "inflight_alignment"
    algorithms = ("ekf", "ukf", "sin_cos")
    answers = {"SlaveImu": "FixNav", "Ssbl": "FixFilter", "Gps": "FixFilter"}
    parameters = {
        "accel_bias_sigma_ug": Parameter(1000, 0, 1e6),
        "gyro_bias_sigma_degph": Parameter(1, 0, 1e6),
        "accel_noise_ugprthz": Parameter(50, 0, 1e6, while_running=True),
        "gyro_noise_degprth": Parameter(0.3, 0, 1e4, while_running=True),
        "closed_loop": Parameter(1, 0, 1, whole=True),
        "output_interval_ms": Parameter(10, 1, 1000, while_running=True),
        "aiding": Parameter(0, 0, 1, whole=True),  # 0: SSBL, 1: GPS
        "attitude_error_frame": Parameter(0, 0, 1, whole=True),  # 0: platform, 1: navigation
        "ukf_root": Parameter(0, 0, 1, whole=True),  # 0: lower Cholesky factor, 1: symmetric
        "ukf_covariance": Parameter(0, 0, 1, whole=True),  # 0: about the mean, 1: about the central point
        "fix_noise_horizontal_m": Parameter(2, 1e-3, 1e4, while_running=True),
        "fix_noise_vertical_m": Parameter(2, 1e-3, 1e4, while_running=True),
        "fix_bias_sigma_m": Parameter(math.sqrt(10), 0, 1e4),
        "fix_bias_walk_mprts": Parameter(0, 0, 1e3, while_running=True),
        "initial_height_sigma_m": Parameter(0, 0, 1e5),  # 0: as the other components
        "handover_sigma_deg": Parameter(2, 1e-3, 90, while_running=True),
        "gate_nis": Parameter(30, 0, 1e9, while_running=True),  # 0: no gate
        "gate_recovery": Parameter(5, 0, 1e6, whole=True, while_running=True),
        "late_fixes": Parameter(1, 0, 1, whole=True),
        "fix_correlated_percent": Parameter(100, 0, 100),
        "fix_correlation_s": Parameter(0, 0, 1e5, while_running=True),  # 0: not known
    }
    degraded = False
    time_us = 0  # of the newest IMU sample; 0: none yet

    def start(self, algorithm, parameters, initial):
        self.parameter, self.initial = parameters, initial
        self.filter = {"ekf": Ekf, "ukf": Ukf, "sin_cos": SinCos}[algorithm](parameters, initial)
        # States of the INS, from the time of the filter to now. A late fix goes back to its time of validity; the samples since are integrated again.
        self.track = []
        self.rates = None  # mean rate and force of the sample before
        self.coasting = self.degraded = False
        self.time_us, self.answered_us, self.aided_us, self.last_fix_us = 0, None, None, -math.inf
        self.gated_in_a_row = self.gated = self.refused = 0
        self.mean_nis = 3.0

    def sample(self, group, values, t_us):
        try:
            return self.inertial(values, t_us) if group == "SlaveImu" else self.fix(group, values, t_us)
        except np.linalg.LinAlgError as error:
            raise ArithmeticError(str(error)) from error

    # -- the IMU --

    def inertial(self, values, t_us):
        """Integrates the sample. Returns an answer if one is due."""
        if values["gyro_validity"] != "valid" or values["accel_validity"] != "valid":
            return None
        begin_us = t_us - values["interval_us"]
        sample = Sample(t_us, values["interval_us"] * 1e-6, tuple(values[f"delta_theta_{axis}_rad"] for axis in AXES),
                        tuple(values[f"delta_v_{axis}_mps"] for axis in AXES))
        if not self.track:
            self.track = [self.first_state(begin_us)]
            self.aided_us = begin_us
        self.integrate(sample, begin_us)
        self.time_us = t_us
        if t_us - self.track[0].t_us > OLDEST_FIX_US + STEP_US:
            step = next(i for i, ins in enumerate(self.track) if ins.t_us - self.track[0].t_us >= STEP_US)
            self.predict(step)
        if self.answered_us is not None and t_us - self.answered_us < 1000 * self.parameter["output_interval_ms"]:
            return None
        self.answered_us = t_us
        return self.navigation()

    def first_state(self, begin_us):
        """The initial state of the bench. Its time has 32 bits; a time that the first sample does not follow is not of this run."""
        given = self.initial
        ahead_us = (begin_us - round(given["time_of_validity_us"]) + 2**31) % 2**32 - 2**31
        t_us = begin_us - ahead_us if 0 <= ahead_us <= GAP_LIMIT_US else begin_us
        attitude = turn_of(*(math.radians(given[f"{angle}_deg"]) for angle in ANGLES))
        return Ins(t_us, math.radians(given["latitude_deg"]), math.radians(given["longitude_deg"]), given["height_m"],
                   tuple(given[f"velocity_{axis}_mps"] for axis in NED), attitude)

    def integrate(self, sample, begin_us):
        """Bridges a gap before the sample with the mean of its neighbours; of a sample that overlaps the one before, takes what is new."""
        now_us = self.track[-1].t_us
        if begin_us - now_us > GAP_LIMIT_US:
            raise Silent("gap of the IMU")
        rates = tuple(tuple(x / sample.dt_s for x in increment) for increment in (sample.rotation, sample.velocity))
        if begin_us - now_us > SAME_TIME_US:
            gap_s = (begin_us - now_us) * 1e-6
            means = (tuple(gap_s * (a + b) / 2 for a, b in zip(before, after)) for before, after in zip(self.rates or rates, rates))
            self.track.append(self.track[-1].after(Sample(begin_us, gap_s, *means)))
            self.coasting = True
        elif now_us - begin_us > SAME_TIME_US:
            sample = sample.until(now_us)[1]
        else:
            sample = sample._replace(dt_s=(sample.end_us - now_us) * 1e-6)
        self.track.append(self.track[-1].after(sample))
        self.rates = rates

    def navigation(self):
        ins = self.filter.corrected(self.track[-1], since=self.track[0])
        answer = {"coasting": self.coasting, **signals("{}_deg", ANGLES, map(math.degrees, ins.angles())), **signals("velocity_{}_mps", NED, ins.v)}
        self.coasting = False
        return answer

    # -- time of the filter --

    def predict(self, index):
        """Takes the filter to the state `index` of the track, in steps of about a second."""
        steps = max(1, round((self.track[index].t_us - self.track[0].t_us) / STEP_US))
        marks = [index * step // steps for step in range(steps + 1)]
        for first, last in zip(marks, marks[1:]):
            self.filter.predict(Motion.between(self.track[first], self.track[last]))
        del self.track[:index]

    def split(self, t_us):
        """The index of the state at t_us; a sample that covers t_us is divided there."""
        index = next(i for i, ins in enumerate(self.track) if ins.t_us >= t_us)
        if self.track[index].t_us > t_us:
            before, after = self.track[index].sample.until(t_us)
            at_fix = self.track[index - 1].after(before)
            self.track[index:index + 1] = at_fix, at_fix.after(after)
        return index

    # -- fixes --

    def fix(self, group, values, t_us):
        source = "ssbl" if group == "Ssbl" else "gps"
        outcome = self.fault_of(source, values, t_us)
        if outcome:
            self.refused += 1
            return self.report(source, outcome)
        self.last_fix_us = t_us
        if self.parameter["late_fixes"] == 0:
            t_us = self.time_us
        self.predict(self.split(t_us))
        z, stated = self.measured(source, values)
        R = self.filter.fix_variance(stated)
        innovation, covariance, nis = self.filter.innovation(z, R)
        self.watch(nis)
        outcome = self.gate(nis)
        if outcome == "recovered":  # INS and fixes disagree for good: one of them is wrong by as much
            self.filter.doubt_position(innovation)
            covariance = self.filter.innovation(z, R)[1]
        if outcome != "gated":
            self.filter.update(innovation, covariance, R)
            self.correct()
            self.aided_us = self.time_us
        return self.report(source, outcome, innovation, nis)

    def fault_of(self, source, values, t_us):
        """The outcome of a fix that cannot be used, or ''."""
        if source != ("gps" if self.parameter["aiding"] else "ssbl"):
            return "wrong_source"
        if values["position_validity"] != "valid":
            return "invalid"
        if not self.track:
            return "before_start"
        if t_us > self.time_us:
            return "future"
        if t_us < self.time_us - OLDEST_FIX_US:
            return "late"
        if t_us <= self.last_fix_us:
            return "out_of_order"
        return "before_start" if t_us < self.track[0].t_us and self.parameter["late_fixes"] else ""

    def measured(self, source, values):
        """INS minus fix at the state where the filter is [m], and the sigmas that the fix states."""
        point = math.radians(values["latitude_deg"]), math.radians(values["longitude_deg"]), values["height_m"]
        z = np.array(self.track[0].distance_from(*point))
        if source == "gps":
            return z, [values["horizontal_sigma_m"], values["horizontal_sigma_m"], values["vertical_sigma_m"]]
        return z - [values[f"relative_{axis}_m"] for axis in NED], [values["relative_sigma_m"]] * 3  # the point is the ship

    def gate(self, nis):
        limit = self.parameter["gate_nis"]
        if self.gated_in_a_row and isinstance(self.filter, SinCos):
            limit /= 2
        if limit == 0 or nis <= limit:
            self.gated_in_a_row = 0
            return "accepted"
        if self.gated_in_a_row >= self.parameter["gate_recovery"]:
            self.gated_in_a_row = 0
            return "recovered"
        self.gated_in_a_row += 1
        self.gated += 1
        return "gated"

    def correct(self):
        """Feeds the estimates back to the INS at the time of the fix, and integrates the samples since then again."""
        corrected, later = self.filter.feed_back(self.track[0]), self.track[1:]
        if corrected is self.track[0]:
            return
        self.track = [corrected]
        for ins in later:
            self.track.append(self.track[-1].after(ins.sample))

    def watch(self, nis):
        """Degraded: the innovations are too large for their covariance, or the heading is not known yet."""
        self.mean_nis += (min(nis, NIS_LARGEST) - self.mean_nis) / NIS_MEMORY
        loud = self.mean_nis > (NIS_QUIET if self.degraded else NIS_ALARM)
        self.degraded = loud or self.filter.heading_sigma() > UNRESOLVED_SIGMA_DEG * DEG

    # -- answers of the filter --

    def report(self, source, outcome, innovation=(0.0, 0.0, 0.0), nis=0.0):
        """What the filter knows at its time. Without a sample of the IMU, it knows the initial state only."""
        ins = self.filter.corrected(self.track[0] if self.track else self.first_state(0))
        known, x = self.filter, self.filter.x
        fix_bias, fix_bias_sigma = known.fix_bias()
        gyro, accel = (ins.gyro_bias + x[known.GYRO]) / DEGPH, (ins.accel_bias + x[known.ACCEL]) / UG
        return {
            **signals("innovation_{}_m", NED, innovation),
            "latitude_deg": math.degrees(ins.latitude), "longitude_deg": math.degrees(math.remainder(ins.longitude, math.tau)), "height_m": ins.height,
            **signals("tilt_sigma_{}_deg", NED, known.tilt_sigma() / DEG), "heading_sigma_deg": known.heading_sigma() / DEG,
            **signals("velocity_sigma_{}_mps", NED, known.sigma(known.SPEED)), **signals("position_sigma_{}_m", NED, known.sigma(known.PLACE)),
            **signals("gyro_bias_{}_degph", AXES, gyro), **signals("gyro_bias_sigma_{}_degph", AXES, known.sigma(known.GYRO) / DEGPH),
            **signals("accel_bias_{}_ug", AXES, accel), **signals("accel_bias_sigma_{}_ug", AXES, known.sigma(known.ACCEL) / UG),
            **signals("fix_bias_{}_m", NED, fix_bias), **signals("fix_bias_sigma_{}_m", NED, fix_bias_sigma),
            "outcome": outcome, "source": source, "handed_over": known.handed_over, "degraded": self.degraded,
            "repairs": known.repairs, "gated": self.gated, "refused": self.refused, "nis": nis,
        }

    def predicted(self):
        """A prediction for the newest sample of the IMU, or None while fixes are used. The filter itself stays behind, for a late fix."""
        if self.time_us - self.aided_us < UNAIDED_US:
            return None
        ahead = copy.copy(self)
        ahead.track, ahead.filter = list(self.track), copy.copy(self.filter)
        ahead.predict(len(ahead.track) - 1)
        return ahead.report("imu", "predicted")


if __name__ == "__main__":
    defects.main(Filter, sign_of="delta_v_y_mps", delay_of=("delta_theta_x_rad", "delta_theta_y_rad", "delta_theta_z_rad"), make_target=Target)
