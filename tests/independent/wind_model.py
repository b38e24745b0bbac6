"""The glider of the wind estimator: standard atmosphere, aerodynamics and rigid body, and their derivatives.

State [u v w p q r phi theta psi wn we wd]: velocity through the air and body rates in body axes (x forward, y right, z down), Euler angles 3-2-1
from NED, wind in NED; m/s, rad, rad/s. Fins (de, da, dr) in rad.
"""

from math import asin, atan2, cos, exp, radians, sin, sqrt, tan, tanh

import numpy as np

GRAVITY = 9.80665
MASS = 300.0
IXX, IYY, IZZ, IXZ = 8.0, 120.0, 125.0, 0.5
AREA, SPAN, CHORD = 0.65, 2.6, 0.25

# The coefficients are those of a body with a planar wing at small angles. Beyond these ranges each variable is held at the end of its range.
ALPHA, BETA, SPEED, MACH = (-radians(20), radians(20)), (-radians(20), radians(20)), (40.0, 350.0), (0.0, 1.1)
HEIGHT, PITCH = (-500.0, 20000.0), (-radians(80), radians(80))

DETERMINANT = IXX * IZZ - IXZ * IXZ
INVERSE_INERTIA = np.array([[IZZ, 0, IXZ], [0, DETERMINANT / IYY, 0], [IXZ, 0, IXX]]) / DETERMINANT
INERTIA = np.array([[IXX, 0, -IXZ], [0, IYY, 0], [-IXZ, 0, IZZ]])
# From [CX CY CZ Cl Cm Cn], times dynamic pressure and area, to the accelerations of velocity and rates.
MOTION = np.zeros((6, 6))
MOTION[:3, :3] = np.eye(3) / MASS
MOTION[3:, 3:] = INVERSE_INERTIA * [SPAN, CHORD, SPAN]


def held(value, ends):
    return ends[0] if value < ends[0] else ends[1] if value > ends[1] else value


def standard_air(height_m):
    """Density [kg/m3] and speed of sound [m/s] of the ISA."""
    height = held(height_m, HEIGHT)
    temperature = 288.15 - 0.0065 * min(height, 11000.0)
    pressure = 101325.0 * (temperature / 288.15) ** 5.2558797
    if height > 11000.0:
        pressure *= exp(-GRAVITY * (height - 11000.0) / (287.05287 * temperature))
    return pressure / (287.05287 * temperature), sqrt(1.4 * 287.05287 * temperature)


def free_flow(u, v, w, sound):
    """Angle of attack, sideslip, speed and Mach number, wherever they are."""
    speed = sqrt(u * u + v * v + w * w)
    return atan2(w, u), asin(v / speed) if speed else 0.0, speed, speed / sound


def flow(u, v, w, sound):
    """The same within the ranges of the model."""
    alpha, beta, speed, mach = free_flow(u, v, w, sound)
    return held(alpha, ALPHA), held(beta, BETA), held(speed, SPEED), held(mach, MACH)


def outside(x, height, sound):
    """Names of the variables that are beyond the ranges of the model."""
    values = (*free_flow(*x[:3], sound), height, x[7])
    names = ("alpha", "beta", "speed", "mach", "altitude", "pitch")
    return [name for name, value, ends in zip(names, values, (ALPHA, BETA, SPEED, MACH, HEIGHT, PITCH)) if not ends[0] <= value <= ends[1]]


def parts(alpha, beta, speed, mach, p, q, r, fins):
    """Static, rate and control part of CL, CD, CY, Cl, Cm, Cn."""
    de, da, dr = fins
    k = 1 + 0.30 * mach * mach
    b, c = SPAN / (2 * speed), CHORD / (2 * speed)
    lift = (k * (0.10 + 5.5 * alpha), 6.0 * q * c, k * 0.40 * de)
    total = lift[0] + lift[1] + lift[2]
    wave = 0.03 * (1 + tanh((mach - 0.92) / 0.04))
    return (lift,
            (0.070 + 0.050 * total * total + 0.50 * beta * beta + wave, 0.0, 0.30 * (de * de + da * da + dr * dr)),
            (k * -0.90 * beta, 0.35 * r * b, k * 0.25 * dr),
            (k * -0.05 * beta, (-0.50 * p + 0.10 * r) * b, k * (0.08 * da + 0.01 * dr)),
            (k * (0.06 - 1.50 * alpha), -27.0 * q * c, k * -1.80 * de),
            (k * 0.080 * beta, (-0.03 * p - 0.25 * r) * b, k * (-0.005 * da - 0.10 * dr)))


