"""Extended Kalman, H-infinity and adaptive filter of the wind, and a bank of two of them for gusts.

Besides its covariance each filter carries the sensitivity of its error to lasting errors: of the parts of the aerodynamic coefficients, and of
navigation's velocity and attitude. They do not change the gain (nobody knows them), but the sigmas that are reported allow for them.
"""

import math

import numpy as np

import wind_model as model

DEGREE = math.radians(1)
LONGEST_STEP_S = 0.02  # of the integration
COEFFICIENT_PARTS = 17
CONSIDERED = COEFFICIENT_PARTS + 6  # coefficients, velocity N E D, roll pitch heading
COEFFICIENT_HOLD_S = 0.05  # changing errors of the coefficients stay for this time (the paper's reproduction)
FIN_UNKNOWN_RAD, FIN_TIME_S = 3 * DEGREE, 0.1  # deflection that nobody measures: sigma, correlation time
GUST_FACTOR = 10.0  # wind noise of the second filter in relation to the first
CALM_LASTS_S, GUST_LASTS_S = 30.0, 3.0
WIND = slice(9, 12)


class Settings:
    """The parameters in SI and rad, as densities of process noise and variances of the sensors."""

    def __init__(self, algorithm, p):
        self.algorithm, self.parameters = algorithm, dict(p)
        self.process = int(p["process_noise"])
        self.density = np.repeat([p["air_velocity_noise_mpsprts"], p["body_rate_noise_degpsprts"] * DEGREE, p["attitude_noise_degprts"] * DEGREE,
                                  p["wind_noise_mpsprts"]], 3) ** 2
        self.sensor = np.repeat([p["glider_velocity_sigma_mps"], p["glider_rate_sigma_degps"] * DEGREE,
                                 p["glider_attitude_sigma_deg"] * DEGREE], 3) ** 2
        self.coefficient = p["coefficient_sigma_percent"] / 100
        self.considers = self.process >= 2 and algorithm != "h_infinity"
        lasting = np.repeat([self.coefficient, p["nav_velocity_bias_sigma_mps"], p["nav_attitude_bias_sigma_deg"] * DEGREE],
                            (COEFFICIENT_PARTS, 3, 3))
        self.lasting = lasting ** 2 if self.considers else np.zeros(CONSIDERED)
        self.weight = np.array([1.0] * 3 + [math.sqrt(p["theta_rate_weight"])] * 3)  # S^1/2 of the H-infinity filter
        self.gust_factors = (1.0, GUST_FACTOR) if self.process == 3 else (1.0,)


class Estimate:
    """x, its covariance P, and the sensitivity of x to the lasting errors."""

    def __init__(self, x, covariance, sensitivity):
        self.x, self.P, self.sensitivity = x, covariance, sensitivity


def from_air_velocity(air_velocity, rates, attitude, velocity, variances):
    """Start with a known air velocity: v_w = v_g - C_nb v_a. variances: of air velocity, rates, attitude, ground velocity; three each."""
    c = model.body_to_ned(*attitude)
    by_attitude = model.by_attitude(c, air_velocity, attitude[2])
    x = np.concatenate([air_velocity, rates, attitude, velocity - c @ air_velocity])
    source = np.zeros((12, 12))  # from errors of air velocity, rates, attitude, ground velocity to those of x
    source[:9, :9] = np.eye(9)
    source[WIND] = np.hstack([-c, np.zeros((3, 3)), -by_attitude, np.eye(3)])
    return Estimate(x, source * variances @ source.T, np.zeros((12, CONSIDERED)))


def from_wind(wind, wind_covariance, wind_sensitivity, measured, settings):
    """Start with a known wind and a sample of navigation: v_a = C_bn (v_g - v_w)."""
    velocity, rates, attitude = measured[:3], measured[3:6], measured[6:9]
    c = model.body_to_ned(*attitude)
    air_velocity = c.T @ (velocity - wind)
    source = np.zeros((12, 12))  # from errors of ground velocity, rates, attitude, wind
    source[:3] = np.hstack([c.T, np.zeros((3, 3)), -c.T @ model.by_attitude(c, air_velocity, attitude[2]), -c.T])
    source[3:, 3:] = np.eye(9)
    covariance = np.zeros((12, 12))
    covariance[:9, :9] = np.diag(settings.sensor)
    covariance[WIND, WIND] = wind_covariance
    lasting = np.zeros((12, CONSIDERED))  # what is measured too large is estimated too large
    lasting[:3, -6:-3] = lasting[6:9, -3:] = -np.eye(3)
    lasting[WIND] = wind_sensitivity
    return Estimate(np.concatenate([air_velocity, rates, attitude, wind]), source @ covariance @ source.T, source @ lasting)


