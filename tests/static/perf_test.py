"""Runs the scripts of tests/perf that count instructions, with a false valgrind: a script that counted nothing must say so and fail."""

import os
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PERF = Path(__file__).resolve().parents[1] / "perf"
VALGRIND = """#!/bin/sh
for word; do case $word in --callgrind-out-file=*) out=${word#*=};; esac; done
cat "$COUNTED" > "$out"
"""


def counted(file):
    """Callgrind's output for 1000 instructions in one function of a file."""
    return f"fl=(1) {file}\nfn=(1) one_run\n1 1000\nsummary: 1000\n"


class FalseValgrind(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        valgrind = Path(self.folder.name, "valgrind")
        valgrind.write_text(VALGRIND)
        valgrind.chmod(valgrind.stat().st_mode | stat.S_IXUSR)

    def run_with(self, output, *command):
        file = Path(self.folder.name, "counted")
        file.write_text(output)
        environment = dict(os.environ, COUNTED=str(file), PATH=f"{self.folder.name}:{os.environ['PATH']}")
        return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=30)

    def stages(self, output):
        return self.run_with(output, sys.executable, PERF / "run/stages.py", self.folder.name)

    def test_stages_that_are_unknown_meet_no_goal(self):
        unknown = self.stages(counted("???"))
        self.assertEqual(unknown.returncode, 1, unknown.stdout)
        self.assertIn("unknown                      100.0 %", unknown.stdout)
        self.assertNotIn("met)", unknown.stdout)
        self.assertIn("belong to no stage", unknown.stderr)

    def test_stages_that_are_known_are_judged(self):
        loop = self.stages(counted("/x/bench/drive/lockstep.cpp"))
        self.assertEqual(loop.returncode, 0, loop.stderr)
        self.assertIn("0.0 %  (goal: below 10 %: met)", loop.stdout)
        sensor = self.stages(counted("/x/bench/world/imu.cpp"))
        self.assertEqual(sensor.returncode, 0, sensor.stderr)
        self.assertIn("100.0 %  (goal: below 25 %: not met)", sensor.stdout)

    def test_a_count_of_nothing_fails(self):
        scripts = (("codec", "codec_instructions"), ("estimators", self.folder.name))
        for folder, argument in scripts:
            script = ("sh", PERF / folder / "count_instructions.sh", argument)
            for nothing in ("summary: 0\n", ""):
                ended = self.run_with(nothing, *script)
                self.assertEqual(ended.returncode, 1, f"{folder}: {ended.stdout}{ended.stderr}")
                self.assertIn("callgrind counted nothing in", ended.stderr)
                self.assertEqual(ended.stdout, "")
            self.assertEqual(self.run_with("summary: 20000\n", *script).returncode, 0, folder)


TURNAROUND = """LOS rate               LosRateTarget    18629 |     9.2    17.4    125.0  0 |     8.0    15.3    110.0  0 |  1.14  1.14  1.13
in-flight UKF          FixUpdate          594 |    23.3    47.1     80.0  0 |    18.0    23.6     50.0  0 |  1.30  1.99  1.60
"""
JITTER = """transmit lateness [us]               samples      p50      p99       max   over cyclictest's: p50, p99
  cyclictest                            5500     45.0     78.4    1527.0
  hil-bench                             5560     61.5    101.5     972.0          1.367   1.295
  hil-bench --spin-us 100               5560      6.5     47.5    2434.0          0.144   0.606
"""
STAGES = """the paper's flight, Kalman filter: 26.70 million instructions a run
  sensor and truth               28.0 %
  pack + wire + E2E + unpack     9.1 %  (goal: below 10 %: met)
  sensor and truth               28.0 %  (goal: below 25 %: not met)
"""
CODEC = """{"benchmarks": [{"name": "decode_by_plan/FourSignals", "run_type": "iteration", "real_time": 29.5},
{"name": "decode_by_plan/FourSignals", "run_type": "iteration", "real_time": 28.5}]}"""


class Goals(unittest.TestCase):
    def printed(self, records):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in records.items():
                Path(folder, name).write_text(text)
            return subprocess.run((sys.executable, PERF / "goals.py", folder), capture_output=True, text=True, timeout=30)

    def test_each_figure_is_read_from_its_record(self):
        shown = self.printed({"turnaround.txt": TURNAROUND, "jitter.txt": JITTER, "run_stages.txt": STAGES, "codec_benchmark.json": CODEC})
        self.assertEqual(shown.returncode, 1, "some are missing")
        for line in ("flight of 20 s +<= +17 +26.7 million instructions +NOT met", "pack, wire.* 9.1 % +met", "sensors.* 28 % +NOT met",
                     "turnaround of LOS rate, p50 .* 1.14 +met", "turnaround of in-flight UKF, p99.* 1.99 +NOT met", "decode of four.* 28.5 ns +NOT met",
                     "cyclictest's, embedded bus.* 1.295 +NOT met", "cyclictest's, vcan.* - +not measured"):
            self.assertRegex(shown.stdout, line)

    def test_without_records_nothing_is_met(self):
        shown = self.printed({})
        self.assertEqual(shown.returncode, 1)
        self.assertIn("0 of", shown.stdout.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
