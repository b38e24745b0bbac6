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


if __name__ == "__main__":
    unittest.main()
