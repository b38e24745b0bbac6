"""The estimate of both planes and its covariance, for any gain.

Complex numbers hold both planes: yaw + j pitch for angles and rates, a_y - j a_z for accelerations. With these signs the two planes of an antenna
that rolls at the rate p have one equation:

    e' = w - q + j p e        w' = (2 vc w + a - a_m) / r + j p w        a' = white noise + j p a
"""

import cmath
import math

import numpy as np

# The errors of one plane, of which the covariance holds two sets: yaw, then pitch. The last three are considered, not estimated: their effect is
# in the covariance, but no measurement corrects them (Schmidt).
ERROR, RATE, ACCELERATION, GYRO_BIAS, TURN, PUSH = range(6)
SIZE = 6
PLANES = (0, SIZE)
MEASURED = [ERROR, SIZE + ERROR]
ESTIMATED = [plane + state for plane in PLANES for state in (ERROR, RATE, ACCELERATION)]
CONSIDERED = [plane + state for plane in PLANES for state in (GYRO_BIAS, TURN, PUSH)]


class Estimate:
    def __init__(self, measured, variances, rate_sigma, acceleration_sigma, gyro_bias_sigma):
        self.error, self.rate, self.acceleration = measured, 0j, 0j
        self.covariance = np.zeros((2 * SIZE, 2 * SIZE))
        for plane, variance in zip(PLANES, variances):
            for state, value in ((ERROR, variance), (RATE, rate_sigma**2), (ACCELERATION, acceleration_sigma**2), (GYRO_BIAS, gyro_bias_sigma**2)):
                self.covariance[plane + state, plane + state] = value
        self.lasts = {TURN: False, PUSH: False}

    def consider(self, state, sigmas, lasts):
        """Considers an unmeasured motion that is constant with these 1-sigmas (yaw, pitch). lasts: it is not measured now either, so the next
        step has the same motion if that is not measured again."""
        if not (self.lasts[state] and lasts):
            for plane, sigma in zip(PLANES, sigmas):
                self.covariance[plane + state, :] = 0
                self.covariance[:, plane + state] = 0
                self.covariance[plane + state, plane + state] = sigma * sigma
        self.lasts[state] = lasts

    def predict(self, dt, range_m, closing_speed, turned, rolled, pushed, jerk_density, not_turned_s, not_pushed_s):
        """Predicts over dt, to a sample at this range. turned, rolled: increments of the antenna; pushed: mean acceleration of the missile;
        not_turned_s, not_pushed_s: for how long they were not measured. An infinite range leaves nothing but e' = w - q."""
        inverse = 1 / range_m
        shrunk = max(1 + closing_speed * dt * inverse, 0.1)  # earlier range over range, for any closing speed that a jump may bring
        lever = dt * inverse * (1 + shrunk) / 2
        drop = dt * dt * inverse / 2
        # The increments are those of axes that roll: half of the roll comes before them, half after.
        half = cmath.exp(0.5j * rolled)
        rate, push = half * self.rate, half * self.acceleration - pushed
        self.error = half * (half * self.error + dt * shrunk * rate + drop * push - turned)
        self.rate = half * (shrunk * shrunk * rate + lever * push)
        self.acceleration *= half * half

        block = np.eye(SIZE)
        block[ERROR, RATE:] = dt * shrunk, drop, dt, not_turned_s, drop * not_pushed_s / dt
        block[RATE, RATE:] = shrunk * shrunk, lever, 0, 0, lever * not_pushed_s / dt
        transition = np.zeros((2 * SIZE, 2 * SIZE))
        transition[:SIZE, :SIZE] = transition[SIZE:, SIZE:] = block
        if rolled:
            yaw, pitch = transition[:3].copy(), transition[SIZE:SIZE + 3].copy()
            cos, sin = math.cos(rolled), math.sin(rolled)
            transition[:3] = cos * yaw - sin * pitch
            transition[SIZE:SIZE + 3] = sin * yaw + cos * pitch
        covariance = transition @ self.covariance @ transition.T
        noise = process_noise(dt, inverse, closing_speed, jerk_density)
        covariance[:3, :3] += noise
        covariance[SIZE:SIZE + 3, SIZE:SIZE + 3] += noise
        self.covariance = (covariance + covariance.T) / 2

    def innovate(self, measured, variances):
        """Compares error angles, whose noises have these variances (yaw, pitch), with the prediction. Returns the normalised innovation squared."""
        difference = measured - self.error
        self.innovation = np.array((difference.real, difference.imag))
        self.spread = self.covariance[np.ix_(MEASURED, MEASURED)] + np.diag(variances)
        self.inverse = np.linalg.inv(self.spread)
        return float(self.innovation @ self.inverse @ self.innovation)

    def kalman_gain(self):
        gain = self.covariance[:, MEASURED] @ self.inverse
        gain[CONSIDERED] = 0
        return gain

    @staticmethod
    def gain_of(yaw, pitch):
        """A gain of planes that do not influence each other. yaw, pitch: (e, w, a)."""
        gain = np.zeros((2 * SIZE, 2))
        gain[:3, 0], gain[SIZE:SIZE + 3, 1] = yaw, pitch
        return gain

    def update(self, gain):
        """Corrects the estimate with any gain, not only the optimal one: P = (I - K H) P (I - K H)' + K R K'."""
        error, rate, acceleration = (gain[ESTIMATED] @ self.innovation).reshape(2, 3).T
        self.error += complex(*error)
        self.rate += complex(*rate)
        self.acceleration += complex(*acceleration)
        explained = gain @ self.covariance[MEASURED]
        covariance = self.covariance - explained - explained.T + gain @ self.spread @ gain.T
        self.covariance = (covariance + covariance.T) / 2

    def sigmas(self, state):
        """1-sigmas in yaw and pitch."""
        return tuple(math.sqrt(max(self.covariance[plane + state, plane + state], 0.0)) for plane in PLANES)


def process_noise(dt, inverse_range, closing_speed, jerk_density):
    """The covariance of white jerk over dt, in (e, w, a): that of the displacements, of which e = y1 / r and w = y2 / r + vc y1 / r^2."""
    displacements = jerk_density * np.array(((dt**5 / 20, dt**4 / 8, dt**3 / 6), (dt**4 / 8, dt**3 / 3, dt**2 / 2), (dt**3 / 6, dt**2 / 2, dt)))
    to_angles = np.array(((inverse_range, 0, 0), (closing_speed * inverse_range**2, inverse_range, 0), (0, 0, 1)))
    return to_angles @ displacements @ to_angles.T
