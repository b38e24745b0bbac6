#!/usr/bin/env python3
"""In-flight alignment: a left-invariant EKF on SE2(3) against the product's sin/cos filter, on the frames of the same runs.

Packages: python3-numpy python3-canmatrix. From the root of the tree, with a built hil-bench:

    docs/experiments/invariant_heading.py build/default/hil-bench --runs 100 --jobs 2 --work /tmp/invariant

Flies runs 0..N-1 of the sin/cos variants of bench/monte_carlo/paper_inflight/starts.toml (and from 90 deg with larger tilts) with
`campaign replay --log`, decodes the log with dbc/canhil.dbc, and gives the IMU samples, the fixes and the initial state to the invariant
filter. The heading and the sigma of the sin/cos filter are the target's answers in the same log. Decoded runs are stored in --work, so
that a second call only runs the filters. --forms adds variations of the invariant filter. invariant_heading.md contains the equations.
"""
import argparse
import functools
import multiprocessing
import pathlib
import re
import subprocess

import canmatrix.formats
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "bench/monte_carlo/paper_inflight"
STARTS = ((30, 1), (90, 1), (150, 1), (180, 1), (90, 3), (90, 5), (90, 10))  # heading error, sigma of the tilts [deg]
VARIANT = """
[[variant]]
name = "{aid}_{start}_{tilt}"
scenario = "{SCENARIOS}/{aid}_path.toml"
set = {{ target.algorithm = "sin_cos", target.parameters.closed_loop = 1, initial_error.heading_magnitude_deg = {start}.0, \
target.initial_sigma.heading_deg = {told}.0, initial_error.attitude_sigma_deg = [{tilt}.0, {tilt}.0, 0.0], \
target.initial_sigma.tilt_deg = {tilt}.0 }}
"""  # for initial errors of 150 and 180 deg, the sigma {told} is 600 deg (heading unknown), as in starts.toml
DEG, UG = np.pi / 180, 9.80665e-6
A, E2, EARTH_RATE = 6378137.0, 6.69437999014e-3, 7.292115e-5
DT, SAMPLES = 0.02, 50  # period of the IMU [s], and its samples between two fixes
T = SAMPLES * DT

# The sigmas and noise densities with which both filters are configured, as in ssbl_path.toml and gps_path.toml.
GYRO_NOISE, ACCEL_NOISE = 0.3 * DEG / 60, 50 * UG
GYRO_BIAS, ACCEL_BIAS = 1 * DEG / 3600, 1000 * UG
AIDS = {"ssbl": dict(position=[5.0, 5, 5], fix=[2.0, 2, 2], bias=3.1622777),
        "gps": dict(position=[10.0, 10, 15], fix=[10.0, 10, 15], bias=0.0)}


truth_heading = lambda t: (40 + 50 * np.sin(2 * np.pi * t / 33)) * DEG  # true heading [rad] on the path s_path of the scenarios
wrapped = lambda angle: (angle + np.pi) % (2 * np.pi) - np.pi
t_ = lambda M: np.swapaxes(M, -1, -2)
times = lambda M, v: (M @ v[..., None])[..., 0]


@functools.lru_cache
def dbc():
    return canmatrix.formats.loadp_flat(str(ROOT / "dbc/canhil.dbc"))


def decoded(log, message):
    """Decodes all frames of a message in the log: {signal: values}."""
    frame = dbc().frame_by_name(message)
    found = re.findall(b" %03X#([0-9A-F]{16}) " % frame.arbitration_id.id, log)
    raw = np.frombuffer(bytes.fromhex(b"".join(found).decode()), "<u8")
    values = {}
    for s in frame.signals:
        field = ((raw >> np.uint64(s.get_startbit())) & np.uint64((1 << s.size) - 1)).astype(np.int64)
        if s.is_signed:
            field = np.where(field >> (s.size - 1) == 1, field - (1 << s.size), field)
        values[s.name] = field * float(s.factor) + float(s.offset)
    return values


