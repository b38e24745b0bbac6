#!/usr/bin/python3
"""Compares how late hil-bench transmits with and without an open page of the live view.

  live.py HIL_BENCH [ROUNDS [SCENARIO]]

Runs with and without a client of the page take turns, in real time and, if permitted, with real-time
priority. The lateness of a frame is the time from its deadline until the bench writes it to the bus. Prints
p99 and maximum of both sides, their ratios, the number of frames, and the number of frames that the view
missed. There is no verdict; fails if a program did not run.
"""

import collections
import json
import math
import pathlib
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
    def __init__(self):
        self.counts, self.max_us = collections.Counter(), 0.0
        self.frames = self.missed = self.messages = 0

    def add(self, report):
        lateness = json.loads(report.read_text())["bench_lateness_s"]
        self.counts.update(dict(lateness["buckets_us"]))
        self.max_us = max(self.max_us, 1e6 * lateness["max"])

    @property
    def p99_us(self):
        return quantile(self.counts, 0.99)


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
    for _ in range(rounds):
        fly(program, scenario, real_time, without, False)
        fly(program, scenario, real_time, with_page, True)
    print(f"lateness of every frame [us], {scenario.name}, {rounds} runs a side, {'real-time priority' if permitted else 'usual priority'}")
    print(f"{'':<20}{'frames':>9}{'p99':>9}{'max':>10}")
    for name, side in (("without the view", without), ("page open", with_page)):
        print(f"  {name:<18}{side.counts.total():>9}{side.p99_us:>9.1f}{side.max_us:>10.1f}")
    print(f"  {'ratio':<18}{'':>9}{(with_page.p99_us + 1) / (without.p99_us + 1):>9.3f}{with_page.max_us / without.max_us:>10.3f}"
          "   (of p99 + 1 us: its buckets are of 1 us)")
    print(f"  the view saw {with_page.frames} frames, missed {with_page.missed}; the page had {with_page.messages} messages")


if __name__ == "__main__":
    main()