def derivative(y, fins, density, sound):
    """d/dt of the first nine states. Forces are in stability axes, moments about the centre of gravity:
    v_a' = -omega x v_a + F/m + C_bn g,  omega' = I^-1 (M - omega x I omega); the wind is constant in the mean."""
    u, v, w, p, q, r, phi, theta, _ = y
    alpha, beta, speed, mach = flow(u, v, w, sound)
    lift, drag, side, roll, pitch, yaw = [a + b + c for a, b, c in parts(alpha, beta, speed, mach, p, q, r, fins)]
    pressure = 0.5 * density * speed * speed * AREA
    specific = pressure / MASS
    sa, ca = sin(alpha), cos(alpha)
    sf, cf, st, ct = sin(phi), cos(phi), sin(theta), cos(theta)
    hx, hy, hz = IXX * p - IXZ * r, IYY * q, IZZ * r - IXZ * p
    tx = pressure * SPAN * roll - (q * hz - r * hy)
    ty = pressure * CHORD * pitch - (r * hx - p * hz)
    tz = pressure * SPAN * yaw - (p * hy - q * hx)
    within = held(theta, PITCH)
    turn = q * sf + r * cf
    return (specific * (lift * sa - drag * ca) - (q * w - r * v) - GRAVITY * st,
            specific * side - (r * u - p * w) + GRAVITY * sf * ct,
            specific * (-lift * ca - drag * sa) - (p * v - q * u) + GRAVITY * cf * ct,
            (IZZ * tx + IXZ * tz) / DETERMINANT, ty / IYY, (IXZ * tx + IXX * tz) / DETERMINANT,
            p + tan(within) * turn, q * cf - r * sf, turn / cos(within))


def advanced(y, fins, density, sound, dt):
    """One step of Runge and Kutta. fins: deflections at the begin, the middle and the end of the step."""
    half = dt / 2
    k1 = derivative(y, fins[0], density, sound)
    k2 = derivative([a + half * b for a, b in zip(y, k1)], fins[1], density, sound)
    k3 = derivative([a + half * b for a, b in zip(y, k2)], fins[1], density, sound)
    k4 = derivative([a + dt * b for a, b in zip(y, k3)], fins[2], density, sound)
    return [s + dt / 6 * (a + 2 * (b + c) + d) for s, a, b, c, d in zip(y, k1, k2, k3, k4)]


def cross(a):
    """[a x]"""
    x, y, z = a
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def aerodynamic_jacobian(u, v, w, p, q, r, fins, density, sound):
    """Derivatives of the accelerations by [u v w p q r]: first by (alpha, beta, V, p, q, r), then by the chain rule."""
    de, da, dr = fins
    alpha, beta, speed, mach = flow(u, v, w, sound)
    k, k_v = 1 + 0.30 * mach * mach, 0.60 * mach / sound
    b, c = SPAN / (2 * speed), CHORD / (2 * speed)
    b_v, c_v = -b / speed, -c / speed
    sa, ca = sin(alpha), cos(alpha)
    wave = tanh((mach - 0.92) / 0.04)

    lift = k * (0.10 + 5.5 * alpha + 0.40 * de) + 6.0 * q * c
    lift_a, lift_v, lift_q = k * 5.5, k_v * (0.10 + 5.5 * alpha + 0.40 * de) + 6.0 * q * c_v, 6.0 * c
    drag = 0.070 + 0.050 * lift * lift + 0.50 * beta * beta + 0.03 * (1 + wave) + 0.30 * (de * de + da * da + dr * dr)
    drag_a, drag_b, drag_q = 0.10 * lift * lift_a, beta, 0.10 * lift * lift_q
    drag_v = 0.10 * lift * lift_v + 0.03 / 0.04 * (1 - wave * wave) / sound
    side, roll = -0.90 * beta + 0.25 * dr, -0.05 * beta + 0.08 * da + 0.01 * dr
    pitch, yaw = 0.06 - 1.50 * alpha - 1.80 * de, 0.080 * beta - 0.005 * da - 0.10 * dr
    value = np.array([lift * sa - drag * ca, k * side + 0.35 * r * b, -lift * ca - drag * sa, k * roll + (-0.50 * p + 0.10 * r) * b,
                      k * pitch - 27.0 * q * c, k * yaw + (-0.03 * p - 0.25 * r) * b])
    by_flow = np.array([
        [(lift_a + drag) * sa + (lift - drag_a) * ca, -drag_b * ca, lift_v * sa - drag_v * ca, 0, lift_q * sa - drag_q * ca, 0],
        [0, k * -0.90, k_v * side + 0.35 * r * b_v, 0, 0, 0.35 * b],
        [(lift - drag_a) * sa - (lift_a + drag) * ca, -drag_b * sa, -lift_v * ca - drag_v * sa, 0, -lift_q * ca - drag_q * sa, 0],
        [0, k * -0.05, k_v * roll + (-0.50 * p + 0.10 * r) * b_v, -0.50 * b, 0, 0.10 * b],
        [k * -1.50, 0, k_v * pitch - 27.0 * q * c_v, 0, -27.0 * c, 0],
        [0, k * 0.080, k_v * yaw + (-0.03 * p - 0.25 * r) * b_v, -0.03 * b, 0, -0.25 * b]])
    by_flow[:, 2] += 2 / speed * value  # of the dynamic pressure
    level2 = max(u * u + w * w, 1.0)
    level, speed2 = sqrt(level2), speed * speed
    by_velocity = np.array([[-w / level2, 0, u / level2],
                            [-u * v / (speed2 * level), level / speed2, -v * w / (speed2 * level)],
                            [u / speed, v / speed, w / speed]])
    gradient = np.empty((6, 6))
    gradient[:, :3] = by_flow[:, :3] @ by_velocity
    gradient[:, 3:] = by_flow[:, 3:]
    return (0.5 * density * speed2 * AREA) * (MOTION @ gradient)