def fly(bench, work, aid, start, tilt, run):
    """Replays a run, and stores the increments, the fixes, the initial state and the target's answers in a file in `work`."""
    kept = work / f"{aid}_{start}_{tilt}_{run}.npz"
    if kept.exists():
        return
    log_file, variant = kept.with_suffix(".log"), f"{aid}_{start}_{tilt}"
    replay = [bench, "campaign", "replay", work / "cells.toml", str(run), "--variant", variant, "--log", log_file]
    said = subprocess.run(replay, capture_output=True, text=True).stdout
    log = log_file.read_bytes()
    log_file.unlink()
    of = lambda *messages: (decoded(log, message) for message in messages)
    axes = lambda values, *names: np.stack([values[name] for name in names], -1)
    theta, velocity, status = of("SlaveImuDeltaTheta", "SlaveImuDeltaV", "SlaveImuStatus")
    assert np.array_equal(status["time_of_validity_us"], 20000 * np.arange(1, 15001))
    if aid == "gps":
        latitude, longitude, time = of("GpsLatitude", "GpsLongitude", "GpsTime")
        fix = np.stack([latitude["latitude_deg"] * DEG, longitude["longitude_deg"] * DEG, latitude["height_m"]], -1)
    else:
        flat, latitude, longitude, time = of("SsblRelativeNE", "SsblShipLatitude", "SsblShipLongitude", "SsblRelativeD")
        lat, h = latitude["latitude_deg"] * DEG, latitude["height_m"]
        meridian, transverse = radii(lat)
        fix = np.stack([lat + flat["relative_north_m"] / (meridian + h),
                        longitude["longitude_deg"] * DEG + flat["relative_east_m"] / ((transverse + h) * np.cos(lat)),
                        h - time["relative_down_m"]], -1)
    assert np.array_equal(time["time_of_validity_us"], 1e6 * np.arange(1, 301))
    at, over, v, euler, down = of(*("TargetInit" + n for n in ("Latitude", "Longitude", "VelocityNE", "Attitude", "VelocityD")))
    when, answer, told = of("FixVelocityD", "FixAttitude", "FixAttitudeSigma")
    answer_t = when["cause_time_us"] / 1e6
    error = wrapped(answer["heading_deg"] * DEG - truth_heading(answer_t))
    end_mrad = float(re.search(r"error at the end .* heading ([-+.\d]+) mrad", said)[1])
    assert abs(error[-1] * 1e3 - end_mrad) < 0.001, "formula of the true heading against the error that the bench reports"
    first = np.searchsorted(answer_t, np.arange(1, 300))  # for each fix, the first answer that includes it; the campaign uses the same answer
    np.savez(kept, fix=fix,
             dtheta=axes(theta, *(f"delta_theta_{a}_rad" for a in "xyz")), dv=axes(velocity, *(f"delta_v_{a}_mps" for a in "xyz")),
             euler=axes(euler, "roll_deg", "pitch_deg", "heading_deg")[-1] * DEG,
             v=[v["velocity_north_mps"][-1], v["velocity_east_mps"][-1], down["velocity_down_mps"][-1]],
             position=[at["latitude_deg"][-1] * DEG, over["longitude_deg"][-1] * DEG, at["height_m"][-1]],
             error=error[first], sigma=told["heading_sigma_deg"][:299] * DEG)


def radii(lat):
    d = 1 - E2 * np.sin(lat) ** 2
    return A * (1 - E2) / (d * np.sqrt(d)), A / np.sqrt(d)


def skew(v):
    S = np.zeros(v.shape + (3,))
    S[..., 2, 1], S[..., 0, 2], S[..., 1, 0] = v[..., 0], v[..., 1], v[..., 2]
    return S - t_(S)


def exp_and_left_jacobian(v):
    """exp([v x]), and the matrix J for which the exponential of (v, u) on SE(3) has the translation J u."""
    angle = np.maximum(np.linalg.norm(v, axis=-1), 1e-9)[..., None, None]
    S, I = skew(v), np.eye(3)
    SS = S @ S
    one = 2 * np.sin(angle / 2) ** 2 / angle**2
    two = np.where(angle < 1e-3, 1 / 6, (angle - np.sin(angle)) / angle**3)
    return I + np.sin(angle) / angle * S + one * SS, I + one * S + two * SS


