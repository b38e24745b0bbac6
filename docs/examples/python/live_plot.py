"""Draws the target's LOS rate and the true one while the run goes on. Without a display: live_plot.py --save live.png."""

import sys

import canhil
from matplotlib import pyplot

TRUTH, MESSAGE, SIGNAL = "los.rate.pitch", "LosRateEstimate", "los_rate_pitch_radps"

figure, axes = pyplot.subplots(layout="constrained")
axes.set(xlabel="time [s]", ylabel="LOS rate, pitch [rad/s]", xlim=(0, 6), ylim=(-0.05, 0.05))
lines = [axes.plot([], [], label=label)[0] for label in ("truth", "target")]
axes.legend()
points = [([], []), ([], [])]
shown = 0.0
with canhil.live("bench/flights/los_quick.toml", truth=[TRUTH], hears=[MESSAGE]) as flight:  # in real time
    for now in flight:
        new = [[(now.t, now.truth[TRUTH])], [(heard.t, heard.values[SIGNAL]) for heard in now.heard]]
        for line, (times, values), more in zip(lines, points, new):
            times += [t for t, _ in more]
            values += [value for _, value in more]
            line.set_data(times, values)
        if now.t - shown > 0.2 and "--save" not in sys.argv:
            shown = now.t
            pyplot.pause(0.001)
print(f"{len(points[1][0])} estimates; {flight.run.reason}")
if "--save" in sys.argv:
    figure.savefig(sys.argv[-1])
else:
    pyplot.show()
