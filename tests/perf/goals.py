"""Prints the goals of performance beside what tests/perf/run.sh has recorded: goals.py FOLDER_OF_RECORDS

A goal is a ratio to a reference of the same run, a count of instructions, or a time on an idle machine. Exit code 1 if a figure is missing: not measured.
"""

import json
import pathlib
import re
import sys
from typing import NamedTuple

sys.path.insert(0, str(pathlib.Path(__file__).parent / "run"))
import stages  # noqa: E402


class Records:
    """The files of one run. Each reader returns a number; None: the record does not have it."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def _text(self, name):
        path = self.folder / name
        return path.read_text(encoding="utf-8") if path.exists() else ""

    def line(self, name, pattern):
        """The number in the first group of a regular expression; lines are matched alone."""
        found = re.search(pattern, self._text(name), re.MULTILINE)
        return float(found[1]) if found else None

    def nanoseconds(self, benchmark):
        """The shortest time of a benchmark of the codec: other load only adds to it."""
        text = self._text("codec_benchmark.json")
        runs = json.loads(text)["benchmarks"] if text else []
        times = [one["real_time"] for one in runs if one["name"].split("/repeats")[0] == benchmark and one.get("run_type") != "aggregate"]
        return min(times, default=None)

    def turnaround(self, name, estimator, message, quantile):
        """A ratio to the echo, at p50 (0) or p99 (1)."""
        return self.line(name, rf"^{re.escape(estimator)} +{message} .*\|" + quantile * r" +[\d.]+" + r" +([\d.]+)[^|]*$")


class Goal(NamedTuple):
    """`most`: the largest value that meets the goal, or the least if `at_least`."""

    what: str
    most: float
    seen: float | None
    unit: str = ""
    at_least: bool = False

    @property
    def outcome(self):
        if self.seen is None:
            return stages.NOT_MEASURED
        return "met" if (self.seen >= self.most if self.at_least else self.seen <= self.most) else "NOT met"


def of_turnaround(records):
    limits = (("LOS rate", "LosRateTarget", 1.3, 1.5), ("in-flight UKF", "FixUpdate", 1.25, 1.4), ("in-flight EKF", "FixUpdate", 1.25, 1.4),
              ("wind EKF", "WindUpdate", 1.2, 1.3), ("wind H-infinity", "WindUpdate", 1.2, 1.3))
    for estimator, message, p50, p99 in limits:
        for quantile, (name, most) in enumerate((("p50", p50), ("p99", p99))):
            yield Goal(f"turnaround of {estimator}, {name} over the echo's", most, records.turnaround("turnaround.txt", estimator, message, quantile))


def goals(folder):
    records = Records(folder)
    codec_share, sensor_share = (goal for _, _, goal in stages.GOALS)

    def lateness(name):
        return records.line(name, r"^  hil-bench +\d+ +[\d.]+ +[\d.]+ +[\d.]+ +[\d.]+ +([\d.]+)$")

    return [
        Goal("flight of 20 s", 17, records.line("run_stages.txt", r"Kalman filter: ([\d.]+) million"), "million instructions"),
        Goal("pack, wire, E2E and unpack in it", codec_share, records.line("run_stages.txt", r"^  pack \+ wire \+ E2E \+ unpack +([\d.]+) %"), "%"),
        Goal("sensors and truth in it", sensor_share, records.line("run_stages.txt", r"^  sensor and truth +([\d.]+) %  \("), "%"),
        Goal("generated codec, unpack of four signals", 30, records.line("codec_instructions.txt", r" unpack of FourSignals: (\d+)"), "instructions"),
        Goal("generated codec, pack of four signals", 60, records.line("codec_instructions.txt", r" pack of FourSignals: (\d+)"), "instructions"),
        Goal("run-time codec, decode of four signals", 15, records.nanoseconds("decode_by_plan/FourSignals"), "ns"),
        Goal("run-time codec, encode of four signals", 35, records.nanoseconds("encode_by_plan/FourSignals"), "ns"),
        Goal("step of the recommended wind filter", 60000, records.line("estimators_instructions.txt", r"^step_recommended +(\d+)"), "instructions"),
        *of_turnaround(records),
        Goal("lateness p99 over cyclictest's, embedded bus", 1.2, lateness("jitter.txt")),
        Goal("lateness p99 over cyclictest's, vcan", 1.2, lateness("jitter_vcan.txt")),
        Goal("campaign: two threads over one", 1.9, records.line("run_threads.txt", r"two threads : one thread +([\d.]+)"), at_least=True),
    ]


def main():
    found = goals(sys.argv[1])
    width = max(len(one.what) for one in found)
    print(f"{'goal':<{width}} {'':>9} {'seen':>9}")
    for one in found:
        seen = "-" if one.seen is None else f"{one.seen:g}"
        print(f"{one.what:<{width}} {'>=' if one.at_least else '<='} {one.most:>6g} {seen:>9} {one.unit:<21} {one.outcome}".rstrip())
    missing = sum(one.seen is None for one in found)
    print(f"{sum(one.outcome == 'met' for one in found)} of {len(found)} met, {missing} not measured")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