def from_euler(e):
    c, s, z, o = np.cos(e), np.sin(e), np.zeros(e.shape[:-1]), np.ones(e.shape[:-1])
    rows = lambda *r: np.stack(r, -1).reshape(e.shape[:-1] + (3, 3))
    return (rows(c[..., 2], -s[..., 2], z, s[..., 2], c[..., 2], z, z, z, o)
            @ rows(c[..., 1], z, s[..., 1], z, o, z, -s[..., 1], z, c[..., 1])
            @ rows(o, z, z, z, c[..., 0], -s[..., 0], z, s[..., 0], c[..., 0]))


def ecef(p):
    lat, lon, h = p[..., 0], p[..., 1], p[..., 2]
    n = radii(lat)[1]
    return np.stack([(n + h) * np.cos(lat) * np.cos(lon), (n + h) * np.cos(lat) * np.sin(lon), (n * (1 - E2) + h) * np.sin(lat)], -1)


def preintegrated(dtheta, dv):
    """The increments of rotation, velocity and position in each second, in the body axes at the start of this second, and the
    derivatives of these increments with respect to the biases. dtheta, dv: arrays of runs x seconds x SAMPLES x 3."""
    (v, p), (C_g, v_g, p_g, v_a, p_a) = np.zeros((2,) + dtheta[:, :, 0].shape), np.zeros((5,) + dtheta.shape[:2] + (3, 3))
    C = C_g + np.eye(3)
    for i in range(SAMPLES):
        turn, force = dtheta[:, :, i], dv[:, :, i] + 0.5 * np.cross(dtheta[:, :, i], dv[:, :, i])
        step = times(C, force)
        step_g = -C @ skew(force) @ C_g  # derivative of C force; C_g is defined by C(bg + dbg) = C exp(C_g dbg)
        p, p_g, p_a = p + (v + step / 2) * DT, p_g + (v_g + step_g / 2) * DT, p_a + (v_a - C * DT / 2) * DT
        v, v_g, v_a = v + step, v_g + step_g, v_a - C * DT
        turned = exp_and_left_jacobian(turn)[0]
        C, C_g = C @ turned, t_(turned) @ C_g - np.eye(3) * DT
    return dict(C=C, v=v, p=p, C_g=C_g, v_g=v_g, p_g=p_g, v_a=v_a, p_a=p_a)


R, V, P, G, B, F = (slice(3 * i, 3 * i + 3) for i in range(6))  # xi_R xi_v xi_p, gyro bias, accelerometer bias, xi of the fix bias