def jacobian(y, fins, density, sound):
    """A = df/dx, 12 x 12. Nothing depends on the wind or the heading."""
    u, v, w, p, q, r, phi, theta, _ = y
    sf, cf, st, ct = sin(phi), cos(phi), sin(theta), cos(theta)
    within = held(theta, PITCH)
    t, s = tan(within), 1 / cos(within)
    turn, lean = q * sf + r * cf, q * cf - r * sf
    a = np.zeros((12, 12))
    a[:6, :6] = aerodynamic_jacobian(u, v, w, p, q, r, fins, density, sound)
    omega = cross((p, q, r))
    a[:3, :3] -= omega
    a[:3, 3:6] += cross((u, v, w))
    a[3:6, 3:6] -= INVERSE_INERTIA @ (omega @ INERTIA - cross(INERTIA @ (p, q, r)))
    a[:3, 6:8] = [[0, -GRAVITY * ct], [GRAVITY * cf * ct, -GRAVITY * sf * st], [-GRAVITY * sf * ct, -GRAVITY * cf * st]]
    a[6:9, 3:6] = [[1, t * sf, t * cf], [0, cf, -sf], [0, s * sf, s * cf]]
    a[6:9, 6:8] = [[t * lean, s * s * turn], [-turn, 0], [s * lean, s * t * turn]]
    return a


def along_axes(alpha, lift, drag, side, roll, pitch, yaw):
    """[CX CY CZ Cl Cm Cn] from coefficients along the stability axes."""
    sa, ca = sin(alpha), cos(alpha)
    return (lift * sa - drag * ca, side, -lift * ca - drag * sa, roll, pitch, yaw)


def effects_of_parts(y, fins, density, sound):
    """Accelerations per unit relative error of each part of each coefficient: 6 x 17 (the drag has no rate part)."""
    u, v, w, p, q, r = y[:6]
    alpha, beta, speed, mach = flow(u, v, w, sound)
    columns = []
    for place, of_one in enumerate(parts(alpha, beta, speed, mach, p, q, r, fins)):
        for part, value in enumerate(of_one):
            if (place, part) != (1, 1):
                columns.append(along_axes(alpha, *[value if other == place else 0.0 for other in range(6)]))
    return (0.5 * density * speed * speed * AREA) * (MOTION @ np.array(columns).T)


def effects_of_fins(y, density, sound):
    """Accelerations per rad of elevator, aileron and rudder near their neutral position: 6 x 3."""
    u, v, w = y[:3]
    alpha, _, speed, mach = flow(u, v, w, sound)
    k = 1 + 0.30 * mach * mach
    columns = [along_axes(alpha, k * 0.40, 0, 0, 0, k * -1.80, 0), along_axes(alpha, 0, 0, 0, k * 0.08, 0, k * -0.005),
               along_axes(alpha, 0, 0, k * 0.25, k * 0.01, 0, k * -0.10)]
    return (0.5 * density * speed * speed * AREA) * (MOTION @ np.array(columns).T)


def body_to_ned(phi, theta, psi):
    """C_nb"""
    sf, cf, st, ct, sp, cp = sin(phi), cos(phi), sin(theta), cos(theta), sin(psi), cos(psi)
    return np.array([[ct * cp, sf * st * cp - cf * sp, cf * st * cp + sf * sp],
                     [ct * sp, sf * st * sp + cf * cp, cf * st * sp - sf * cp],
                     [-st, sf * ct, cf * ct]])


def by_attitude(c_nb, v_body, psi):
    """d(C_nb v)/d(phi, theta, psi), 3 x 3."""
    north, east, down = c_nb @ v_body
    roll = c_nb @ (0.0, -v_body[2], v_body[1])
    sp, cp = sin(psi), cos(psi)
    return np.array([[roll[0], cp * down, -east], [roll[1], sp * down, north], [roll[2], -(cp * north + sp * east), 0.0]])
