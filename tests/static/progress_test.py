"""Runs tests/setup/progress.sh with a pipe and with a terminal as its standard output."""

import os
import pty
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRESS = Path(__file__).resolve().parents[1] / "setup/progress.sh"
NINJA = "[1/9] Building CXX object a.o\n[2/9] Building CXX object b.o\nFAILED: b.o\nb.cpp:3:1: error: no\n"
CTEST = ("Test project /x\n      Start  1: a.A\n 1/12 Test  #1: a.A ..........   Passed    0.01 sec\n      Start 12: b.B\n"
         " 2/12 Test #12: b.B ..........***Failed    0.02 sec\nb.cpp:4: Failure\n\n50% tests passed, 1 tests failed out of 12\n")
APT = ("Get:1 http://deb InRelease\nThe following NEW packages will be installed:\n0 upgraded, 70 newly installed, 0 to remove.\n"
       "Get:1 http://deb a\nGet:2 http://deb b\nUnpacking a (1) ...\n")


class Progress(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def script(self, text, lasting_s=2.5, interval_s=1):
        log = Path(self.folder.name, "log")
        log.write_text(text)
        return ["bash", "-euo", "pipefail", "-c",
                f'source "{PROGRESS}"; progress_interval_s={interval_s}; progress_start "the work" "{log}"; '
                f'sleep {lasting_s}; progress_stop; echo "end $NINJA_STATUS"; progress_rest "{log}"']

    def by_pipe(self, *arguments, **more):
        return subprocess.run(self.script(*arguments, **more), capture_output=True, text=True, check=True).stdout

    def test_a_pipe_gets_a_line_each_interval(self):
        out = self.by_pipe(NINJA)
        self.assertRegex(out, r"^the work: 2 of 9 \(0:0[12]\)\n(the work: 2 of 9 \(0:0\d\)\n)*end \[%f/%t\] \n")
        self.assertTrue(out.endswith("FAILED: b.o\nb.cpp:3:1: error: no\n"), out)

    def test_a_pipe_gets_none_of_a_short_work(self):
        self.assertTrue(self.by_pipe(NINJA, lasting_s=1.5, interval_s=30).startswith("end "))

    def test_cases_and_packages_are_counted(self):
        out = self.by_pipe(CTEST)
        self.assertIn("the work: 2 of 12 (", out)
        self.assertNotIn("a.A", out)
        for kept in ("#12: b.B ..........***Failed", "b.cpp:4: Failure", "50% tests passed"):
            self.assertIn(kept, out)
        self.assertIn("the work: unpacked 1 of 70 (", self.by_pipe(APT))
        self.assertIn("the work: fetched 2 of 70 (", self.by_pipe(APT[:APT.index("Unpacking")]))
        self.assertRegex(self.by_pipe(""), r"^the work \(0:0")

    def test_a_terminal_gets_one_line_that_moves_and_goes_away(self):
        terminal, inside = pty.openpty()
        subprocess.run(self.script(NINJA, interval_s=30), stdout=inside, check=True)
        os.close(inside)
        out = b""
        try:
            while block := os.read(terminal, 65536):
                out += block
        except OSError:  # the program has closed its end of the terminal
            pass
        os.close(terminal)
        shown, end = out.decode().split("end ")
        self.assertRegex(shown, r"^(\r\x1b\[Kthe work: 2 of 9 \(0:0\d\))+\r\x1b\[K$")
        self.assertIn("FAILED: b.o", end)


if __name__ == "__main__":
    unittest.main()
