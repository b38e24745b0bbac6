#!/usr/bin/python3
"""Compares how late hil-bench transmits with and without an open page of the live view.

  live.py HIL_BENCH [ROUNDS [SCENARIO]]

A round is one run with a client of the page and one without, in real time and, if permitted, with real-time
priority; the order changes from round to round. The lateness of a frame is the time from its deadline until
the bench writes it to the bus.

In all runs, if the scheduler permits its lowest priority, a loop with this priority keeps each CPU out of its
idle states. Without these loops, p99 would mainly be the time in which an idle CPU wakes up. This time is long
in a virtual machine, because the hypervisor must first schedule the CPU. (cyclictest prevents idle states with
/dev/cpu_dma_latency, which has no effect in a virtual machine.) If other guests of the hypervisor took more than
0.25 % of the CPUs' time during a round, the round is left out and another one is flown: p99 depends on the latest
1 % of the frames, and in such a round the other guests would have delayed these frames.

Prints quantiles and maximum with and without the page, their ratios, the 95 % range of the ratios of the
quantiles (bootstrap over the rounds), the number of frames, and the number of frames that the view missed. There
is no verdict. Exit code 3: two thirds of the rounds were left out.
"""

import collections
import contextlib
import dataclasses
import json
import math
import os
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
MOST_STOLEN = 0.0025  # share of the CPUs' time that the hypervisor gave to other guests
QUANTILES = (0.5, 0.99)


@dataclasses.dataclass
class Run:
    counts: collections.Counter = None  # number of frames per microsecond of lateness
    max_us: float = 0.0
    frames: int = 0  # frames that the live view received
    missed: int = 0  # frames that the live view missed
    messages: int = 0  # messages that the page received

    def read(self, report):
        lateness = json.loads(report.read_text())["bench_lateness_s"]
        self.counts, self.max_us = collections.Counter(dict(lateness["buckets_us"])), 1e6 * lateness["max"]


def quantile_us(runs, q):
    """The q-quantile (nearest rank) of the lateness [us] of the frames of all runs."""
    counts = sum((run.counts for run in runs), collections.Counter())
    rank, seen = math.ceil(q * counts.total()), 0
    for value in sorted(counts):
        seen += counts[value]
        if seen >= rank:
            return value
    raise ValueError("empty")


def ratio(rounds, q):
    """The q-quantile with the page divided by the q-quantile without it. 1 us is added to each, because the buckets are 1 us wide."""
    without, with_page = zip(*rounds)
    return (quantile_us(with_page, q) + 1) / (quantile_us(without, q) + 1)


def ratio_range(rounds, q, samples=500):
    """The 95 % range of the ratio by bootstrap: rounds are drawn with replacement (Efron, Tibshirani 1993)."""
    draw = random.Random(1)
    ratios = sorted(ratio(draw.choices(rounds, k=len(rounds)), q) for _ in range(samples))
    return ratios[round(0.025 * (samples - 1))], ratios[round(0.975 * (samples - 1))]


def look_on(port, run):
    """Receives the messages of the live view until its end, as a page does."""
    view = WebSocket(port)
    while (message := view.message()) is not None:
        run.messages += 1
        last = message
    run.frames, run.missed = last["frames"], last["dropped"]


def fly(program, scenario, real_time, open_page):
    words, run = ["run", scenario, *real_time, "--json", "run.json"], Run()
    if open_page:
        with Bench(program, *words, hurried=False) as bench:
            looker = threading.Thread(target=look_on, args=(bench.port, run))
            looker.start()
            code, _ = bench.end()
            looker.join()
            if code == 2:
                sys.exit("live.py: a run with the page open did not take place")
            if run.frames == 0:
                sys.exit("live.py: the page received no frame of a run")
            run.read(pathlib.Path(bench.folder.name, "run.json"))
        return run
    with tempfile.TemporaryDirectory() as folder:
        ended = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=300, cwd=folder, stdin=subprocess.DEVNULL)
        if ended.returncode == 2:
            sys.exit(f"live.py: {ended.stderr.strip()}")
        run.read(pathlib.Path(folder, "run.json"))
    return run