def invariant(data, aid, heading_sigma, tilt_sigma, iterations=1, reset=False):
    """Heading error and sigma [rad] after each fix: runs x fixes."""
    told, n = AIDS[aid], len(data["v"])
    lat, lon = data["position"][:, 0], data["position"][:, 1]
    # The axes are those of the tangent plane at the INS's initial position, so there is no transport rate. Earth rate and gravity are
    # known inputs.
    to_plane = t_(from_euler(np.stack([0 * lat, -np.pi / 2 - lat, lon], -1)))
    fixes = times(to_plane[:, None], ecef(data["fix"]) - ecef(data["position"])[:, None])
    earth = EARTH_RATE * np.stack([np.cos(lat), 0 * lat, -np.sin(lat)], -1)
    s2 = np.sin(lat) ** 2
    gravity = 9.7803253359 * (1 + 0.00193185265241 * s2) / np.sqrt(1 - E2 * s2) * (1 - 2 * data["position"][:, 2] / A)
    turned, half = exp_and_left_jacobian(-earth * T)[0], exp_and_left_jacobian(-earth * T / 2)[0]
    noise = np.diag(np.square(told["fix"]))
    Q = np.zeros(18)
    Q[R], Q[V] = GYRO_NOISE**2 * T, ACCEL_NOISE**2 * T

    C, v, (p, rho, bg, ba), cov = from_euler(data["euler"]), data["v"], np.zeros((4, n, 3)), np.zeros((n, 18, 18))
    in_body = lambda variances: t_(C) @ (variances[..., None] * C)
    cov[:, R, R] = in_body(np.tile(np.square([tilt_sigma, tilt_sigma, heading_sigma]), (n, 1)))
    cov[:, V, V] = 0.1**2 * np.eye(3)
    cov[:, P, P] = in_body(np.tile(np.square(told["position"]), (n, 1)))
    for part, sigma in ((G, GYRO_BIAS), (B, ACCEL_BIAS), (F, told["bias"])):
        cov[:, part, part] = sigma**2 * np.eye(3)

    errors, sigmas, nis = np.zeros((3, n, 299))
    for k in range(299):
        U = {name: value[:, k] for name, value in data["second"].items()}
        dv = U["v"] + times(U["v_g"], bg) + times(U["v_a"], ba)
        dp = U["p"] + times(U["p_g"], bg) + times(U["p_a"], ba)
        dC = U["C"] @ exp_and_left_jacobian(times(U["C_g"], bg))[0]
        g = times(half, gravity[:, None] * ([0, 0, 1] + p * [-1, -1, 2] / A))
        p = times(turned, p + v * T + times(C, dp)) + g * T * T / 2
        v = times(turned, v + times(C, dv)) + g * T
        C = turned @ C @ dC
        D, M = t_(dC), np.zeros((n, 18, 18))
        M[:, R, R] = M[:, V, V] = M[:, P, P] = M[:, F, F] = D
        M[:, V, R], M[:, P, R], M[:, P, V] = -D @ skew(dv), -D @ skew(dp), D * T
        M[:, R, G], M[:, V, G], M[:, P, G] = U["C_g"], D @ U["v_g"], D @ U["p_g"]
        M[:, V, B], M[:, P, B] = D @ U["v_a"], D @ U["p_a"]
        M[:, G, G] = M[:, B, B] = np.eye(3)
        cov = M @ cov @ t_(M) + np.diag(Q)

        z, N = times(t_(C), fixes[:, k] - p - rho), t_(C) @ noise @ C
        xi = np.zeros((n, 18))
        for i in range(iterations):  # one iteration: the invariant EKF; more: Gauss-Newton on z = J(xi_R) (xi_p + xi_rho)
            J = exp_and_left_jacobian(xi[:, R])[1]
            H = np.zeros((n, 3, 18))
            H[:, :, P] = H[:, :, F] = J
            for axis in range(3) if i else ():  # the derivative d(J u)/d xi_R, computed from differences
                moved = exp_and_left_jacobian(xi[:, R] + 1e-6 * np.eye(3)[axis])[1]
                H[:, :, axis] = times(moved - J, xi[:, P] + xi[:, F]) / 1e-6
            S = H @ cov @ t_(H) + N
            K = t_(np.linalg.solve(S, H @ cov))
            residual = z - times(J, xi[:, P] + xi[:, F])
            nis[:, k] = np.einsum("ni,ni->n", residual, np.linalg.solve(S, residual[..., None])[..., 0])
            xi = times(K, residual + times(H, xi))
        keep = np.eye(18) - K @ H
        cov = keep @ cov @ t_(keep) + K @ N @ t_(K)
        turn, J = exp_and_left_jacobian(xi[:, R])
        p, v, rho = p + times(C, times(J, xi[:, P])), v + times(C, times(J, xi[:, V])), rho + times(C, times(J, xi[:, F]))
        C, bg, ba = C @ turn, bg + xi[:, G], ba + xi[:, B]
        if reset:  # transforms the covariance to the new estimate: exp(xi)^-1 exp(xi + d) = exp(sum (-ad)^m/(m + 1)! d)
            ad, term, Jr = np.zeros((n, 18, 18)), np.eye(18), np.eye(18)
            for part in (R, V, P, F):
                ad[:, part, part], ad[:, part, R] = skew(xi[:, R]), skew(xi[:, part])
            for m in range(1, 25):
                term = term @ -ad / (m + 1)
                Jr = Jr + term
            cov = Jr @ cov @ t_(Jr)
        cov = (cov + t_(cov)) / 2
        heading = np.arctan2(C[:, 1, 0], C[:, 0, 0]) + p[:, 1] / A * np.tan(lat)  # the last term: the meridians converge
        errors[:, k] = wrapped(heading - truth_heading(k + 1.0))
        sigmas[:, k] = np.sqrt((C[:, 2:] @ cov[:, R, R] @ t_(C)[:, :, 2:])[:, 0, 0])
    return errors, sigmas, nis


