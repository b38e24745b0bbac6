"""The strapdown navigation of the slave: IMU samples to attitude, velocity, latitude and height (SI units, rad, axes north-east-down).

C turns body axes into north-east-down axes. The equations are those of the specification, "Exact discretisation of the vectors"; the mechanisation
with two samples adds coning and sculling.
"""

import collections
import math

import numpy as np

EARTH_RATE = 7.292115e-5  # [rad/s]
RADIUS, ECCENTRICITY2 = 6378137.0, 6.69437999014e-3  # WGS-84: semi-major axis [m]; first eccentricity squared
CONTIGUOUS_US = 100  # a sample that begins so near to the end of the sample before continues it
GAP_LIMIT_US = 200_000  # an INS does not survive a longer gap between its IMU samples
MEMORY_SAMPLES = 50  # of the statistics of the motion


class Silent(Exception):
    """The IMU was silent for too long: attitude and velocity are lost."""


def cross(a, b):
    """The vector product; numpy's own is slow for single vectors."""
    (a1, a2, a3), (b1, b2, b3) = a.tolist(), b.tolist()
    return np.array((a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1))


def skew(a):
    """[a x]: skew(a) @ b is a x b."""
    x, y, z = a.tolist()
    return np.array(((0, -z, y), (z, 0, -x), (-y, x, 0)))


def rotation(a):
    """exp([a x]) = I + sin|a|/|a| [a x] + (1 - cos|a|)/|a|^2 [a x]^2."""
    x, y, z = a.tolist()
    square = x * x + y * y + z * z
    if square < 1e-8:  # the series: no 0/0
        s, c = 1 - square / 6, 0.5 - square / 24
    else:
        angle = math.sqrt(square)
        s, c = math.sin(angle) / angle, (1 - math.cos(angle)) / square
    return np.array(((1 - c * (y * y + z * z), c * x * y - s * z, c * x * z + s * y),
                     (c * x * y + s * z, 1 - c * (x * x + z * z), c * y * z - s * x),
                     (c * x * z - s * y, c * y * z + s * x, 1 - c * (x * x + y * y))))


def attitude(roll, pitch, heading):
    """C of Euler angles 3-2-1."""
    return rotation(np.array((0, 0, heading))) @ rotation(np.array((0, pitch, 0))) @ rotation(np.array((roll, 0, 0)))


def euler(C):
    """Roll, pitch, heading of C."""
    return math.atan2(C[2, 1], C[2, 2]), -math.asin(min(1.0, max(-1.0, C[2, 0]))), math.atan2(C[1, 0], C[0, 0])


# The movement in an interval: its end [us] and length [s]; mean rate [rad/s] and specific force [m/s2], and how fast both change; variances of
# rotation [rad^2] and velocity [m^2/s^2] if it is a guess (a bridge over lost samples), else None.
Motion = collections.namedtuple("Motion", "end_us dt rate force rate_slope force_slope variance")
STILL = np.zeros(3)


def split(motion, t_us):
    """The parts of an interval before and after t_us. Rate and force are linear in time, so a part's means are off the whole's by its middle."""
    parts, begin_us = [], motion.end_us - round(motion.dt * 1e6)
    for end_us, dt in ((t_us, (t_us - begin_us) * 1e-6), (motion.end_us, (motion.end_us - t_us) * 1e-6)):
        off = end_us * 1e-6 - motion.end_us * 1e-6 + (motion.dt - dt) / 2  # from the middle of the whole to the middle of the part
        variance = None if motion.variance is None else motion.variance * (dt / motion.dt)
        parts.append(motion._replace(end_us=end_us, dt=dt, rate=motion.rate + off * motion.rate_slope,
                                     force=motion.force + off * motion.force_slope, variance=variance))
    return parts


