"""Tests hil-bench run --tui on terminals of several sizes: terminal_test.py HIL_BENCH."""

import fcntl
import os
import pathlib
import pty
import select
import struct
import subprocess
import sys
import termios
import time
import unittest

HIL_BENCH = sys.argv[1]
QUICK = pathlib.Path(__file__).resolve().parents[3] / "bench/flights/transfer_alignment_quick.toml"
BEGIN, END = b"\x1b[?1049h", b"\x1b[?1049l"  # switch to the alternate screen of the program, and back
PATIENCE_S = 120


def fly(rows, columns, key=b""):
    """Flies with --tui. Returns (exit code, output to the terminal, whether the terminal's settings are the same as before)."""
    child, terminal = pty.fork()
    if child == 0:
        os.environ["TERM"] = "xterm"
        time.sleep(0.2)  # waits until the parent process has set the size of the terminal
        os.execv(HIL_BENCH, [HIL_BENCH, "run", str(QUICK), "--tui"])
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
    before, after, out, until = termios.tcgetattr(terminal), None, b"", time.monotonic() + PATIENCE_S
    while time.monotonic() < until:
        if not select.select([terminal], [], [], 0.1)[0]:
            continue
        try:
            part = os.read(terminal, 65536)
        except OSError:  # the program has closed the terminal
            break
        out += part
        if END in out:  # the program restores the terminal's settings after it has sent END
            after = termios.tcgetattr(terminal)
        if key and b"heading error" in out:  # the flight has begun
            os.write(terminal, key)
            key = b""
    _, status = os.waitpid(child, 0)
    os.close(terminal)
    return os.waitstatus_to_exitcode(status), out, after is not None and after[3] == before[3]


class Terminal(unittest.TestCase):
    def expect_restored(self, out, same):
        self.assertIn(BEGIN, out)
        self.assertIn(END, out)
        self.assertTrue(same)
        self.assertIn(b"Transfer alignment", out.split(END)[-1])  # the report is printed after the screen

    def test_shows_a_run_and_gives_the_terminal_back(self):
        code, out, same = fly(40, 100)
        self.assertIn(code, (0, 1, 3))
        self.expect_restored(out, same)
        for text in (b"heading error", b"bus load", b"checks:"):
            self.assertIn(text, out.split(END)[0])

    def test_small_screens(self):
        for rows, columns in ((10, 30), (3, 5)):
            with self.subTest(rows=rows, columns=columns):
                code, out, same = fly(rows, columns)
                self.assertIn(code, (0, 1, 3))
                self.expect_restored(out, same)

    def test_space_pauses(self):
        _, out, same = fly(30, 90, b" ")
        self.assertIn(b"paused", out)
        self.expect_restored(out, same)

    def test_interrupted(self):
        code, out, same = fly(30, 90, b"\x03")
        self.assertEqual(code, 3)
        self.assertIn(b"interrupted", out)
        self.expect_restored(out, same)

    def test_no_terminal(self):
        refused = subprocess.run([HIL_BENCH, "run", str(QUICK), "--tui"], capture_output=True, text=True, timeout=60)
        self.assertEqual((refused.returncode, refused.stdout), (2, ""))
        self.assertRegex(refused.stderr, r"\Ahil-bench: --tui: standard output is no terminal, expected one\n\Z")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