def permitted(*chrt):
    return subprocess.run(["chrt", *chrt, "true"], capture_output=True).returncode == 0


@contextlib.contextmanager
def awake():
    """Keeps all CPUs out of their idle states. Yields the number of these CPUs, or 0 if this is not permitted."""
    cpus = os.sched_getaffinity(0) if permitted("--idle", "0") else ()
    loops = [subprocess.Popen(["chrt", "--idle", "0", "taskset", "-c", str(cpu), "sh", "-c", "while :; do :; done"]) for cpu in cpus]
    try:
        yield len(loops)
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()


def cpu_ticks():
    """(all ticks of all CPUs, ticks that the hypervisor gave to others) since the machine's start."""
    ticks = [int(word) for word in pathlib.Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
    return sum(ticks), ticks[7]


def fly_rounds(number, fly_one):
    """Flies `number` rounds. Returns the rounds, each as a pair (run without the page, run with the page), and the number of rounds that were left out."""
    rounds, left_out = [], 0
    while len(rounds) < number:
        if left_out > 2 * number:
            print(f"live.py: not measured: the hypervisor disturbed {left_out} of {left_out + len(rounds)} rounds", file=sys.stderr)
            sys.exit(3)
        all_before, stolen_before = cpu_ticks()
        order = (False, True) if (len(rounds) + left_out) % 2 == 0 else (True, False)
        runs = {open_page: fly_one(open_page) for open_page in order}
        all_after, stolen_after = cpu_ticks()
        if stolen_after - stolen_before <= MOST_STOLEN * (all_after - all_before):
            rounds.append((runs[False], runs[True]))
        else:
            left_out += 1
        if sys.stderr.isatty():
            print(f"\rlive: {len(rounds)} / {number} rounds, {left_out} left out", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print(file=sys.stderr)
    return rounds, left_out


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    number = int(sys.argv[2]) if len(sys.argv) > 2 else 5
    scenario = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else USUAL
    real_time = ["--realtime"] if permitted("-f", "40") else []
    with awake() as cpus:
        rounds, left_out = fly_rounds(number, lambda open_page: fly(program, scenario, real_time, open_page))
    print(f"lateness of every frame [us], {scenario.name}, {number} rounds, {'real-time priority' if real_time else 'usual priority'}")
    print("  " + (f"{cpus} CPUs kept from their idle states" if cpus else "CPUs use their idle states: no permission for chrt --idle"))
    print(f"{'':<20}{'frames':>9}{'p50':>14}{'p99':>14}{'max':>9}")
    sides = list(zip(*rounds))
    worst = [max(run.max_us for run in side) for side in sides]
    for name, side, max_us in zip(("without the view", "page open"), sides, worst):
        p50, p99 = (quantile_us(side, q) for q in QUANTILES)
        print(f"  {name:<18}{sum(run.counts.total() for run in side):>9}{p50:>14}{p99:>14}{max_us:>9.0f}")
    p50, p99 = (f"{ratio(rounds, q):.2f}" for q in QUANTILES)
    print(f"  {'ratio':<27}{p50:>14}{p99:>14}{worst[1] / worst[0]:>9.2f}")
    p50, p99 = ("{:.2f} to {:.2f}".format(*ratio_range(rounds, q)) for q in QUANTILES)
    print(f"  {'its 95 % range':<27}{p50:>14}{p99:>14}")
    print(f"  rounds left out because the hypervisor took more than {100 * MOST_STOLEN:g} % of the CPUs' time: {left_out}")
    seen, missed, messages = (sum(getattr(run, one) for run in sides[1]) for one in ("frames", "missed", "messages"))
    print(f"  the view saw {seen} frames, missed {missed}; the page had {messages} messages")


if __name__ == "__main__":
    main()