def expected(x):
    """h(x) = [v_g omega Phi] with v_g = C_nb v_a + v_w, and its derivative."""
    v, attitude = x[:3], x[6:9]
    c = model.body_to_ned(*attitude)
    h = np.zeros((9, 12))
    h[:3, :3], h[:3, 6:9], h[:3, WIND] = c, model.by_attitude(c, v, attitude[2]), np.eye(3)
    h[3:, 3:9] = np.eye(6)
    return np.concatenate([c @ v + x[WIND], x[3:9]]), h


def wrapped(angles):
    return (angles + math.pi) % (2 * math.pi) - math.pi


class Filter:
    """One filter. gust: factor of its wind noise."""

    def __init__(self, estimate, gust):
        self.x, self.P, self.sensitivity = estimate.x.copy(), estimate.P.copy(), estimate.sensitivity.copy()
        self.gust, self.raised = gust, 1.0
        self.forget_update()

    def forget_update(self):
        self.innovation, self.nis, self.log_likelihood, self.capped = np.zeros(9), 0.0, 0.0, False

    def process_noise(self, y, fins, air, settings, fins_known):
        """Density of the process noise, 12 x 12."""
        density = settings.density.copy()
        density[WIND] *= self.gust ** 2
        density[3:6] *= self.raised
        q = np.diag(density)
        if settings.process >= 1:  # a change of the wind changes the air velocity too: v_a' contains -C_bn v_w'
            c_bn = model.body_to_ned(*y[6:9]).T
            q[:3, :3] += density[9] * np.eye(3)
            q[:3, WIND] = -density[9] * c_bn
            q[WIND, :3] = q[:3, WIND].T
        if settings.process >= 2:
            effects = model.effects_of_parts(y, fins, *air)
            q[:6, :6] += settings.coefficient ** 2 * COEFFICIENT_HOLD_S * (effects @ effects.T)
        if not fins_known:
            effects = model.effects_of_fins(y, *air)
            q[:6, :6] += 2 * FIN_UNKNOWN_RAD ** 2 * FIN_TIME_S * (effects @ effects.T)
        return q

    def predict(self, dt, fins, air, settings, fins_known):
        """fins: deflections at the begin, the middle and the end of the step. air: density, speed of sound."""
        y = self.x[:9].tolist()
        a = model.jacobian(y, fins[1], *air) * dt
        f = np.eye(12) + a + a @ a / 2
        q = self.process_noise(y, fins[1], air, settings, fins_known)
        if settings.considers:
            self.sensitivity = f @ self.sensitivity
            self.sensitivity[:6, :COEFFICIENT_PARTS] += dt * model.effects_of_parts(y, fins[1], *air)
        self.x[:9] = model.advanced(y, fins, *air, dt)
        p = f @ self.P @ f.T + q * dt
        self.P = (p + p.T) / 2

    def update(self, measured, dt, settings):
        prediction, h = expected(self.x)
        innovation = measured - prediction
        innovation[6:] = wrapped(innovation[6:])
        ph = self.P @ h.T
        s = h @ ph
        s.flat[::10] += settings.sensor
        inverse = np.linalg.inv(s)
        self.innovation, self.nis = innovation, float(innovation @ inverse @ innovation)
        if settings.process == 3:
            self.log_likelihood = -0.5 * (self.nis + np.linalg.slogdet(s)[1])
        gain = ph @ inverse
        p = self.P - gain @ ph.T
        self.P = (p + p.T) / 2
        if settings.algorithm == "h_infinity":
            gain = self.inflate(h, gain, dt, settings)
        elif settings.algorithm == "adaptive_q":
            self.adapt(dt, settings)
        self.x = self.x + gain @ innovation
        if settings.considers:
            seen = h @ self.sensitivity
            seen[:3, -6:-3] += np.eye(3)
            seen[6:, -3:] += np.eye(3)
            self.sensitivity -= gain @ seen

    def inflate(self, h, gain, dt, settings):
        """Raises P to that of the H-infinity filter; returns its gain. With B = S^1/2 L P L' S^1/2 (L: air velocity and rates):
        P~ = P + P L' S^1/2 (1/theta - B)^-1 S^1/2 L P,  K = P~ H' R^-1, if theta lambda_max(B) < 1."""
        p = settings.parameters
        theta = p["theta_per_s"] * min(dt, 0.1)
        if theta == 0:
            return gain
        weighted = settings.weight[:, None] * self.P[:6]
        b = weighted[:, :6] * settings.weight
        largest = float(np.linalg.eigvalsh(b)[-1])
        cap = min(p["theta_cap_per_s"] * dt, 0.9)
        self.capped = theta * largest > cap
        if self.capped:
            theta = cap / largest
        if theta == 0:
            return gain
        raised = self.P + weighted.T @ np.linalg.solve(np.eye(6) / theta - b, weighted)
        self.P = (raised + raised.T) / 2
        return self.P @ h.T / settings.sensor

    def adapt(self, dt, settings):
        """The variance of the noise of the rates follows the NIS, whose mean is 9 if the noise is right."""
        p = settings.parameters
        share = min(dt / p["adaptation_time_s"], 1.0)
        self.raised = min(max(self.raised * (1 + share * (self.nis / 9 - 1)), 1.0), p["adaptation_limit"])


