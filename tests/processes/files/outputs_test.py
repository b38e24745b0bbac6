"""Tests that no command writes over a file that it reads: outputs_test.py HIL_BENCH HIL_TARGET DBCGEN CASE.

Table: the table of commands in commands.py is that of the programs. Inputs: each input as each output. Outputs: two outputs in one file, and
outputs whose names a command makes. Links: links that somebody else puts where a command writes."""

import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

sys.dont_write_bytecode = True
from commands import LINES, TABLE, Workplace, described, with_output, writers  # noqa: E402

HIL_BENCH, HIL_TARGET, DBCGEN = sys.argv[1:4]


class InWorkplace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.place = Workplace(cls.scratch.name, HIL_BENCH, HIL_TARGET, DBCGEN)
        cls.before = cls.place.files()

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def refused(self, words, *named):
        """The command is refused in one line that names the files, and changes nothing."""
        with self.subTest(" ".join(words)):
            done = subprocess.run([self.place.programs / words[0], *words[1:]], cwd=self.place.folder, capture_output=True, timeout=60,
                                  check=False)
            err = done.stderr.decode()
            self.assertEqual(done.returncode, 2, (done.stdout[:500], err))
            self.assertEqual(err.count("\n"), 1, err)
            self.assertEqual(done.stdout, b"")
            self.assertIn("is the same file as", err)
            for name in named:
                self.assertIn(pathlib.Path(name).name, err)
            after = self.place.files()
            self.assertEqual(set(after), set(self.before))
            for name, content in self.before.items():
                self.assertTrue(after[name] == content, f"{name} has changed")


class Table(InWorkplace):
    def test_is_complete(self):
        found = described(self.place.programs)
        self.assertEqual(set(found), set(TABLE), "a command is missing in the table of commands.py, or is there no more")
        for command, options in found.items():
            self.assertEqual(options, set(TABLE[command]), f"{command}: the table of commands.py must say of each option whether it writes")

    def test_each_writing_command_has_a_line(self):
        with_line = {command for command, *_ in LINES}
        for command in TABLE:
            if writers(command):
                self.assertIn(command, with_line)


class Inputs(InWorkplace):
    def test_are_never_outputs(self):
        for command, words, inputs in LINES:
            for option in writers(command):
                for path in inputs:
                    self.refused(with_output(command, words, option, path), path)

    def test_by_other_names(self):
        """Hard links, symbolic links and other spellings of each input; one output of each command stands for all."""
        for command, words, inputs in LINES:
            option = writers(command)[-1]
            for path in inputs:
                names = self.place.folder / "names"
                names.mkdir()
                try:
                    os.link(self.place.folder / path, names / "hard")
                    (names / "soft").symlink_to(self.place.folder / path)
                    (names / "folder").symlink_to((self.place.folder / path).parent)
                    self.before = self.place.files()
                    for spelling in ("names/hard", "names/soft", f"names/folder/{pathlib.Path(path).name}", f"./names/../{path}"):
                        self.refused(with_output(command, words, option, spelling), spelling, path)
                finally:
                    for entry in names.iterdir():
                        entry.unlink()
                    names.rmdir()


class Outputs(InWorkplace):
    def test_need_files_of_their_own(self):
        done = set()
        for command, words, _ in LINES:
            options = writers(command)
            if command in done or len(options) < 2:
                continue
            done.add(command)
            for first, second in zip(options, options[1:] + options[:1]):
                name = "new.sqlite"
                self.refused(with_output(command, with_output(command, words, first, name)[len(command.split()):], second, f"./{name}"), name)

    def test_that_a_command_names_itself(self):
        place = self.place
        # the page of a report
        (place.folder / "page.html").write_bytes((place.folder / "run.json").read_bytes())
        # the log of a check, and the log of another golden flight
        for end in ("toml", "log"):
            (place.folder / "golden" / f"plain.check.{end}").write_bytes((place.folder / "golden" / f"plain.{end}").read_bytes())
        # a saved violation that is flown again
        place.write("violation-0.toml", (place.folder / "plain.toml").read_text())
        # a log of which only a part could be written
        (place.folder / "cut.log.incomplete").write_bytes((place.folder / "run.log").read_bytes())
        # the results of a campaign
        os.link(place.folder / "run.log", place.folder / "log.sqlite")
        self.before = place.files()
        campaign = ["hil-bench", "campaign", "campaign.toml", "--out"]
        self.refused([*campaign, "log.sqlite"], "log.sqlite", "run.log")
        self.refused([*campaign, "new.sqlite", "--json", "./new.sqlite"], "new.sqlite")
        self.refused(["hil-bench", "report", "page.html"], "page.html")
        self.refused(["hil-bench", "golden", "check", "golden", "--target", "./my-target"], "plain.check.log")
        self.refused(["hil-bench", "faults", "violation-0.toml", "--set", "faults.toml", "--out", "."], "violation-0.toml")
        self.refused(["hil-bench", "run", "plain.toml", "--target", "./my-target cut.log.incomplete", "--log", "cut.log"], "cut.log.incomplete")


class Links(InWorkplace):
    def test_a_temporary_name_is_not_foreseen(self):
        """Somebody else fills the folder with links at names that a program could choose by its process id."""
        words = ["hil-bench", "run", "plain.toml", "--bus", "in-process", "--json", "out/report.json", "--log", "out/run.log"]
        out = self.place.folder / "out"
        out.mkdir()
        victim = self.place.write("victim.txt", "precious\n")
        process = subprocess.Popen(["sh", "-c", 'read -r go; exec "$@"', "sh", self.place.programs / words[0], *words[1:]], cwd=self.place.folder,
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        for name in ("report.json", "run.log"):
            for end in (".part", ".new", ".tmp", ""):
                link = out / f"{name}.{process.pid}{end}"
                link.symlink_to(victim)
            (out / f"{name}.part").symlink_to(victim)
        seen, ended = set(), threading.Event()

        def watch():
            while not ended.is_set():
                seen.update(entry.name for entry in out.iterdir() if not entry.is_symlink())

        watcher = threading.Thread(target=watch)
        watcher.start()
        _, err = process.communicate(b"go\n", timeout=60)
        ended.set()
        watcher.join()
        self.assertIn(process.returncode, (0, 3), err)
        self.assertEqual(victim.read_text(), "precious\n")
        self.assertEqual({entry.name for entry in out.iterdir() if not entry.is_symlink()}, {"report.json", "run.log"})
        for name in seen - {"report.json", "run.log"}:
            self.assertNotIn(str(process.pid), name)

    def test_an_output_that_is_a_link_is_refused(self):
        victim = self.place.write("victim2.txt", "precious\n")
        (self.place.folder / "link").symlink_to(victim)
        (self.place.folder / "dangling").symlink_to(self.place.folder / "nothing")
        for command, words, _ in LINES:
            for option in writers(command):
                for name in ("link", "dangling"):
                    line = with_output(command, words, option, name)
                    with self.subTest(line):
                        done = subprocess.run([self.place.programs / line[0], *line[1:]], cwd=self.place.folder, capture_output=True,
                                              timeout=60, check=False)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertEqual(done.stderr.count(b"\n"), 1, done.stderr)
                        self.assertEqual(victim.read_text(), "precious\n")
                        self.assertTrue((self.place.folder / name).is_symlink())
                        self.assertFalse((self.place.folder / "nothing").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], verbosity=2)
