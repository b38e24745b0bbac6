"""A week's work: how noise and faults of a seeker change the error of three algorithms. Draws week.svg."""

from concurrent.futures import ThreadPoolExecutor
from itertools import product

import canhil
from matplotlib import pyplot

SCENARIO = "bench/flights/los_quick.toml"
ALGORITHMS = ["combined", "switched_table", "low_pass"]
NOISES_MRAD = [0.25 * step for step in range(1, 21)]
WINDOW = {"quantity": "seeker.error_pitch", "from_s": 2.5, "to_s": 2.7}
FAULTS = {
    "bias": WINDOW | {"kind": "bias", "by_mrad": 4},
    "stuck": WINDOW | {"kind": "stuck"},
    "silent": {"kind": "silent", "node": "seeker", "from_s": 2.5, "to_s": 2.7},
}


def fly(algorithm, noise_mrad=0.0, faults=()):
    settings = {"target.algorithm": algorithm, "seeker.constant_noise_mrad": noise_mrad}
    return canhil.run(SCENARIO, bus="in-process", set=settings, faults=faults)


with ThreadPoolExecutor() as pool:
    runs = dict(zip(product(ALGORITHMS, NOISES_MRAD), pool.map(lambda one: fly(*one), product(ALGORITHMS, NOISES_MRAD))))
figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
for algorithm in ALGORITHMS:
    errors = [runs[algorithm, noise].judgement("error los.rate rms 3 to 2 s to go").value for noise in NOISES_MRAD]
    assert errors == sorted(errors), "more noise makes a larger error"
    left.plot(NOISES_MRAD, errors, label=algorithm)
for name, fault in FAULTS.items():
    run = fly("combined", faults=[fault | {"name": name}])
    series = run.series("los.rate.pitch")
    print(f"{name}: {run.verdict}, {max(map(abs, series.error[400:800])):.4f} rad/s at most, fails {len(run.failures)} checks")
    right.plot(series.t_s, [1e3 * error for error in series.error], label=name)
left.set(xlabel="noise [mrad]", ylabel="RMS error of the LOS rate [mrad/s]")
right.set(xlabel="time [s]", ylabel="pitch error of 'combined' [mrad/s]", xlim=(2, 4), ylim=(-15, 20))
[axes.legend() for axes in (left, right)]
figure.savefig("week.svg")
