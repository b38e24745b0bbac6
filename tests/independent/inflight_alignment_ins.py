"""Strapdown inertial navigation over the WGS-84 ellipsoid. Vectors are tuples: for three components, plain floats are faster than numpy.

Axes: n is north, east, down; b is the body, forward, right, down. The quaternion q (w, x, y, z) and the matrix C turn b into n.
An Ins is never changed: after() and corrected() return new ones. So old states can be kept, and a late fix can go back to the time when it was valid.
"""

import math
from typing import NamedTuple

EARTH_RADIUS_M, ECCENTRICITY2, EARTH_RATE_RADPS = 6378137.0, 6.69437999014e-3, 7.292115e-5
ZERO = (0.0, 0.0, 0.0)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def product(p, q):
    """Of two quaternions."""
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def turn(v):
    """The quaternion exp(v/2) of a turn by the rotation vector v [rad]."""
    angle = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    k = math.sin(angle / 2) / angle if angle > 1e-6 else 0.5
    return math.cos(angle / 2), k * v[0], k * v[1], k * v[2]


def turn_of(roll, pitch, yaw):
    """The quaternion of Rz(yaw) Ry(pitch) Rx(roll)."""
    return product(product(turn((0.0, 0.0, yaw)), turn((0.0, pitch, 0.0))), turn((roll, 0.0, 0.0)))


def matrix(q):
    """The nine elements, row by row."""
    w, x, y, z = q
    return (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))


class Earth(NamedTuple):
    meridian_m: float  # radius of curvature northwards, plus height
    transverse_m: float  # the same eastwards
    rate: tuple  # w_ie, of the earth against the stars [rad/s], n axes
    transport: tuple  # w_en, of the n axes against the earth [rad/s]
    gravity: float  # [m/s2], down

    @classmethod
    def below(cls, latitude, height, v):
        sine, cosine = math.sin(latitude), math.cos(latitude)
        d = 1 - ECCENTRICITY2 * sine * sine
        transverse = EARTH_RADIUS_M / math.sqrt(d) + height
        meridian = EARTH_RADIUS_M * (1 - ECCENTRICITY2) / (d * math.sqrt(d)) + height
        gravity = 9.7803253359 * (1 + 0.00193185265241 * sine * sine) / math.sqrt(d) * (1 - 2 * height / EARTH_RADIUS_M)
        return cls(meridian, transverse, (EARTH_RATE_RADPS * cosine, 0.0, -EARTH_RATE_RADPS * sine),
                   (v[1] / transverse, -v[0] / meridian, -v[1] * sine / cosine / transverse), gravity)


class Sample(NamedTuple):
    """Increments of the body's rotation [rad] and of the specific force [m/s], as measured, over the time up to end_us."""
    end_us: int
    dt_s: float
    rotation: tuple
    velocity: tuple

    def until(self, t_us):
        """The parts of the sample before and after t_us, as if rate and force were constant over the sample."""
        share = 1 - (self.end_us - t_us) * 1e-6 / self.dt_s

        def part(end_us, of):
            return Sample(end_us, of * self.dt_s, tuple(of * x for x in self.rotation), tuple(of * x for x in self.velocity))

        return part(t_us, share), part(self.end_us, 1 - share)


