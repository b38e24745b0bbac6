#!/usr/bin/python3
"""Measures how late hil-bench transmits, and compares it with cyclictest of the same priority on the same CPU and with other senders.

  jitter.py HIL_BENCH [ROUNDS]                                              over the embedded bus, with cyclictest alone
  tests/vcan/run.sh /usr/bin/python3 jitter.py HIL_BENCH [ROUNDS] vcan0     over a CAN interface, with all of them

Lateness of hil-bench run --realtime (a scenario of 200 Hz): the time from each deadline until the first frame of this deadline is written to the bus.
Lateness of cyclictest: the time from the end of its sleep until it wakes up.
Time between frames: how much the time between two of the kernel's receive stamps deviates from 5 ms. candump logs these stamps for all senders. The
senders are hil-bench, `cangen -g`, `canplayer` with a log of the same frames at the times of their deadlines, and the kernel's broadcast manager (BCM,
TX_SETUP).
The senders take turns, one at a time, with the same priority, on the last CPU of this process. The target and candump run on other CPUs.
Prints figures and ratios without a verdict; fails if a program did not run.
"""

import collections
import json
import math
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time

PERIOD_US = 5000
SAMPLES = 1100  # the number of cycles; about as many as the scenario has deadlines
PRIORITY = 40
FIRST = 0x70  # SeekerAntenna, the first frame of every deadline
OF_BENCH = {0x70, 0x71, 0x72, 0x73, 0xA0}  # the seeker's frames and Sync
SCENARIO = pathlib.Path(__file__).parents[3] / "bench/flights/los_quick.toml"
SPINS_US = (0, 100)

CPUS = sorted(os.sched_getaffinity(0))
REAL_TIME = ["taskset", "-c", str(CPUS[-1]), "chrt", "-f", str(PRIORITY)]


def run(command, codes=(0,)):
    ended = subprocess.run(command, capture_output=True, text=True, timeout=120, stdin=subprocess.DEVNULL)
    if ended.returncode not in codes:
        sys.exit(f"{' '.join(command)}: ended with {ended.returncode}: {ended.stderr.strip()}")


def quantile(counts, q):
    """The q-quantile (nearest rank) of the values that a Counter counts."""
    rank, seen = math.ceil(q * counts.total()), 0
    for value in sorted(counts):
        seen += counts[value]
        if seen >= rank:
            return value
    raise ValueError("empty")


class Table:
    def __init__(self):
        self.rows = collections.defaultdict(collections.Counter)

    def print(self, title, reference, over):
        print(f"{title:<36}{'samples':>8}{'p50':>9}{'p99':>9}{'max':>10}   {over} p50, p99")
        of = self.rows[reference]
        for name, counts in self.rows.items():
            p50, p99 = quantile(counts, 0.5), quantile(counts, 0.99)
            ratios = f"{p50 / quantile(of, 0.5):>12.3f}{p99 / quantile(of, 0.99):>8.3f}" if name != reference else ""
            print(f"  {name:<34}{counts.total():>8}{p50:>9.1f}{p99:>9.1f}{max(counts):>10.1f}   {ratios}")


def bench_name(spin_us):
    return f"hil-bench --spin-us {spin_us}" if spin_us else "hil-bench"


class Observer:
    """Runs candump on an interface while a sender sends."""

    def __init__(self, interface, folder):
        self.interface, self.log = interface, f"{folder}/candump.log"

    def __enter__(self):
        self.out = open(self.log, "wb")
        self.candump = subprocess.Popen(["candump", "-L", "-r", "4000000", self.interface], stdout=self.out)
        time.sleep(0.5)

    def __exit__(self, *_):
        self.candump.send_signal(signal.SIGINT)
        self.candump.wait(20)
        self.out.close()

    def frames(self):
        """(stamp [us], id, text of the frame) of each frame in the log of candump"""
        for line in open(self.log, encoding="ascii"):
            stamp, _, frame = line.split()[:3]
            seconds, _, microseconds = stamp.strip("()").partition(".")
            yield int(seconds) * 1_000_000 + int(microseconds), int(frame.partition("#")[0], 16), frame

    def deviations(self):
        stamps = [t for t, identifier, _ in self.frames() if identifier == FIRST]
        if len(stamps) < SAMPLES / 2:
            sys.exit(f"{self.interface}: {len(stamps)} frames seen, expected about {SAMPLES}")
        return collections.Counter(abs(later - earlier - PERIOD_US) for earlier, later in zip(stamps, stamps[1:]))

    def write_schedule(self, path):
        """Writes a log for canplayer: the bench's frames, each at the time of its deadline."""
        frames = [(t, frame) for t, identifier, frame in self.frames() if identifier in OF_BENCH]
        start = next(t for t, identifier, _ in self.frames() if identifier == FIRST)
        with open(path, "w", encoding="ascii") as file:
            for t, frame in frames:
                due = start + round((t - start) / PERIOD_US) * PERIOD_US
                file.write(f"({due // 1_000_000}.{due % 1_000_000:06}) {self.interface} {frame}\n")


