"""EKF and UKF of the psi angle (Kang, Kim, Park 2006, with the corrections of the reproduction).

States: dR, dV, psi, accelerometer bias, gyro bias and, with SSBL, the constant error rho of the fixes. The INS believes in axes p; psi = (x, y, z)
turns p into the true axes c: C(psi) = Rz(z) Ry(y) Rx(x). So the tilts are in axes p, and true attitude = C(psi) times that of the INS.
"""

import math

import numpy as np

from inflight_alignment_ins import turn_of
from inflight_alignment_kalman import DEG, GRAVITY_GRADIENT, PositionFilter, skew

X, Y, Z = np.eye(3)


def rotations(psi):
    """C(psi) for each column of psi."""
    (sx, sy, sz), (cx, cy, cz) = np.sin(psi), np.cos(psi)
    return np.array([[cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx], [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
                     [-sy, cy * sx, cy * cx]])


def euler_rates(psi):
    """E(psi) for each column of psi: d(psi)/dt = E times the rate of p against c, in axes p."""
    (sx, sy, _), (cx, cy, _) = np.sin(psi), np.cos(psi)
    one, zero = np.ones_like(sx), np.zeros_like(sx)
    return np.array([[one, sx * sy / cy, cx * sy / cy], [zero, cx, -sx], [zero, sx / cy, cx / cy]])


def times(matrices, vectors):
    """One matrix and one vector for each column."""
    return np.einsum("ijn,jn->in", matrices, vectors)


class PsiFilter(PositionFilter):
    PSI, ACCEL, GYRO, OWN = slice(6, 9), slice(9, 12), slice(12, 15), slice(0, 15)

    def __init__(self, parameter, initial):
        ssbl = parameter["aiding"] == 0
        self.FIX_BIAS = slice(15, 18) if ssbl else None
        super().__init__(18 if ssbl else 15, parameter, initial)
        self.set_sigma(self.PSI, [initial["tilt_sigma_deg"] * DEG, initial["tilt_sigma_deg"] * DEG, initial["heading_sigma_deg"] * DEG])
        self.set_bias_sigmas()
        self.handed_over = parameter["closed_loop"] == 1

    def propagated(self, x, motion):
        """f(x): the state, or each column of states, at the end of the motion."""
        states = x.reshape(len(x), -1)
        place, speed, psi = states[self.PLACE], states[self.SPEED], states[self.PSI]
        dt, S, C = motion.dt_s, motion.S[:, None], rotations(psi)
        gained = (S - times(C, S - motion.A @ states[self.ACCEL]) - dt * motion.coriolis @ speed + dt * GRAVITY_GRADIENT[:, None] * place)
        against = dt * (motion.rate[:, None] - np.einsum("jin,j->in", C, motion.rate)) - motion.A @ states[self.GYRO]
        after = states.copy()
        after[self.PLACE] += dt * (speed + gained / 2 - motion.transport @ place)
        after[self.SPEED] += gained
        after[self.PSI] += times(euler_rates(psi), against)
        return after.reshape(x.shape)

    def add_noise(self, P, dt_s):
        """Q, and the covariance becomes that of the state."""
        accel, gyro, walk = self.noise(dt_s)
        variance = np.zeros(len(self.x))
        variance[self.SPEED], variance[self.PSI] = accel, gyro
        if self.FIX_BIAS:
            variance[self.FIX_BIAS] = walk
        self.set_covariance(P + np.diag(variance))

    def feed_back(self, ins):
        """In closed loop, the INS takes over all estimated errors; the fix bias is not its own."""
        self.x[8] = math.remainder(self.x[8], math.tau)
        if not self.handed_over:
            return ins
        x = self.x.copy()
        self.x[self.OWN] = 0
        if self.parameter["attitude_error_frame"] == 0:
            # The axes p have turned by psi, so the tilts that remain have other components now. In navigation axes they stay what they are.
            s, c = math.sin(x[8]), math.cos(x[8])
            J = np.eye(len(x))
            J[6:8, 6:8] = (c, -s), (s, c)
            self.move(J, self.x)
        return ins.corrected(x[self.PLACE], x[self.SPEED], self.rotation(x), x[self.ACCEL], x[self.GYRO])

    def rotation(self, x):
        return turn_of(*x[self.PSI])

    def tilt_sigma(self):
        """About north and east."""
        C = rotations(self.x[self.PSI].reshape(3, 1))[:2, :2, 0]
        return np.sqrt(np.diag(C @ self.P[6:8, 6:8] @ C.T))

    def heading_sigma(self):
        return math.sqrt(self.P[8, 8])


class Ekf(PsiFilter):
    def predict(self, motion):
        """x = f(x), P = F P F' + Q, where F = df/dx; the change of E with psi is neglected."""
        dt, psi = motion.dt_s, self.x[self.PSI]
        C = rotations(psi.reshape(3, 1))[:, :, 0]
        E = euler_rates(psi.reshape(3, 1))[:, :, 0]
        along_y = np.array([-math.sin(psi[2]), math.cos(psi[2]), 0.0])  # axis of Ry in axes c
        by_psi = C @ skew(X), skew(along_y) @ C, skew(Z) @ C  # dC/dx, dC/dy, dC/dz
        force = motion.S - motion.A @ self.x[self.ACCEL]

        F = np.eye(len(self.x))
        gained = F[self.SPEED]  # rows of dV
        gained[:, self.PLACE] = np.diag(dt * GRAVITY_GRADIENT)
        gained[:, self.SPEED] -= dt * motion.coriolis
        gained[:, self.PSI] = np.column_stack([-D @ force for D in by_psi])
        gained[:, self.ACCEL] = C @ motion.A
        place = F[self.PLACE]
        place[:] = dt / 2 * gained
        place[:, self.SPEED] += dt / 2 * np.eye(3)
        place[:, self.PLACE] += np.eye(3) - dt * motion.transport
        F[self.PSI, self.PSI] -= dt * E @ np.column_stack([D.T @ motion.rate for D in by_psi])
        F[self.PSI, self.GYRO] = -E @ motion.A

        self.x = self.propagated(self.x, motion)
        self.add_noise(F @ self.P @ F.T, dt)


class Ukf(PsiFilter):
    LEAST_EIGENVALUE = 1e-9  # of the correlations, after a repair

    def predict(self, motion):
        """The points x and x +- sqrt(3) columns of the root of P have the weights 1 - n/3 and 1/6. Sums are taken of differences from f(x), because
        the first weight is negative and large."""
        root = math.sqrt(3) * self.root()
        centre = self.propagated(self.x, motion)
        points = self.propagated(np.hstack([self.x[:, None] + root, self.x[:, None] - root]), motion)
        apart = points - centre[:, None]
        shift = apart.sum(axis=1) / 6
        self.x = centre + shift
        P = apart @ apart.T / 6
        if self.parameter["ukf_covariance"] == 0:  # about the mean; else about f(x), which is positive definite always
            P -= np.outer(shift, shift)
        self.add_noise(self.repaired(P), motion.dt_s)

    def active(self, P):
        """The states with a variance; others, such as a bias that is known to be 0, have no points."""
        return np.flatnonzero(np.diag(P))

    def root(self):
        P, root, active = self.repaired(self.P), np.zeros_like(self.P), self.active(self.P)
        block = np.ix_(active, active)
        if self.parameter["ukf_root"] == 0:
            root[block] = np.linalg.cholesky(P[block])
        else:
            values, vectors = np.linalg.eigh(P[block])
            root[block] = (vectors * np.sqrt(np.maximum(values, 0))) @ vectors.T
        return root

    def repaired(self, P):
        """P if it is positive definite, else with the least eigenvalues of its correlations raised."""
        active = self.active(P)
        block = np.ix_(active, active)
        try:
            np.linalg.cholesky(P[block])
            return P
        except np.linalg.LinAlgError:
            self.repairs += 1
        sigma = np.sqrt(np.abs(np.diag(P)[active]))
        values, vectors = np.linalg.eigh(P[block] / np.outer(sigma, sigma))
        P = P.copy()
        P[block] = (vectors * np.maximum(values, self.LEAST_EIGENVALUE)) @ vectors.T * np.outer(sigma, sigma)
        return P
