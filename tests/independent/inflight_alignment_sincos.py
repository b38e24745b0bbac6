"""The filter that starts from any heading: sine and cosine of the heading error are states, so that its model is linear in them.

States: dR, dV, tilts phi (x, y) about the true north and east, s = sin(psi) and k = 1 - cos(psi) of the heading error, accelerometer bias, gyro bias,
constant error of SSBL fixes, error of the fixes that is correlated in time. True attitude = exp(phi x) Rz(psi) times that of the INS.
"""

import math

import numpy as np

from inflight_alignment_ins import product, turn
from inflight_alignment_kalman import DEG, GRAVITY_GRADIENT, PositionFilter

SURE_OF_CIRCLE = 0.4  # s and k belong to an angle if hypot(s, 1 - k) is this close to 1
# A correlated error whose time is not told: a model with these shares of the told variance covers all times from 5 to 120 s
# (docs/experiments/inflight_fix_errors.md).
UNKNOWN_TIME_S, UNKNOWN_CORRELATED, UNKNOWN_WHITE = 60.0, 2.0, 1.5
LEAST_WHITE = 0.01  # share of the told variance that is white at least, so that the innovations keep a covariance


class SinCos(PositionFilter):
    PHI, S, K, ACCEL, GYRO, FIX_BIAS, FIX_ERROR = slice(6, 8), 8, 9, slice(10, 13), slice(13, 16), slice(16, 19), slice(19, 22)
    OWN = slice(0, 16)

    def __init__(self, parameter, initial):
        super().__init__(22, parameter, initial)
        self.set_sigma(self.PHI, initial["tilt_sigma_deg"] * DEG)
        self.set_bias_sigmas()
        if parameter["aiding"] != 0:
            self.set_sigma(self.FIX_BIAS, 0.0)
        self.H[:, self.FIX_ERROR] = -np.eye(3)
        self.fix_error = None  # variance of the correlated error; known from the first fix on
        # psi is N(0, sigma^2): E(cos) = exp(-sigma^2/2), and the variances of sine and cosine follow.
        e = math.exp(-(initial["heading_sigma_deg"] * DEG) ** 2)
        self.x[self.K] = 1 - math.sqrt(e)
        self.set_sigma([self.S, self.K], [math.sqrt((1 - e * e) / 2), (1 - e) / math.sqrt(2)])
        self.handed_over = False

    # -- the error of the fixes --

    def error_model(self):
        """Shares of a fix's variance that are white and correlated, and the correlation time [s]."""
        correlated, time = self.parameter["fix_correlated_percent"] / 100, self.parameter["fix_correlation_s"]
        if time > 0:
            return max(1 - correlated, LEAST_WHITE), correlated, time
        return 1 - correlated + UNKNOWN_WHITE * correlated, UNKNOWN_CORRELATED * correlated, UNKNOWN_TIME_S

    def fix_variance(self, stated):
        """The white part. The correlated part is a state."""
        white, correlated, _ = self.error_model()
        told = super().fix_variance(stated)
        if self.fix_error is None:
            self.set_sigma(self.FIX_ERROR, np.sqrt(correlated * told))
        self.fix_error = correlated * told
        return white * told

    # -- time --

    def heading(self, x):
        return math.atan2(x[self.S], 1 - x[self.K])

    def transition(self, motion):
        """F, and sine and cosine of psi. The model is linear: x = F x."""
        dt, psi = motion.dt_s, self.heading(self.x)
        s, c = math.sin(psi), math.cos(psi)
        to_c = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        f, w, A = to_c @ motion.S, to_c @ motion.rate, to_c @ motion.A
        F = np.eye(len(self.x))

        # dV' = f_INS - exp(phi x) Rz(psi) f_INS + bias = (k Sx + s Sy, k Sy - s Sx, 0) - phi x f + A bias - (2 w_ie + w_ec) x dV + dg
        gained = F[self.SPEED]
        gained[:, self.PLACE] = np.diag(dt * GRAVITY_GRADIENT)
        gained[:, self.SPEED] -= dt * motion.coriolis
        gained[:, self.PHI] = (0.0, -f[2]), (f[2], 0.0), (-f[1], f[0])
        gained[:2, self.S] = motion.S[1], -motion.S[0]
        gained[:2, self.K] = motion.S[:2]
        gained[:, self.ACCEL] = A
        place = F[self.PLACE]
        place[:] = dt / 2 * gained
        place[:, self.SPEED] += dt / 2 * np.eye(3)
        place[:, self.PLACE] += np.eye(3) - dt * motion.transport

        # phi' = -(k wx + s wy, k wy - s wx) + phi x Rz w - A gyro bias
        tilt, (wx, wy, _) = F[self.PHI], motion.rate
        tilt[:, self.PHI] += ((0.0, dt * w[2]), (-dt * w[2], 0.0))
        tilt[:, self.S] = -dt * wy, dt * wx
        tilt[:, self.K] = -dt * wx, -dt * wy
        tilt[:, self.GYRO] = -A[:2]

        # psi' = phi_x (Rz w)_y - phi_y (Rz w)_x - (A gyro bias)_z;  s' = cos(psi) psi', k' = sin(psi) psi'
        turned = np.zeros(len(self.x))
        turned[self.PHI] = dt * w[1], -dt * w[0]
        turned[self.GYRO] = -A[2]
        F[self.S] += c * turned
        F[self.K] += s * turned

        F[self.FIX_ERROR, self.FIX_ERROR] *= math.exp(-dt / self.error_model()[2])
        return F, s, c

    def propagated(self, x, motion):
        return self.transition(motion)[0] @ x

    def predict(self, motion):
        F, s, c = self.transition(motion)
        accel, gyro, walk = self.noise(motion.dt_s)
        P = F @ self.P @ F.T
        for states, variance in ((self.SPEED, accel), (self.PHI, gyro), (self.FIX_BIAS, walk if self.parameter["aiding"] == 0 else 0.0)):
            P[states, states] += variance * np.eye(len(P[states]))
        P[self.S:self.K + 1, self.S:self.K + 1] += gyro * np.outer((c, s), (c, s))
        if self.fix_error is not None:
            P[self.FIX_ERROR, self.FIX_ERROR] += np.diag(self.fix_error * (1 - F[19, 19] ** 2))
        self.x = F @ self.x
        self.set_covariance(P)

    # -- feedback --

    def feed_back(self, ins):
        """The INS takes over position, velocity, biases and tilt; and, once it is resolved, the heading."""
        x = self.x.copy()
        levelling = self.level()
        heading = self.turn_round() if self.handed_over or self.resolved() else 0.0
        for states in (self.PLACE, self.SPEED, self.ACCEL, self.GYRO):
            self.x[states] = 0
        rotation = product(turn((0.0, 0.0, heading)), turn(levelling))
        return ins.corrected(x[self.PLACE], x[self.SPEED], rotation, x[self.ACCEL], x[self.GYRO])

    def level(self):
        """The INS turns by exp(u x), with u = Rz(-psi) phi in its own axes. Then exp(phi x) Rz(psi) = exp(phi' x) Rz(psi) exp(u x) gives
        phi' = phi - Rz(psi) u, which is linear in s and k: it holds for all headings, and phi' knows that u was turned by a wrong heading."""
        psi, (x, y) = self.heading(self.x), self.x[self.PHI]
        s, c = math.sin(psi), math.cos(psi)
        u, v = c * x + s * y, c * y - s * x
        J = np.eye(len(self.x))
        J[6, self.S], J[6, self.K] = v, u
        J[7, self.S], J[7, self.K] = -u, v
        state = J @ self.x
        state[self.PHI] -= u, v
        self.move(J, state)
        return u, v, 0.0

    def resolved(self):
        circle = math.hypot(self.x[self.S], 1 - self.x[self.K])
        return self.heading_sigma() < self.parameter["handover_sigma_deg"] * DEG and abs(circle - 1) < SURE_OF_CIRCLE

    def turn_round(self):
        """The INS turns by psi. What remains of s is sin(psi' - psi) = c s' - s (1 - k'), and k is of second order from now on: it is 0."""
        psi = self.heading(self.x)
        J = np.eye(len(self.x))
        J[self.S:self.K + 1, self.S:self.K + 1] = (math.cos(psi), math.sin(psi)), (0.0, 0.0)
        x = self.x.copy()
        x[self.S] = x[self.K] = 0
        self.move(J, x)
        self.handed_over = True
        return psi

    def rotation(self, x):
        return product(turn((x[6], x[7], 0.0)), turn((0.0, 0.0, self.heading(x))))

    def tilt_sigma(self):
        return self.sigma(self.PHI)

    def heading_sigma(self):
        """Of psi = atan2(s, 1 - k)."""
        psi = self.heading(self.x)
        along = np.array([math.cos(psi), math.sin(psi)])
        radius = max(math.hypot(self.x[self.S], 1 - self.x[self.K]), 0.01)
        return math.sqrt(along @ self.P[self.S:self.K + 1, self.S:self.K + 1] @ along) / radius
