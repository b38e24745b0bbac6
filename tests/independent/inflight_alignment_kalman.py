"""What the filters of in-flight alignment share: the state's first six elements, the update by a position, and the sigmas that they report.

The state x holds errors, INS minus truth, in SI units. It begins with the position dR and the velocity dV, north, east, down. P is its covariance.
"""

import math
from typing import NamedTuple

import numpy as np

from inflight_alignment_ins import EARTH_RADIUS_M

DEG, DEGPH, UG = math.pi / 180, math.pi / 180 / 3600, 9.80665e-6
# A wrong radius changes gravity: what INS and truth differ by, for an error of the position north, east, down.
GRAVITY_GRADIENT = 9.80665 / EARTH_RADIUS_M * np.array([-1.0, -1.0, 2.0])


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


class Motion(NamedTuple):
    """What the INS did from one time to another."""
    dt_s: float
    S: np.ndarray  # integral of the specific force [m/s], INS axes
    A: np.ndarray  # integral of the attitude C [s]
    rate: np.ndarray  # w_ic = w_ie + w_ec, of the n axes against the stars [rad/s]
    coriolis: np.ndarray  # the matrix of (2 w_ie + w_ec) x
    transport: np.ndarray  # the matrix of w_ec x

    @classmethod
    def between(cls, first, last):
        earth = last.earth()
        rate, transport = np.array(earth.rate), np.array(earth.transport)
        return cls((last.t_us - first.t_us) * 1e-6, np.subtract(last.force, first.force), np.subtract(last.time, first.time).reshape(3, 3),
                   rate + transport, skew(2 * rate + transport), skew(transport))


class PositionFilter:
    """A derived class defines its states, and propagated(), predict(), feed_back() and rotation(). OWN: the states that are errors of the
    INS itself; the others are those of the fixes."""
    PLACE = slice(0, 3)
    SPEED = slice(3, 6)

    def __init__(self, size, parameter, initial):
        self.parameter, self.repairs = parameter, 0
        self.x, self.P = np.zeros(size), np.zeros((size, size))
        self.H = np.zeros((3, size))  # z = INS minus fix = dR minus the lasting error of the fixes
        self.H[:, self.PLACE] = np.eye(3)
        height = parameter["initial_height_sigma_m"] or initial["position_sigma_m"]
        self.set_sigma(self.PLACE, [initial["position_sigma_m"], initial["position_sigma_m"], height])
        self.set_sigma(self.SPEED, initial["velocity_sigma_mps"])

    def set_sigma(self, states, sigma):
        variance = np.diag(self.P).copy()
        variance[states] = np.square(sigma)
        np.fill_diagonal(self.P, variance)

    def set_bias_sigmas(self):
        self.set_sigma(self.ACCEL, self.parameter["accel_bias_sigma_ug"] * UG)
        self.set_sigma(self.GYRO, self.parameter["gyro_bias_sigma_degph"] * DEGPH)
        if self.FIX_BIAS:
            self.set_sigma(self.FIX_BIAS, self.parameter["fix_bias_sigma_m"])
            self.H[:, self.FIX_BIAS] = -np.eye(3)

    def noise(self, dt_s):
        """The variances that velocity, attitude and fix bias gain by white noise."""
        accel, gyro = self.parameter["accel_noise_ugprthz"] * UG, self.parameter["gyro_noise_degprth"] * DEG / 60
        return accel * accel * dt_s, gyro * gyro * dt_s, self.parameter["fix_bias_walk_mprts"] ** 2 * dt_s

    def fix_variance(self, stated):
        """R, of north, east, down. stated: the sigmas that the fix states of itself, 0 if none; the larger one counts."""
        told = [self.parameter["fix_noise_" + axis + "_m"] for axis in ("horizontal", "horizontal", "vertical")]
        return np.square(np.maximum(told, stated))

    def innovation(self, z, R):
        """Innovation, its covariance, and its normalised square (NIS)."""
        innovation = z - self.H @ self.x
        covariance = self.H @ self.P @ self.H.T + np.diag(R)
        return innovation, covariance, float(innovation @ np.linalg.solve(covariance, innovation))

    def update(self, innovation, covariance, R):
        gain = np.linalg.solve(covariance, self.H @ self.P).T
        keep = np.eye(len(self.x)) - gain @ self.H
        self.x = self.x + gain @ innovation
        self.set_covariance(keep @ self.P @ keep.T + (gain * R) @ gain.T)  # Joseph

    def set_covariance(self, P):
        self.P = (P + P.T) / 2
        if not (np.isfinite(self.x).all() and np.isfinite(self.P).all() and np.diag(self.P).min() >= 0):
            raise ArithmeticError("the covariance is not one")

    def doubt_position(self, by_m):
        """For a jump between INS and fixes that the covariance does not explain."""
        self.P = self.P.copy()
        self.P[self.PLACE, self.PLACE] += np.diag(np.square(by_m))

    def move(self, J, x):
        """The state becomes x, and its error is multiplied by J."""
        self.x = x
        self.set_covariance(J @ self.P @ J.T)

    def corrected(self, ins, since=None):
        """The INS without its estimated errors. since: the INS at the time of the filter, if that is earlier."""
        if not self.x[self.OWN].any():
            return ins
        x = self.propagated(self.x, Motion.between(since, ins)) if since else self.x
        return ins.corrected(x[self.PLACE], x[self.SPEED], self.rotation(x))

    # -- what is reported --

    def sigma(self, states):
        return np.sqrt(np.diag(self.P)[states])

    def fix_bias(self):
        """Estimate and sigma of the lasting error of the fixes."""
        H = self.H.copy()
        H[:, self.PLACE] = 0
        return -H @ self.x, np.sqrt(np.diag(H @ self.P @ H.T))