class Bank:
    """One filter, or two whose results are weighted by their likelihood: an interacting multiple model (Blom and Bar-Shalom, IEEE AC-33 (1988), 780)
    of calm air and gusts."""

    def __init__(self, estimate, settings):
        self.populate(estimate, settings)

    def populate(self, estimate, settings):
        self.filters = [Filter(estimate, gust) for gust in settings.gust_factors]
        self.weights = np.array([0.9, 0.1]) if len(self.filters) == 2 else np.ones(1)
        self.combine()

    def predict(self, seconds, deflections, now_s, height, settings, fins_known):
        """From now_s over so many seconds. deflections: function of time. Returns the height at the end."""
        if len(self.filters) != len(settings.gust_factors):
            self.populate(self.estimate, settings)
        self.mix(seconds)
        for one in self.filters:
            one.forget_update()
        steps = max(math.ceil(seconds / LONGEST_STEP_S - 1e-6), 1)
        dt = seconds / steps
        for step in range(steps):
            begin = now_s + step * dt
            fins = [deflections(begin + share * dt) for share in (0, 0.5, 1)]
            air = model.standard_air(height)
            height -= dt * float(expected(self.filters[0].x)[0][2])
            for one in self.filters:
                one.predict(dt, fins, air, settings, fins_known)
        self.combine()
        return height

    def mix(self, seconds):
        """The weights after a possible change between calm and gust, and the states from which each filter goes on."""
        if len(self.filters) == 1:
            return
        up, down = 1 - math.exp(-seconds / CALM_LASTS_S), 1 - math.exp(-seconds / GUST_LASTS_S)
        joint = self.weights[:, None] * np.array([[1 - up, up], [down, 1 - down]])  # [from, to]
        self.weights = joint.sum(axis=0)
        mixed = [weighted_mean(self.filters, joint[:, to] / self.weights[to]) for to in (0, 1)]
        for one, (x, covariance, sensitivity) in zip(self.filters, mixed):
            one.x, one.P, one.sensitivity = x, covariance, sensitivity

    def update(self, measured, dt, settings):
        for one in self.filters:
            one.update(measured, dt, settings)
        if len(self.filters) == 2:
            logs = np.array([one.log_likelihood for one in self.filters])
            weights = self.weights * np.exp(logs - logs.max())
            self.weights = np.maximum(weights / weights.sum(), 1e-6)
            self.weights /= self.weights.sum()
        self.combine()

    def combine(self):
        if len(self.filters) == 1:
            one = self.filters[0]
            self.estimate = Estimate(one.x, one.P, one.sensitivity)
        else:
            self.estimate = Estimate(*weighted_mean(self.filters, self.weights))

    @property
    def x(self):
        return self.estimate.x

    def reported(self, settings):
        """The covariance with the lasting errors."""
        sensitivity = self.estimate.sensitivity
        return self.estimate.P + (sensitivity * settings.lasting) @ sensitivity.T if settings.considers else self.estimate.P

    def of_filters(self, what):
        return sum(weight * getattr(one, what) for weight, one in zip(self.weights, self.filters))

    @property
    def capped(self):
        return any(one.capped for one in self.filters)

    def is_sound(self):
        return bool(np.isfinite(self.estimate.x).all() and np.isfinite(self.estimate.P).all() and (self.estimate.P.diagonal() >= 0).all())


def weighted_mean(filters, weights):
    """Mean, covariance and sensitivity of a mixture."""
    x = sum(weight * one.x for weight, one in zip(weights, filters))
    covariance = sum(weight * (one.P + np.outer(one.x - x, one.x - x)) for weight, one in zip(weights, filters))
    return x, covariance, sum(weight * one.sensitivity for weight, one in zip(weights, filters))
