"""Tests that each seeded defect of tests/mutants can be inserted into the target, and tests the code that reads and selects the defects."""

import re
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/mutants"), str(ROOT / "tests/static")]
import accepting  # noqa: E402
import copied_tree  # noqa: E402
import overlaid  # noqa: E402
import run  # noqa: E402
import seeded  # noqa: E402

ONE = """[[mutant]]
name = "sign"
file = "target/a.cpp"
was = '''a + b'''
is = '''a - b'''
what = "The sum is a difference."
"""


class Mutants(unittest.TestCase):
    def setUp(self):
        self.mutants = seeded.all_mutants()

    def test_every_file_is_a_family(self):
        self.assertEqual({file.stem for file in seeded.HERE.glob("*.toml")} - {"equivalent"}, set(seeded.FAMILIES))

    def test_there_are_enough_of_each_family(self):
        counts = Counter(mutant.family for mutant in self.mutants)
        for family, least in seeded.FAMILIES.items():
            self.assertGreaterEqual(counts[family], least, family)
        self.assertGreaterEqual(len(self.mutants), seeded.AT_LEAST)

    def test_names_are_unique(self):
        self.assertEqual([name for name, n in Counter(m.full_name for m in self.mutants).items() if n > 1], [])

    def test_equivalents_are_mutants_with_a_proof(self):
        names = {mutant.full_name for mutant in self.mutants}
        for name, proof in seeded.equivalents().items():
            self.assertIn(name, names)
            self.assertGreater(len(proof), 100, name)

    def test_no_two_are_the_same_defect(self):
        made = Counter((m.file, m.applied((ROOT / m.file).read_text())) for m in self.mutants)
        self.assertEqual(max(made.values()), 1)

    def test_each_has_its_place_in_the_target(self):
        for mutant in self.mutants:
            with self.subTest(mutant.full_name):
                self.assertRegex(mutant.name, r"^[a-z][a-z0-9_]*$")
                self.assertTrue(mutant.file.startswith("target/"), mutant.file)
                text = (ROOT / mutant.file).read_text()
                self.assertEqual(text.count(mutant.was), 1)
                self.assertNotEqual(mutant.applied(text), text)

    def test_each_says_its_defect_in_a_sentence(self):
        for mutant in self.mutants:
            with self.subTest(mutant.full_name):
                self.assertRegex(mutant.what, r"^[A-Z][^\n]*[^.]\.$")


class Reading(unittest.TestCase):
    def test_a_mutant_is_read(self):
        mutant, = seeded.mutants_of("device", ONE)
        self.assertEqual(mutant.full_name, "device.sign")
        self.assertEqual(mutant.applied("x = a + b;"), "x = a - b;")

    def test_text_that_is_not_there_once_is_refused(self):
        mutant, = seeded.mutants_of("device", ONE)
        for text, times in (("x = b + a;", 0), ("x = a + b; y = a + b;", 2)):
            with self.assertRaisesRegex(ValueError, f"device.sign: its text is {times} times in target/a.cpp, expected once"):
                mutant.applied(text)

    def test_other_keys_are_refused(self):
        for text in (ONE.replace("what", "why"), ONE + "more = 1\n", ONE.replace('"sign"', "3")):
            with self.assertRaisesRegex(ValueError, "device: mutant 1 has"):
                seeded.mutants_of("device", text)
        with self.assertRaisesRegex(ValueError, "expected tables"):
            seeded.mutants_of("device", "")


class Choosing(unittest.TestCase):
    def setUp(self):
        self.mutants = seeded.all_mutants()

    def test_only_those_that_the_expression_is_in(self):
        names = {mutant.full_name for mutant in run.chosen(self.mutants, re.compile(r"^wind\..*sign"))}
        self.assertIn("wind.rudder_sign", names)
        self.assertTrue(all(name.startswith("wind.") and "sign" in name for name in names), names)

    def test_as_many_as_asked_of_as_many_families_as_possible_by_seed(self):
        def picked(seed, count=12):
            return run.chosen(self.mutants, re.compile(""), count, seed)
        self.assertEqual([mutant.family for mutant in picked(1)][:len(seeded.FAMILIES)], list(seeded.FAMILIES))
        self.assertEqual(len(set(picked(1))), 12)
        self.assertEqual(len({mutant.family for mutant in picked(1, 5)}), 5)
        self.assertEqual(picked(1), picked(1))
        self.assertNotEqual(picked(1), picked(2))