class ImuStream:
    """Makes intervals without gaps and overlaps from IMU samples."""

    def __init__(self, start_us, two_samples):
        self.end_us, self.two_samples = start_us, two_samples
        self.before = collections.deque(maxlen=2)  # the motions [rate, force] of the last samples
        self.dt_before = 0.0
        self.mean, self.square, self.curvature = np.zeros(6), np.zeros(6), np.zeros(6)

    def take(self, values, t_us):
        """The intervals of a sample: the bridge over a gap before it, if there is one, and its own."""
        increment = np.array([values[f"delta_{what}"] for what in ("theta_x_rad", "theta_y_rad", "theta_z_rad", "v_x_mps", "v_y_mps", "v_z_mps")])
        own_us = values["interval_us"] or t_us - self.end_us
        gap_us = t_us - own_us - self.end_us
        if gap_us > GAP_LIMIT_US:
            raise Silent
        if abs(gap_us) < CONTIGUOUS_US:  # the clocks round: the increments stay whole
            gap_us, own_us = 0, t_us - self.end_us
        now, dt = increment / (own_us * 1e-6), min(own_us, t_us - self.end_us) * 1e-6  # of an overlap, only the new part
        found = []
        if gap_us > 0:
            found.append(self.bridge(now, gap_us, t_us - own_us, own_us))
        follows = gap_us == 0 and self.two_samples and self.before
        slope = (now - self.before[-1]) * (2 / (dt + self.dt_before)) if follows else None
        found.append(Motion(t_us, dt, now[:3], now[3:], *((slope[:3], slope[3:]) if follows else (STILL, STILL)), None))
        self.learn(now, gap_us == 0)
        self.before.append(now)
        self.end_us, self.dt_before = t_us, dt
        return found

    def bridge(self, now, gap_us, end_us, own_us):
        """A gap is bridged with the mean of the neighbours. This is wrong by what straight lines through recent samples were wrong by, times the
        square of the length of the gap, but not by more than the motion itself varies."""
        motion, dt = (now + self.before[-1]) / 2 if self.before else now, gap_us * 1e-6
        square = np.minimum(self.curvature * (gap_us / own_us) ** 4, self.square)
        return Motion(end_us, dt, motion[:3], motion[3:], STILL, STILL, square * dt * dt)

    def learn(self, now, follows):
        """Means over recent samples of the squares: of the motion about its mean, and of a sample from the middle of its neighbours."""
        off = now - self.mean
        self.mean = self.mean + off / MEMORY_SAMPLES
        self.square = self.square + (off * off - self.square) / MEMORY_SAMPLES
        if follows and len(self.before) == 2:
            off = self.before[1] - (self.before[0] + now) / 2
            self.curvature = self.curvature + (off * off - self.curvature) / MEMORY_SAMPLES


class Ins:
    """The navigation state, and sums over the time since the last step of the error filter, which needs their means. No array is changed in place, so
    that copy.copy is a copy."""

    def __init__(self, t_us, C, V, latitude, height, with_products):
        self.t_us, self.C, self.V, self.latitude, self.height = t_us, C, V, latitude, height
        self.accel_bias, self.gyro_bias = np.zeros(3), np.zeros(3)
        self.earth_rate = self.transport_rate = self.rate = STILL
        self.with_products = with_products
        self.clear_sums()

    def clear_sums(self):
        self.time, self.force_sum, self.C_sum, self.variance_sum = 0.0, np.zeros(3), np.zeros((3, 3)), np.zeros(6)
        self.force_products = self.rate_products = np.zeros((3, 9))  # sums of C[:, i] f[j] and C[:, i] w[j]

    def advance(self, motion):
        dt, w, f = motion.dt, motion.rate - self.gyro_bias, motion.force - self.accel_bias
        turn, delta_v = w * dt, f * dt
        if motion.rate_slope is not STILL:
            # If rate and force are linear in time, coning 1/2 int(alpha x w) dt and sculling have these closed forms.
            third = dt * dt * dt / 12
            turn = turn + third * cross(w, motion.rate_slope)
            delta_v = delta_v + third * (cross(w, motion.force_slope) + cross(f, motion.rate_slope))
        gravity, north_radius = self.earth()
        w_in = self.earth_rate + self.transport_rate
        C = rotation(w_in * -dt) @ self.C @ rotation(turn)
        mean_C = (self.C + C) / 2
        force_dt = mean_C @ delta_v
        V = self.V + force_dt - cross(self.earth_rate + w_in, self.V) * dt  # V' = C f + g - (2 w_ie + w_en) x V
        V[2] += gravity * dt
        self.latitude += (self.V[0] + V[0]) / 2 * dt / north_radius
        self.height -= (self.V[2] + V[2]) / 2 * dt
        self.C, self.V, self.t_us = C, V, motion.end_us
        self.rate = w + motion.rate_slope * (dt / 2)  # at the end of the interval
        self.time += dt
        self.force_sum = self.force_sum + force_dt
        self.C_sum = self.C_sum + mean_C * dt
        if motion.variance is not None:
            self.variance_sum = self.variance_sum + motion.variance
        if self.with_products:
            self.force_products = self.force_products + (mean_C[:, :, None] * (f * dt)).reshape(3, 9)
            self.rate_products = self.rate_products + (mean_C[:, :, None] * (w * dt)).reshape(3, 9)

    def earth(self):
        """Sets the rates of earth and transport; returns gravity and the radius of the meridian at this height."""
        sine, cosine = math.sin(self.latitude), math.cos(self.latitude)
        divisor = 1 - ECCENTRICITY2 * sine * sine
        east_radius = RADIUS / math.sqrt(divisor) + self.height
        north_radius = RADIUS * (1 - ECCENTRICITY2) / (divisor * math.sqrt(divisor)) + self.height
        north, east, _ = self.V.tolist()
        self.earth_rate = np.array((EARTH_RATE * cosine, 0, -EARTH_RATE * sine))
        self.transport_rate = np.array((east / east_radius, -north / north_radius, -east / east_radius * sine / cosine))
        return 9.7803253359 * (1 + 0.00193185265241 * sine * sine) / math.sqrt(divisor) - 3.086e-6 * self.height, north_radius