def fly(bench, bus, spin_us, report, lateness):
    run([bench, "run", str(SCENARIO), "--bus", bus, "--json", report, "--realtime", "--priority", str(PRIORITY),
         "--cpu", str(CPUS[-1]), "--target-cpu", str(CPUS[0]), "--spin-us", str(spin_us)], codes=(0, 1, 3))
    page = json.loads(pathlib.Path(report).read_text(encoding="utf-8"))
    if not page["ending"]["completed"]:
        sys.exit(f"{bus}: the run ended: {page['ending']['detail']}")
    first = page["transmit_lateness_s"]["SeekerAntenna"]["handed_over"]
    for from_us, count in first["buckets_us"]:
        lateness.rows[bench_name(spin_us)][from_us + 0.5] += count  # the middle of the bucket, which is 1 us wide


def cyclictest(folder, lateness):
    report = f"{folder}/cyclictest.json"
    run(["cyclictest", "-q", "-m", "-N", "-t", "1", "-a", str(CPUS[-1]), "-p", str(PRIORITY), "-i", str(PERIOD_US),
         "-l", str(SAMPLES), "-h", "1000000", f"--json={report}"])
    thread = json.loads(pathlib.Path(report).read_text(encoding="utf-8"))["thread"]["0"]
    for ns, count in thread["histogram"].items():
        lateness.rows["cyclictest"][int(ns) / 1000] += count
    beyond = thread["cycles"] - sum(thread["histogram"].values())
    if beyond > 0:  # the histogram ends at 1 ms
        lateness.rows["cyclictest"][thread["max"] / 1000] += beyond


def broadcast_manager(interface):
    tx_setup, set_and_start_timer = 1, 3
    frame = struct.pack("=IB3x8s", FIRST, 8, bytes(8))
    head = struct.pack("@3I4l2I0q", tx_setup, set_and_start_timer, 0, 0, 0, 0, PERIOD_US, FIRST, 1)
    with socket.socket(socket.AF_CAN, socket.SOCK_DGRAM, socket.CAN_BCM) as manager:
        manager.connect((interface,))
        manager.send(head + frame)
        time.sleep(SAMPLES * PERIOD_US * 1e-6)


def main():
    bench, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    interface = sys.argv[3] if len(sys.argv) > 3 else None
    lateness, between = Table(), Table()
    with tempfile.TemporaryDirectory() as folder:
        observer = Observer(interface, folder)
        report, schedule = f"{folder}/report.json", f"{folder}/schedule.log"

        def observed(name, send):
            with observer:
                send()
            between.rows[name] += observer.deviations()

        for _ in range(rounds):
            cyclictest(folder, lateness)
            for spin_us in SPINS_US:
                if interface is None:
                    fly(bench, "local:", spin_us, report, lateness)
                else:
                    observed(bench_name(spin_us), lambda spin_us=spin_us: fly(bench, interface, spin_us, report, lateness))
            if interface is None:
                continue
            observer.write_schedule(schedule)
            observed("SocketCAN BCM", lambda: broadcast_manager(interface))
            observed("cangen -g 5", lambda: run(REAL_TIME + ["cangen", interface, "-g", "5", "-I", "070", "-L", "8",
                                                             "-n", str(SAMPLES)]))
            observed("canplayer", lambda: run(REAL_TIME + ["canplayer", "-I", schedule]))
    where = f"CPU {CPUS[-1]}, the target on CPU {CPUS[0]}, SCHED_FIFO {PRIORITY}, {rounds} turns"
    print(f"over {interface or 'the embedded bus'}; {where}; load {os.getloadavg()[0]:.1f}")
    lateness.print("transmit lateness [us]", "cyclictest", "over cyclictest's:")
    if interface is not None:
        between.print("time between frames, off 5 ms [us]", bench_name(SPINS_US[-1]), f"over {bench_name(SPINS_US[-1])}:")


if __name__ == "__main__":
    main()
