#!/usr/bin/python3
"""Compares the latencies that hil-bench reports with an independent measurement: candump's stamps of the same bus.

  tests/vcan/run.sh /usr/bin/python3 tests/vcan/latency.py HIL_BENCH CANHIL.dbc SCENARIO...

Flies each scenario in real time over vcan0 while candump records the bus. Uses only this log and the DBC (read by canmatrix): it pairs the last frame
of every sample group with its answers by the time of validity, which group and answer contain. For every answer message, the nearest-rank p50 and p99
must agree with those in the report (--json) within 2 us: candump truncates its stamps to whole us, and the bench's buckets are 1 us wide. The counts
must be equal. Prints a table, and one line for each disagreement; with a disagreement, the exit code is 1.
"""

import collections
import json
import math
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import canmatrix.formats  # noqa: E402


def limit_us(t_us):
    """The largest permitted difference [us]: half the width of the bucket of the bench's histogram (bench/checks/histogram.hpp), plus 1.5 us,
    because candump truncates its stamps to whole microseconds."""
    width = 1 if t_us < 10e3 else 10 if t_us < 100e3 else 100 if t_us < 1e6 else 1000
    return width / 2 + 1.5


class Contract:
    """For each message of the DBC, by its CAN id: its sample group, the groups that it answers, and how to decode its frames."""

    def __init__(self, dbc):
        matrix = next(iter(canmatrix.formats.loadp(dbc).values()))
        self.frames = {frame.arbitration_id.id: frame for frame in matrix.frames}
        self.group = {i: self.attribute(frame, "SampleGroup") for i, frame in self.frames.items()}
        self.answers = {i: self.attribute(frame, "Answers").split() for i, frame in self.frames.items()}
        self.answered = {group for groups in self.answers.values() for group in groups}

    @staticmethod
    def attribute(frame, name):
        return str(frame.attributes.get(name, "")).strip('"')

    def value(self, identifier, data, signal_name):
        """The raw value of a signal; None: the message has no signal of that name."""
        frame = self.frames[identifier]
        if all(one.name != signal_name for one in frame.signals):
            return None
        return int(frame.decode(data)[signal_name].raw_value)


def frames_of(log):
    """(stamp [us], id, data) of every classic line "(seconds.microseconds) interface ID#DATA"."""
    for line in log.splitlines():
        stamp, _, frame = line.split()[:3]
        seconds, _, microseconds = stamp.strip("()").partition(".")
        identifier, _, data = frame.partition("#")
        yield int(seconds) * 1_000_000 + int(microseconds), int(identifier, 16), bytes.fromhex(data)


def latencies_us(log, contract):
    """{answer message: its latencies [us]}. A latency begins at the last frame of the stimulus."""
    stimulus_us = {}  # {(group, time of validity): stamp of the last frame of the group}
    group_so_far = collections.defaultdict(list)  # {group of an answer: [(message, stamp)] of the messages that have arrived}
    latencies = collections.defaultdict(list)
    for t_us, identifier, data in frames_of(log):
        if identifier not in contract.frames or not contract.group[identifier]:
            continue
        group = contract.group[identifier]
        if group in contract.answered:
            valid = contract.value(identifier, data, "time_of_validity_us")
            if valid is not None:  # only the last message of a group has this signal
                stimulus_us[group, valid] = t_us
        elif contract.answers[identifier]:
            group_so_far[group].append((contract.frames[identifier].name, t_us))
            cause = contract.value(identifier, data, "cause_time_us")
            if cause is None:
                continue
            causes = [stimulus_us[one, cause] for one in contract.answers[identifier] if (one, cause) in stimulus_us]
            for name, answer_us in group_so_far.pop(group):
                latencies[name] += [answer_us - one for one in causes]
    return latencies


def nearest_rank(sample, q):
    return sorted(sample)[math.ceil(q * len(sample)) - 1]


def listeners():
    with open("/proc/net/can/rcvlist_all", encoding="ascii") as file:
        return file.read().count(" raw")


def fly(bench, scenario, folder):
    """Flies the scenario. Returns the log of candump and the bench's report."""
    report, log = f"{folder}/report.json", f"{folder}/candump.log"
    with open(log, "wb") as out:
        candump = subprocess.Popen(["candump", "-L", "-r", "4000000", "vcan0"], stdout=out, stdin=subprocess.DEVNULL)
        deadline = time.monotonic() + 20
        while listeners() == 0 and time.monotonic() < deadline:
            time.sleep(0.01)
        time.sleep(0.1)  # the kernel begins to stamp frames a moment after candump requested stamps
        run = subprocess.run([bench, "run", scenario, "--bus", "vcan0", "--json", report],
                             capture_output=True, text=True, timeout=200, stdin=subprocess.DEVNULL)
        candump.send_signal(signal.SIGINT)
        candump.wait(20)
    if run.returncode not in (0, 1, 3):  # any verdict (0, 1, 3) is accepted
        sys.exit(f"{scenario}: hil-bench ended with {run.returncode}: {run.stderr}")
    with open(log, encoding="ascii") as file, open(report, encoding="utf-8") as page:
        return file.read(), json.load(page)


def disagreements(scenario, measured, reported, closing):
    """Prints both measurements; returns one line for each difference."""
    wrong = []
    if set(measured) != set(reported):
        wrong.append(f"answering messages {sorted(measured)}, in the report {sorted(reported)}")
    if not closing or not closing <= set(measured):
        wrong.append(f"messages that close an answer: {sorted(closing)}, measured: {sorted(measured)}")
    print(f"{scenario}\n  {'latency [us]':<24}{'count':>7}{'p50':>10}{'report':>10}{'p99':>10}{'report':>10}")
    for name in sorted(set(measured) & set(reported)):
        sample, theirs = measured[name], reported[name]
        if len(sample) != theirs["count"]:
            wrong.append(f"{name}: {len(sample)} answers, in the report {theirs['count']}")
        row = f"  {name:<24}{len(sample):>7}"
        for key, q in (("p50", 0.5), ("p99", 0.99)):
            mine, other = nearest_rank(sample, q), theirs[key] * 1e6
            row += f"{mine:>10}{other:>10.1f}"
            if abs(mine - other) > limit_us(mine):
                wrong.append(f"{name}: {key} {mine} us, in the report {other:.1f} us, expected within {limit_us(mine):g} us")
        print(row)
    return [f"{scenario}: {line}" for line in wrong]


def main(bench, dbc, *scenarios):
    contract = Contract(dbc)
    wrong = []
    for scenario in scenarios:
        with tempfile.TemporaryDirectory() as folder:
            log, report = fly(bench, scenario, folder)
        closing = {name for name, latency in report["latency_s"].items() if latency["closes_group"]}
        wrong += disagreements(scenario, latencies_us(log, contract), report["latency_s"], closing)
    print("\n".join(wrong) or "all within the resolution of the report")
    return 1 if wrong or not scenarios else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
