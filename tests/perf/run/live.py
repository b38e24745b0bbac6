#!/usr/bin/python3
"""Compares how late hil-bench transmits with and without an open page of the live view.

  live.py HIL_BENCH [ROUNDS [SCENARIO]]

A round is one run with a client of the page and one without, in real time and, if permitted, with real-time
priority; the order changes from round to round. The lateness of a frame is the time from its deadline until
the bench writes it to the bus. Prints quantiles and maximum of both sides, their ratios, the 95 % range of
the ratios of the quantiles (bootstrap over the rounds), the number of frames, and the number of frames that
the view missed. There is no verdict; fails if a program did not run.
"""

import collections
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import threading

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests/processes/live"))
from client import Bench, WebSocket  # noqa: E402

USUAL = ROOT / "bench/flights/los_quick.toml"


def quantile(counts, q):
    """Nearest rank of a Counter."""
    rank, seen = math.ceil(q * counts.total()), 0
    for value in sorted(counts):
        seen += counts[value]
        if seen >= rank:
            return value
    raise ValueError("empty")


class Side:
    """The runs of one side, each with the number of frames per microsecond of lateness."""

    def __init__(self):
        self.runs, self.max_us = [], 0.0
        self.frames = self.missed = self.messages = 0

    def add(self, report):
        lateness = json.loads(report.read_text())["bench_lateness_s"]
        self.runs.append(collections.Counter(dict(lateness["buckets_us"])))
        self.max_us = max(self.max_us, 1e6 * lateness["max"])

    def quantile_us(self, q, rounds):
        return quantile(sum((self.runs[i] for i in rounds), collections.Counter()), q)


def ratio(above, below, q, rounds):
    """Of two quantiles; 1 us is added to both, because the buckets are of 1 us."""
    return (above.quantile_us(q, rounds) + 1) / (below.quantile_us(q, rounds) + 1)


def ratio_range(above, below, q, samples=500):
    """95 % range of the ratio: rounds are drawn with replacement (Efron, Tibshirani 1993)."""
    draw = random.Random(1)
    every = range(len(above.runs))
    ratios = sorted(ratio(above, below, q, draw.choices(every, k=len(every))) for _ in range(samples))
    return ratios[round(0.025 * (samples - 1))], ratios[round(0.975 * (samples - 1))]


def look_on(bench, side):
    """Reads the live view to the end, as a page does."""
    view = WebSocket(bench.port)
    while (message := view.message()) is not None:
        side.messages += 1
        last = message
    side.frames += last["frames"]
    side.missed += last["dropped"]


def fly(program, scenario, real_time, side, open_page):
    words = ["run", scenario, *real_time, "--json", "run.json"]
    if open_page:
        with Bench(program, *words, hurried=False) as bench:
            looker = threading.Thread(target=look_on, args=(bench, side))
            looker.start()
            code, _ = bench.end()
            looker.join()
            if code == 2:
                sys.exit("live.py: a run with the page open did not take place")
            side.add(pathlib.Path(bench.folder.name, "run.json"))
        return
    with tempfile.TemporaryDirectory() as folder:
        ended = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=300, cwd=folder, stdin=subprocess.DEVNULL)
        if ended.returncode == 2:
            sys.exit(f"live.py: {ended.stderr.strip()}")
        side.add(pathlib.Path(folder, "run.json"))


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    scenario = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else USUAL
    permitted = subprocess.run(["chrt", "-f", "40", "true"], capture_output=True).returncode == 0
    real_time = ["--realtime"] if permitted else []
    without, with_page = Side(), Side()
    for i in range(rounds):
        for open_page in (False, True) if i % 2 == 0 else (True, False):
            fly(program, scenario, real_time, with_page if open_page else without, open_page)
    print(f"lateness of every frame [us], {scenario.name}, {rounds} rounds, {'real-time priority' if permitted else 'usual priority'}")
    print(f"{'':<20}{'frames':>9}{'p50':>16}{'p99':>16}{'max':>9}")
    every = range(rounds)
    for name, side in (("without the view", without), ("page open", with_page)):
        p50, p99 = (side.quantile_us(q, every) for q in (0.5, 0.99))
        print(f"  {name:<18}{sum(run.total() for run in side.runs):>9}{p50:>16.0f}{p99:>16.0f}{side.max_us:>9.0f}")
    words = [f"{ratio(with_page, without, q, every):.2f}" for q in (0.5, 0.99)]
    ranges = ["{:.2f}..{:.2f}".format(*ratio_range(with_page, without, q)) for q in (0.5, 0.99)]
    print(f"  {'ratio':<27}{words[0]:>16}{words[1]:>16}{with_page.max_us / without.max_us:>9.2f}")
    print(f"  {'its 95 % range':<27}{ranges[0]:>16}{ranges[1]:>16}")
    print(f"  the view saw {with_page.frames} frames, missed {with_page.missed}; the page had {with_page.messages} messages")


if __name__ == "__main__":
    main()