def row(name, error, sigma):
    e, over = np.abs(error) / DEG, np.sqrt(np.mean(np.square(error / sigma)))
    return (f"| {name} | {np.sqrt(np.mean(e * e)):.2f} | {np.median(e):.2f} | {np.quantile(e, 0.9):.2f} "
            f"| {100 * np.mean(e < 10):.0f} % | {over:.2f} |")


def ratio(invariant_error, sin_cos_error):
    """The RMS of the invariant filter divided by that of the sin/cos filter in the same runs, with its 5 % to 95 % range (bootstrap)."""
    square, n = np.square([invariant_error, sin_cos_error]), len(sin_cos_error)
    drawn = square[:, np.random.default_rng(1).integers(0, n, (5000, n))].mean(-1)
    low, high = np.quantile(np.sqrt(drawn[0] / drawn[1]), [0.05, 0.95])
    return f"RMS {np.sqrt(square[0].sum() / square[1].sum()):.2f} [{low:.2f}-{high:.2f}] times that of sin/cos"


def cell(work, aid, start, tilt, runs, forms):
    """The table rows for one aiding sensor and one initial error: both filters at a few times, and the forms of the invariant filter at the end."""
    loaded = [dict(np.load(work / f"{aid}_{start}_{tilt}_{run}.npz")) for run in range(runs)]
    data = {name: np.stack([one[name] for one in loaded]) for name in loaded[0]}
    seconds = lambda x: x.reshape(runs, 300, SAMPLES, 3)
    data["second"] = preintegrated(seconds(data["dtheta"]), seconds(data["dv"]))
    told = 120 if start > 90 else start  # the heading sigma with which the EKF and the UKF are configured
    name, lines = f"{aid} {start} deg, tilts {tilt} deg", []
    e, s, nis = invariant(data, aid, told * DEG, tilt * DEG)
    for t in (30, 60, 120, 299):
        lines += [row(f"{name}, {t} s: sin/cos", data["error"][:, t - 1], data["sigma"][:, t - 1]),
                  row(f"{name}, {t} s: invariant", e[:, t - 1], s[:, t - 1])]
    closer = 100 * np.mean(np.abs(e[:, -1]) < np.abs(data["error"][:, -1]))
    lines.append(f"{name}: {ratio(e[:, -1], data['error'][:, -1])}, closer in {closer:.0f} % of runs; NIS {nis[:, 9:].mean():.2f}")
    variations = [("5 iterations", dict(iterations=5)), ("P reset", dict(reset=True)), ("both", dict(iterations=5, reset=True))]
    variations += [(f"told {other} deg", dict(heading_sigma=other * DEG)) for other in (60, 180)]
    for text, change in variations if forms else ():
        e, s, _ = invariant(data, aid, **({"heading_sigma": told * DEG, "tilt_sigma": tilt * DEG} | change))
        lines.append(row(f"{name}: invariant, {text}", e[:, -1], s[:, -1]))
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench")
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--forms", action="store_true", help="also the variations of the invariant filter")
    a = parser.parse_args()
    a.work.mkdir(parents=True, exist_ok=True)
    cells = [(aid, start, tilt) for aid in AIDS for start, tilt in STARTS]
    variants = [VARIANT.format(aid=aid, start=start, tilt=tilt, told=600 if start > 90 else start, SCENARIOS=SCENARIOS)
                for aid, start, tilt in cells]
    (a.work / "cells.toml").write_text('title = "cells"\nruns = 400\nseed = 20060707\n' + "".join(variants))
    with multiprocessing.Pool(a.jobs) as pool:
        pool.starmap(fly, [(a.bench, a.work, *one, run) for run in range(a.runs) for one in cells], chunksize=1)
        print(*pool.starmap(cell, [(a.work, *one, a.runs, a.forms) for one in cells], chunksize=1), sep="\n")


if __name__ == "__main__":
    main()
