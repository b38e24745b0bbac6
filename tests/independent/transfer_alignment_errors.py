"""The error filters of the transfer alignment: Kalman filter and robust H2 filter (Yang, Shim, Park 2001) in the form of the specification.

The state, every error being computed minus true: velocity dV [m/s] and misalignment phi [rad] in north-east-down axes, errors of the accelerometers
df [m/s2] and of the gyros dw [rad/s] in body axes. After these 12 come errors that are considered but not estimated.
"""

import math

import numpy as np

from transfer_alignment_ins import rotation, skew

V, PHI, DF, DW = slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 12)
ESTIMATED = 12
UG, DEG = 9.80665e-6, math.pi / 180
DEGPH = DEG / 3600  # [rad/s]
DEGPRTH = DEG / 60  # deg/sqrt(h) [rad/sqrt(s)]
ONES = skew(np.ones(3))  # the paper's S = [1 1 1]x
NIS_MEAN, NIS_WEIGHT = 3.0, 1 / 20
NIS_SIGMA = math.sqrt(6 * NIS_WEIGHT / (2 - NIS_WEIGHT))  # of the weighted mean of the NIS, whose own variance is 2 * 3
CALM_UPDATES = 40


class ErrorFilter:
    def __init__(self, algorithm, parameter, initial):
        self.robust, self.parameter, self.invariant = algorithm == "robust_h2", parameter, parameter["closed_loop"] == 2
        tilt, heading = initial["tilt_sigma_deg"] * DEG, initial["heading_sigma_deg"] * DEG
        sigma = [initial["velocity_sigma_mps"]] * 3 + [tilt, tilt, heading]
        sigma += [parameter["accel_bias_sigma_ug"] * UG] * 3 + [parameter["gyro_bias_sigma_degph"] * DEGPH] * 3

        def consider(name, block):
            """Appends errors to the state, if they exist and this loop considers them."""
            if self.invariant and any(block):
                self.considered[name] = slice(len(sigma), len(sigma) + len(block))
                sigma.extend(block)

        self.considered = {}
        for sensor in ("accel", "gyro"):  # f^ = (I + M) f + df: nine elements of M, row by row
            scale, turned = parameter[sensor + "_scale_factor_sigma_ppm"] * 1e-6, parameter[sensor + "_misalignment_sigma_mrad"] * 1e-3
            consider(sensor, [scale if i == j else turned for i in range(3) for j in range(3)])
        consider("lever", [parameter["lever_arm_sigma_m"]] * 3)
        consider("master", [parameter["velocity_correlated_mps"]] * 3)
        self.x, self.P = np.zeros(len(sigma)), np.diag(np.square(sigma))
        self.first_attitude = self.P.diagonal()[PHI].copy()
        self.largest_angle = min(3 * math.sqrt(self.first_attitude.sum()), math.pi)  # three sigma
        self.refused, self.mean_nis, self.calm, self.restrained = 0, NIS_MEAN, CALM_UPDATES, False

    @property
    def degraded(self):
        """The innovations, or a step of H2 that was not made, say that the sigmas do not hold."""
        return self.calm < CALM_UPDATES or self.restrained

    @property
    def with_products(self):
        return bool({"accel", "gyro"} & self.considered.keys())

    # ---- prediction ----

    def predict(self, ins):
        """One step over the time of the sums of `ins`: Phi = I + A dt with the means of f and C in this time."""
        dt, F, Q = ins.time, np.eye(len(self.x)), np.zeros_like(self.P)
        w_in = ins.earth_rate + ins.transport_rate
        F[V, V] -= skew(ins.earth_rate + w_in) * dt  # dV' = -(2 w_ie + w_en) x dV + (C f) x phi + C df
        F[V, PHI] = skew(ins.force_sum)
        F[V, DF] = ins.C_sum
        F[PHI, PHI] -= skew(w_in) * dt  # phi' = -(w_ie + w_en) x phi - C dw
        F[PHI, DW] = -ins.C_sum
        guessed = ins.variance_sum
        Q[V, V] = np.eye(3) * ((self.parameter["accel_noise_ugprthz"] * UG) ** 2 * dt) + ins.C * guessed[3:] @ ins.C.T
        Q[PHI, PHI] = np.eye(3) * ((self.parameter["gyro_noise_degprth"] * DEGPRTH) ** 2 * dt) + ins.C * guessed[:3] @ ins.C.T
        self.add_considered(F, Q, ins)
        P = self.predicted(F, Q)
        self.restrained = False
        if self.robust:
            terms = self.robust_terms(ins.force_sum / dt)
            if terms:
                growth, spread = terms
                robust_F, robust_Q = F.copy(), Q.copy()
                robust_F[:, PHI] += growth * dt
                robust_Q[V, V] += spread * dt
                robust_P = self.predicted(robust_F, robust_Q)
                self.restrained = self.invariant and bool((robust_P.diagonal()[PHI] > self.first_attitude).any())
                if not self.restrained:
                    F, P = robust_F, robust_P
        elif self.parameter["fading_per_s"] > 0:  # the sigmas grow
            grown = np.ones(len(self.x))
            grown[:ESTIMATED] = math.exp(self.parameter["fading_per_s"] * dt)
            P = P * np.outer(grown, grown)
        self.x, self.P = F @ self.x, P

    def predicted(self, F, Q):
        P = F @ self.P @ F.T + Q
        return (P + P.T) / 2

    def add_considered(self, F, Q, ins):
        if "accel" in self.considered:
            F[V, self.considered["accel"]] = ins.force_products
        if "gyro" in self.considered:
            F[PHI, self.considered["gyro"]] = -ins.rate_products
        if "master" in self.considered:  # Gauss-Markov
            kept, place = math.exp(-ins.time / self.parameter["velocity_correlation_s"]), self.considered["master"]
            F[place, place] = np.eye(3) * kept
            Q[place, place] = np.eye(3) * (self.parameter["velocity_correlated_mps"] ** 2 * (1 - kept * kept))

    def robust_terms(self, force):
        """The terms of the uncertainty dA = L Delta N, |Delta| <= 1, of the effect of phi on dV': (1/beta) P N'N, of which these are the columns of
        phi, and beta LL'. None if there is no uncertainty. In all cases alpha is here a factor of L: as one of N it gives the same
        products, because beta = sqrt(2 lmax(P N'N P) / lmax(LL')) cancels it."""
        columns = self.P[:, PHI]
        if self.parameter["h2_alpha_rule"] == 0:  # ||dC f||: 1 sigma of [f x] phi, but a rotation cannot move f by more than a chord
            f_x, size = skew(force), math.sqrt(force @ force)
            alpha = math.sqrt(max(np.trace(f_x @ self.P[PHI, PHI] @ f_x.T), 0.0))
            alpha = min(alpha, 2 * math.sin(self.largest_angle / 2) * size)
        else:
            alpha = self.parameter["h2_alpha_mps2"]
        case = self.parameter["h2_case"]
        L, N = ONES if case == 2 else np.eye(3), ONES if case == 3 else np.eye(3)
        largest = np.linalg.eigvalsh(N @ (columns.T @ columns) @ N.T)[-1]  # lmax(P N'N P), by its 3 x 3 factor
        LL = alpha * alpha * (L @ L.T)
        if alpha <= 0 or largest <= 0:
            return None
        beta = math.sqrt(2 * largest / np.linalg.eigvalsh(LL)[-1])
        return columns @ (N.T @ N) / beta, beta * LL

    # ---- update and correction ----

    def update(self, difference, variance, ins):
        """Updates with slave minus master velocity. variance: of the master's white noise. Returns the innovation and its NIS."""
        H = np.zeros((3, len(self.x)))
        H[:, V] = np.eye(3)
        if "lever" in self.considered:  # the IMU at r moves with C (w x r) beside the master
            w_nb = ins.rate - ins.C.T @ (ins.earth_rate + ins.transport_rate)
            H[:, self.considered["lever"]] = ins.C @ skew(w_nb)
        if "master" in self.considered:
            H[:, self.considered["master"]] = -np.eye(3)
        innovation = difference - H @ self.x
        PH = self.P @ H.T
        S = H @ PH + np.eye(3) * variance
        inverse = np.linalg.inv(S)
        nis = float(innovation @ inverse @ innovation)
        if not math.isfinite(nis):
            raise ArithmeticError("the innovation is not a number")
        self.watch(nis)
        if self.refuses(nis):
            return innovation, nis
        K = PH @ inverse
        K[ESTIMATED:] = 0  # considered errors: Schmidt's filter
        J = np.eye(len(self.x)) - K @ H
        P = J @ self.P @ J.T + K @ K.T * variance  # Joseph's form holds for any K
        self.x, self.P = self.x + K @ innovation, (P + P.T) / 2
        return innovation, nis

    def refuses(self, nis):
        gate = self.parameter["gate_nis"] if self.invariant else 0
        refused = 0 < gate < nis and self.refused < self.parameter["gate_recovery"]
        self.refused = self.refused + 1 if refused else 0
        return refused

    def watch(self, nis):
        """An alarm begins 6 sigma above the expected mean of the NIS, and ends when the mean has been below 2 for a while."""
        self.mean_nis += NIS_WEIGHT * (nis - self.mean_nis)
        if self.mean_nis > NIS_MEAN + 6 * NIS_SIGMA:
            self.calm = 0
        elif self.mean_nis < NIS_MEAN + 2 * NIS_SIGMA:
            self.calm += 1
        elif self.calm < CALM_UPDATES:
            self.calm = 0

    def corrected(self, C, velocity, x):
        """Attitude and velocity without the errors x: exp([phi x]) C and V - dV."""
        if not self.invariant:
            return rotation(x[PHI]) @ C, velocity - x[V]
        # The pair (C, V) as one group element, with the error inv(true) computed = Exp(xi): its linear equations hold for large errors too.
        # In north-east-down axes xi is (dV, -phi), and V is corrected by the group's Jacobian, (I + [phi x]/2 + [phi x]^2/6 + ...) dV.
        phi_x = skew(x[PHI])
        return rotation(x[PHI]) @ C, velocity - x[V] - phi_x @ (x[V] / 2 + phi_x @ x[V] / 6)

    def correct(self, ins):
        """Moves the estimated errors into the INS."""
        ins.C, ins.V = self.corrected(ins.C, ins.V, self.x)
        ins.accel_bias, ins.gyro_bias = ins.accel_bias + self.x[DF], ins.gyro_bias + self.x[DW]
        if self.invariant:  # xi belongs to the body: its covariance in north-east-down axes turns with the corrected attitude
            turned = np.eye(len(self.x))
            turned[V, V] = turned[PHI, PHI] = rotation(self.x[PHI])
            self.P = turned @ self.P @ turned.T
        self.x = np.zeros(len(self.x))

    def extrapolated(self, ins):
        """The state at the time of `ins`, whose sums began at the last step: of an INS that is not corrected. Phi x, written out."""
        x, dt = self.x.copy(), ins.time
        w_in = ins.earth_rate + ins.transport_rate
        x[V] += ins.C_sum @ self.x[DF] + skew(ins.force_sum) @ self.x[PHI] - skew(ins.earth_rate + w_in) @ self.x[V] * dt
        x[PHI] -= ins.C_sum @ self.x[DW] + skew(w_in) @ self.x[PHI] * dt
        return x
