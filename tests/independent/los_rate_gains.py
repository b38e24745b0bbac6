"""Gains that depend on range and closing speed alone, after Na and Lee, and the gain of a low-pass filter.

A plane has the states e (error angle), w (LOS rate), a (acceleration of the target), with a measured e:

    e' = w - q        w' = (2 vc w + a - a_m) / r        a' = white noise of density J        vc = -r'

In the displacements y1 = r e, y2 = r w - vc e, y3 = a, this is a chain of three integrators. The units are m, s and rad.
"""

import cmath
import math
from typing import NamedTuple


class Noise(NamedTuple):
    """1-sigmas of an error angle in one plane."""
    thermal_radpm2: float  # times r^2
    glint_m: float  # divided by r
    constant_rad: float

    def variance(self, r):
        return (self.thermal_radpm2 * r * r) ** 2 + (self.glint_m / r) ** 2 + self.constant_rad**2

    def crossing_m(self):
        """The range at which thermal noise and glint are equal."""
        return (self.glint_m / self.thermal_radpm2) ** (1 / 3)

    def dominant(self, r):
        """The one noise that the switched table knows at this range."""
        return Noise(self.thermal_radpm2, 0, 0) if r > self.crossing_m() else Noise(0, self.glint_m, 0)


def displacement_gain(bandwidth, nu):
    """The stationary gain (d1, d2, d3) of the displacements for a noise density that falls as exp(-6 nu t); bandwidth = (J / density)^(1/6).

    Scaling the displacements by exp(nu t) makes the Riccati equation algebraic. Its closed loop s^3 + c1 s^2 + c2 s + c3 has the stable roots
    of (z - nu^2/4)(z - 9 nu^2/4)(z - 25 nu^2/4) = bandwidth^6, z = s^2. Glint alone has nu = 0: a Butterworth filter of third order.
    """
    nu2 = nu * nu
    c3 = math.sqrt(bandwidth**6 + 225 / 64 * nu2**3)
    # The largest root c1 of (c1^2 - 35 nu^2/4)^2 / 4 = 2 c1 c3 + 259 nu^4 / 16, by Newton's rule from above, where the difference is convex.
    c1 = 2 * bandwidth + 4.5 * abs(nu)
    for _ in range(20):
        c2 = (c1 * c1 - 35 / 4 * nu2) / 2
        step = (c2 * c2 - 2 * c1 * c3 - 259 / 16 * nu2 * nu2) / (2 * c1 * c2 - 2 * c3)
        c1 -= step
        if abs(step) < 1e-14 * c1:
            break
    c2 = (c1 * c1 - 35 / 4 * nu2) / 2
    k1 = c1 + 4.5 * nu
    k2 = c2 - 1.25 * nu2 - 3 * nu * (1.5 * nu - k1)
    k3 = (1.5 * nu - k1) * 1.25 * nu2 + nu / 2 * k2 + c3
    return k1, k2 - nu * k1, k3


def cubic_roots(c1, c2, c3):
    """The roots of s^3 + c1 s^2 + c2 s + c3, by Cardano's formula."""
    p = (3 * c2 - c1 * c1) / 9
    h = (c1 * (2 * c1 * c1 - 9 * c2) + 27 * c3) / 54
    root = cmath.sqrt(h * h + p**3)
    u = max(-h + root, -h - root, key=abs) ** (1 / 3)
    if u == 0:
        return (complex(-c1 / 3),) * 3
    turns = (u, u * cmath.exp(2j / 3 * math.pi), u * cmath.exp(-2j / 3 * math.pi))
    return tuple(t - p / t - c1 / 3 for t in turns)


def discrete_gain(d, r, vc, period):
    """The gain (e, w, a) of samples with this period whose poles are exp(s period), where s are the poles of the gain d of the displacements."""
    s1, s2, s3 = (1 - cmath.exp(pole * period) for pole in cubic_roots(*d))
    # With z = 1 - s the displacements' alpha-beta-gamma filter has z^3 + D1 z^2 + D2 z + D3, and alpha = 1 + D3, gamma = 1 + D1 + D2 + D3.
    alpha = (1 - (1 - s1) * (1 - s2) * (1 - s3)).real
    gamma = (s1 * s2 * s3).real
    beta = (s1 + s2 + s3).real - alpha - gamma / 2
    return alpha, beta / period + alpha * vc / r, r * gamma / period**2


def range_gain(noise, jerk_density, r, vc, period):
    """The stationary gain (e, w, a) for these noises at this range."""
    # The density of the noise of y1 = r e. Each noise falls by its own power of the range; nu is a sixth of the rate at which the sum falls.
    thermal = (noise.thermal_radpm2 * r**3) ** 2 * period
    glint = noise.glint_m**2 * period
    constant = (noise.constant_rad * r) ** 2 * period
    density = thermal + glint + constant
    nu = vc / r * (thermal + constant / 3) / density
    return discrete_gain(displacement_gain((jerk_density / density) ** (1 / 6), nu), r, vc, period)


def low_pass_gain(bandwidth, damping, period):
    """The gain (e, w) with which w follows the true LOS rate as bandwidth^2 / (s^2 + 2 damping bandwidth s + bandwidth^2), poles matched."""
    decay = math.exp(-damping * bandwidth * period)
    swing = cmath.cos(bandwidth * period * cmath.sqrt(1 - damping * damping)).real  # cosh if the damping is above 1
    alpha = 1 - decay * decay
    return alpha, (2 - alpha - 2 * decay * swing) / period