PAGE = """{"suites": [{"requirements": [
    {"id": "A", "items": [{"name": "a", "outcome": "pass", "measured": "1"}]},
    {"id": "B", "items": [{"name": "b", "outcome": "not measured", "measured": "2"}, {"name": "c", "outcome": "fail", "measured": "3"}]}]}]}"""


class Judging(unittest.TestCase):
    """Tests accept() with a replacement for the bench: a program that writes a given report and ends with a given exit code."""

    def judged(self, code, page=None):
        with tempfile.TemporaryDirectory() as folder:
            bench = Path(folder, "bench")
            write = f"while [ \"$1\" != --json ]; do shift; done\ncat > \"$2\" <<'END'\n{page}\nEND\n" if page else ""
            bench.write_text(f"#!/bin/sh\n{write}echo one; echo two; exit {code}\n")
            bench.chmod(0o755)
            return accepting.accept("target", "wind", ("errors",), bench=bench)

    def test_what_passes_or_is_not_measured_catches_nothing(self):
        self.assertEqual(self.judged(0), (0, None))
        self.assertEqual(self.judged(3), (3, None))

    def test_the_first_requirement_that_is_not_met_is_named(self):
        self.assertEqual(self.judged(1, PAGE), (1, ("B", "c: 3")))
        self.assertEqual(self.judged(2), (2, ("no report", "exit code 2: two")))
        self.assertEqual(self.judged(1, '{"suites": []}'), (1, ("no requirement", "exit code 1")))

    def test_the_table_adds_up(self):
        entries = [{"family": "a", "outcome": run.CAUGHT}, {"family": "a", "outcome": run.SURVIVED},
                   {"family": "b", "outcome": run.NO_BUILD}]
        self.assertEqual(run.table_of(entries)["a"], {"mutants": 2, "caught": 1, "survived": 1, "does not build": 0})
        self.assertEqual(run.table_of(entries)["total"], {"mutants": 3, "caught": 1, "survived": 1, "does not build": 1})

    def test_a_mutant_of_one_estimator_is_shown_to_its_suite_only(self):
        mutants = {mutant.full_name: mutant for mutant in seeded.all_mutants()}
        self.assertEqual(run.suites_of(mutants["wind.rudder_sign"]), ("several", "wind"))
        shared, = seeded.mutants_of("strapdown", ONE)
        self.assertEqual(sorted(run.suites_of(shared)), sorted(run.SUITES))

    def test_every_suite_is_flown(self):
        self.assertEqual(sorted(run.SUITES), sorted(file.parent.name for file in (ROOT / "bench/acceptance").glob("*/suite.toml")))


class Overlaying(unittest.TestCase):
    """Tests which file is compiled in place of a source, if each source is compiled separately and if several are compiled as one."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.place = Path(self.folder.name, "place")
        self.list = Path(self.folder.name, "a/CMakeFiles/a.dir/Unity/unity_0_cxx.cxx")
        self.list.parent.mkdir(parents=True)
        self.list.write_text(f'#include "{ROOT}/target/a.cpp"\n#include "{ROOT}/target/b.cpp"\n')

    def test_a_source_is_replaced(self):
        self.assertEqual(overlaid.source_again(self.place, "target/a.cpp", f"{ROOT}/target/a.cpp"), self.place / "target/a.cpp")
        self.assertEqual(overlaid.source_again(self.place, "target/a.hpp", f"{ROOT}/target/a.cpp"), f"{ROOT}/target/a.cpp")

    def test_a_source_is_replaced_where_it_is_compiled_with_others(self):
        again = overlaid.source_again(self.place, "target/a.cpp", str(self.list))
        self.assertEqual(again.read_text(), f'#include "{self.place}/target/a.cpp"\n#include "{ROOT}/target/b.cpp"\n')

    def test_a_source_that_is_not_among_them_is_reported(self):
        with self.assertRaisesRegex(overlaid.DoesNotBuild, "target/c.cpp: not in"):
            overlaid.source_again(self.place, "target/c.cpp", str(self.list))


class Copying(unittest.TestCase):
    def test_a_file_that_stays_the_same_is_not_written_again(self):
        with tempfile.TemporaryDirectory() as folder:
            to = Path(folder)
            copied_tree.copy_tree(to)
            same, changed, gone = to / "README.md", to / "target/main.cpp", to / "target/none.cpp"
            before = same.stat().st_mtime_ns
            changed.write_text("")
            gone.write_text("")
            copied_tree.copy_tree(to)
            self.assertEqual(same.stat().st_mtime_ns, before)
            self.assertEqual(changed.read_bytes(), (ROOT / "target/main.cpp").read_bytes())
            self.assertFalse(gone.exists())


if __name__ == "__main__":
    unittest.main()