class Ins(NamedTuple):
    t_us: int
    latitude: float  # [rad]
    longitude: float
    height: float
    v: tuple  # over ground, n axes
    q: tuple
    accel_bias: tuple = ZERO  # subtracted from the samples [m/s2], b axes
    gyro_bias: tuple = ZERO  # [rad/s]
    force: tuple = ZERO  # S, the integral of the specific force in n axes [m/s] since the last correction
    time: tuple = ZERO * 3  # A, the integral of C [s], row by row
    sample: Sample = None  # that led to this state
    increments: tuple = (1.0, ZERO, ZERO)  # of this sample, less the biases: interval, rotation, velocity

    def earth(self):
        return Earth.below(self.latitude, self.height, self.v)

    def after(self, sample):
        dt = sample.dt_s
        rotation = tuple(x - b * dt for x, b in zip(sample.rotation, self.gyro_bias))
        velocity = tuple(x - b * dt for x, b in zip(sample.velocity, self.accel_bias))
        # Rotation vector (coning) and force in the axes of the start (rotation, sculling), if rate and force change linearly
        # from the sample before to this one: increments a, b of equal intervals give b + a x b / 12.
        dt0, rotation0, velocity0 = self.increments
        k = dt * dt / (6 * dt0 * (dt0 + dt))
        coning, rotating = cross(rotation0, rotation), cross(rotation, velocity)
        sculling, sculling0 = cross(rotation0, velocity), cross(velocity0, rotation)
        turned = tuple(rotation[i] + k * coning[i] for i in range(3))
        x, y, z = (velocity[i] + rotating[i] / 2 + k * (sculling[i] + sculling0[i]) for i in range(3))

        earth = self.earth()
        spin = tuple(dt * (a + b) for a, b in zip(earth.rate, earth.transport))  # turn of the n axes
        C = matrix(self.q)
        pushed = C[0] * x + C[1] * y + C[2] * z, C[3] * x + C[4] * y + C[5] * z, C[6] * x + C[7] * y + C[8] * z
        lag = cross(spin, pushed)
        pushed = tuple(pushed[i] - lag[i] / 2 for i in range(3))
        coriolis = cross([2 * a + b for a, b in zip(earth.rate, earth.transport)], self.v)
        v = (self.v[0] + pushed[0] - dt * coriolis[0], self.v[1] + pushed[1] - dt * coriolis[1],
             self.v[2] + pushed[2] + dt * (earth.gravity - coriolis[2]))
        north, east, down = (dt * (a + b) / 2 for a, b in zip(self.v, v))

        q = product(turn([-x for x in spin]), product(self.q, turn(turned)))
        scale = 1.5 - 0.5 * sum(x * x for x in q)  # keeps the length at 1
        q = tuple(scale * x for x in q)
        return Ins(sample.end_us, self.latitude + north / earth.meridian_m,
                   self.longitude + east / (earth.transverse_m * math.cos(self.latitude)), self.height - down, v, q, self.accel_bias, self.gyro_bias,
                   tuple(a + b for a, b in zip(self.force, pushed)), tuple(a + dt * (b + c) / 2 for a, b, c in zip(self.time, C, matrix(q))),
                   sample, (dt, rotation, velocity))

    def corrected(self, position, velocity, rotation, accel_bias=ZERO, gyro_bias=ZERO):
        """Less the errors of position [m] and velocity, turned by the quaternion `rotation`, with the found biases added. S and A begin anew."""
        earth = self.earth()
        return self._replace(
            latitude=self.latitude - position[0] / earth.meridian_m,
            longitude=self.longitude - position[1] / (earth.transverse_m * math.cos(self.latitude)), height=self.height + position[2],
            v=tuple(a - b for a, b in zip(self.v, velocity)), q=product(rotation, self.q),
            accel_bias=tuple(a + b for a, b in zip(self.accel_bias, accel_bias)), gyro_bias=tuple(a + b for a, b in zip(self.gyro_bias, gyro_bias)),
            force=ZERO, time=ZERO * 3)

    def distance_from(self, latitude, longitude, height):
        """North, east, down [m] from a point nearby."""
        earth = self.earth()
        return ((self.latitude - latitude) * earth.meridian_m,
                math.remainder(self.longitude - longitude, math.tau) * earth.transverse_m * math.cos(latitude), height - self.height)

    def angles(self):
        """Roll, pitch, heading [rad]."""
        C = matrix(self.q)
        return math.atan2(C[7], C[8]), -math.asin(max(-1.0, min(1.0, C[6]))), math.atan2(C[3], C[0])
