"""Tests what text and files of others do to the programs: strangers_test.py HIL_BENCH CASE."""

import json
import os
import pathlib
import pty
import re
import resource
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[3]
FLIGHTS = ROOT / "bench" / "flights"
HIL_BENCH = pathlib.Path(sys.argv[1])

# One character of each kind that must not reach a medium as it is, with the escape that shows it.
EVIL = {"\x1b": r"\x1b", "\x07": r"\x07", "\x7f": r"\x7f", "\u0085": r"\u0085", "\u009b": r"\u009b", "\u200e": r"\u200e", "\u202e": r"\u202e",
        "\u2066": r"\u2066", "\u2028": r"\u2028", "\u2029": r"\u2029", "\ufffe": r"\ufffe", "\uffff": r"\uffff"}
ALL = "".join(f"{i}{one}" for i, one in enumerate(EVIL)) + "]0;pwned"
# A text of a TOML file cannot have characters below U+0020: the bench refuses them.
IN_TOML = {one: escape for one, escape in EVIL.items() if ord(one) >= 0x20}
TOML = "".join(f"{i}\\u{ord(one):04x}" for i, one in enumerate(IN_TOML)) + "]0;pwned"
FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufffe\uffff]")
DBC = ('VERSION "%s"\n\nNS_ :\n\nBS_:\n\nBU_: A B\n\nBO_ 256 M: 8 A\n SG_ S : 0|16@1- (1,0) [0|0] "%su" B\n\nCM_ BO_ 256 "comment %s";\n'
       'CM_ SG_ 256 S "signal %s";\nVAL_ 256 S 0 "value %s" 1 "=cmd|\' /C calc\'!A0" ;\n')


class InFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def bench(self, *words, codes=(0, 1, 3)):
        done = subprocess.run([HIL_BENCH, *words], cwd=self.folder, capture_output=True, timeout=200, check=False)
        self.assertIn(done.returncode, codes, (words, done.stdout[-500:], done.stderr[-500:]))
        return done

    def refused(self, *words):
        """The command ends with 2 and one line, which is returned."""
        done = self.bench(*words, codes=(2,))
        err = done.stderr.decode()
        self.assertEqual(done.stdout, b"")
        self.assertEqual(err.count("\n"), 1, err)
        return err

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content, encoding="utf-8") if isinstance(content, str) else path.write_bytes(content)
        return path

    def quick(self, name, **changed):
        """A copy of a quick flight with other values of top-level keys, written as TOML."""
        text = (FLIGHTS / "los_quick.toml").read_text()
        for key, value in changed.items():
            text = re.sub(rf"^{key} = .*$", lambda _, k=key, v=value: f"{k} = {v}", text, count=1, flags=re.MULTILINE)
        return self.write(name, text)


class Text(InFolder):
    def clean(self, output, shown=EVIL):
        """The output is UTF-8 without characters that control a terminal; with `shown`, their escapes are there."""
        text = output.decode("utf-8") if isinstance(output, bytes) else output
        self.assertIsNone(FORBIDDEN.search(text), ascii(text))
        if shown:
            for escape in shown.values():  # a page may break a long word, with an element that holds nothing
                self.assertIn(escape, text.replace("<wbr>", ""), ascii(text[:2000]))
        return text

    def test_of_a_dbc(self):
        self.write("d.dbc", DBC % ((ALL,) * 5))
        self.write("latin.dbc", (DBC % (("degree",) * 5)).encode().replace(b"degreeu", b"\xb0\x9b31m"))
        self.write("d.log", "(1.000000) vcan0 100#0000000000000000\n(1.100000) vcan0 100#0100000000000000\n")
        decoded = self.clean(self.bench("decode", "d.log", "--dbc", "d.dbc").stdout)
        self.assertEqual(decoded.count("\n"), 2)
        self.bench("decode", "d.log", "--dbc", "d.dbc", "--out", "decoded.txt")
        self.assertEqual((self.folder / "decoded.txt").read_text(), decoded)
        self.clean(self.bench("decode", "d.log", "--dbc", "latin.dbc").stdout, shown=None)
        self.clean(self.bench("decode", "d.log", "--dbc", "d.dbc", "--format", "csv").stdout, shown=None)
        self.clean(self.bench("dbc", "show", "d.dbc", "M").stdout)
        self.clean(self.bench("dbc", "show", "d.dbc").stdout, shown=None)
        for file in ("d.dbc", "latin.dbc"):
            self.clean(self.bench("dbc", "lint", file).stdout, shown=None)

    def test_of_a_scenario_in_each_report(self):
        self.quick("evil.toml", title=f'"T {TOML}"')
        done = self.bench("run", "evil.toml", "--bus", "in-process", "--json", "a.json", "--junit", "a.xml", "--html", "a.html", "--csv", "a.csv")
        self.clean(done.stdout, IN_TOML)
        tree = xml.etree.ElementTree.parse(self.folder / "a.xml")
        self.clean(tree.find("testsuite").get("name"), IN_TOML)
        self.clean((self.folder / "a.html").read_bytes(), IN_TOML)
        self.clean(self.bench("report", "a.json").stdout, shown=None)
        self.clean((self.folder / "a.html").read_bytes(), IN_TOML)

    def test_of_a_report_in_a_comparison(self):
        self.quick("plain.toml")
        self.bench("run", "plain.toml", "--bus", "in-process", "--json", "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        report["checks"][0].update(name=f"check {ALL}", measured=f"\nworse {ALL}", outcome="fail")
        report["provenance"]["cpu_model"] = f"CPU {ALL}"
        self.write("b.json", json.dumps(report))
        compared = self.clean(self.bench("compare", "a.json", "b.json", codes=(1,)).stdout)
        self.assertNotIn("\nworse 0", compared)
        report["provenance"]["scenario_hash"] = ALL
        self.write("b.json", json.dumps(report))
        self.clean(self.bench("compare", "a.json", "b.json", codes=(3,)).stdout, shown=None)

    def test_of_names_in_errors(self):
        for words in (("run", f"no {ALL}.toml"), ("report", f"no {ALL}.json"), ("decode", f"no {ALL}.log", "--dbc", "x.dbc"),
                      ("dbc", "lint", f"no {ALL}.dbc"), ("campaign", f"no {ALL}.toml"), ("run", "--bus", ALL, "x.toml")):
            err = self.refused(*words)
            self.clean(err, shown=None)
        self.write("key.toml", f'"{TOML}" = 1\n')
        self.clean(self.refused("run", "key.toml"), IN_TOML)

    def test_of_a_campaign_and_of_a_fault_matrix(self):
        self.quick("evil.toml", title=f'"T {TOML}"')
        self.write("c.toml", f'title = "C {TOML}"\nruns = 1\nseed = 1\n[[variant]]\nname = "V, {TOML}"\nscenario = "evil.toml"\n')
        for name in ('"><script>', "a b"):
            self.write("m.toml", (self.folder / "c.toml").read_text() +
                       f"[[metric]]\nname = '{name}'\nkind = \"rms_curve\"\nquantity = \"los.rate.pitch\"\n")
            self.bench("campaign", "m.toml", "--html", "m.html", "--out", "m.sqlite")
            page = (self.folder / "m.html").read_text()
            self.assertNotIn('"><script>', page)
            self.assertEqual([one for one in re.findall(r'(?:id="|href="#)([^"]*)"', page) if not re.fullmatch(r"[\w-]+", one)], [])
            (self.folder / "m.sqlite").unlink()
        self.clean(self.bench("campaign", "c.toml").stdout, IN_TOML)
        self.clean(self.bench("campaign", "report", "c.sqlite").stdout, IN_TOML)
        table = self.clean(self.bench("campaign", "export", "c.sqlite").stdout, IN_TOML)
        self.assertEqual({line.count(",") for line in re.sub('"[^"]*"', "", table).splitlines()}, {5})
        self.write("f.toml", f'[[fault]]\nname = "F {TOML}"\nkind = "lost"\nmessages = ["SeekerAngles"]\nfrom_s = 1.0\nto_s = 1.2\n')
        for form in ([], ["--markdown"]):
            shutil.rmtree(self.folder / "matrix", ignore_errors=True)
            self.clean(self.bench("faults", "evil.toml", "--set", "f.toml", "--out", "matrix", "--html", "f.html", *form).stdout, IN_TOML)
        self.clean((self.folder / "f.html").read_bytes(), IN_TOML)

    def test_of_a_mapping_in_a_table(self):
        own = ROOT / "docs" / "examples" / "own_ecu"
        self.write("own_ecu.mapping.toml", f'name = "=a,\\"b\\"{TOML}"\n' + (own / "own_ecu.mapping.toml").read_text())
        shutil.copy(own / "own_ecu.dbc", self.folder)
        text = (own / "own_ecu.toml").read_text()
        self.write("own.toml", text.replace("duration_s = 12.0", "duration_s = 2.0"))
        done = self.bench("run", "own.toml", "--lockstep", "--target", f"python3 {own / 'own_ecu.py'}", "--csv", "own.csv")
        self.clean(done.stdout, shown=None)
        table = self.clean((self.folder / "own.csv").read_bytes(), shown=None)
        self.assertGreater(table.count("\n"), 10)
        self.assertEqual({re.sub('"(?:[^"]|"")*"', "", line).count(",") for line in table.splitlines()}, {7})


class Terminal(InFolder):
    def test_of_a_title_on_the_screen(self):
        self.quick("evil.toml", title=f'"T {TOML}"')
        child, terminal = pty.fork()
        if child == 0:
            os.environ.update(TERM="xterm", LC_ALL="C.UTF-8", LINES="40", COLUMNS="300")
            os.chdir(self.folder)
            os.execv(HIL_BENCH, [str(HIL_BENCH), "run", "evil.toml", "--tui"])
        out = b""
        while True:
            try:
                part = os.read(terminal, 65536)
            except OSError:  # the program has closed the terminal
                break
            if not part:
                break
            out += part
        os.waitpid(child, 0)
        os.close(terminal)
        self.assertIn(rb"\u202e", out)
        for one in EVIL:
            if ord(one) > 0x7F:
                self.assertNotIn(one.encode(), out)


class Reports(InFolder):
    def setUp(self):
        super().setUp()
        self.quick("plain.toml")
        self.bench("run", "plain.toml", "--bus", "in-process", "--json", "a.json")
        self.report = json.loads((self.folder / "a.json").read_text())

    def cpu_s(self, *words, codes=(0, 1, 3)):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.bench(*words, codes=codes)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def test_are_read_in_a_time_that_grows_with_their_size(self):
        """With four times the content the reading takes about four times as long; with a quadratic step it would take sixteen times."""
        def checks(count):
            return [dict(self.report["checks"][0], name=f"check {i}") for i in range(count)]
        for what, content, size in (("objects", lambda n: [{}] * n, 40_000), ("checks", checks, 4000)):
            with self.subTest(what):
                taken = []
                for factor in (1, 4):
                    large = dict(self.report, **{"checks" if what == "checks" else "extra": content(size * factor)})
                    self.write("large.json", json.dumps(large))
                    taken.append(self.cpu_s("compare", "a.json", "large.json") + self.cpu_s("compare", "large.json", "large2.json")
                                 if self.write("large2.json", json.dumps(large)) else 0)
                self.assertLess(taken[1], 10 * taken[0], taken)

    def test_with_more_values_than_a_report_has_are_refused(self):
        for extra, why in (({"extra": [[]] * 1_000_001}, "more than 1000000 values"), ({"extra": {str(i): 1 for i in range(1001)}}, "more than 1000 keys")):
            self.write("large.json", json.dumps(dict(self.report, **extra)))
            for words in (("report", "large.json"), ("compare", "a.json", "large.json")):
                self.assertIn(why, self.refused(*words))


class Results(InFolder):
    def setUp(self):
        super().setUp()
        self.quick("q.toml")
        self.write("c.toml", 'title = "C"\nruns = 2\nseed = 1\n[[variant]]\nname = "V"\nscenario = "q.toml"\n')
        self.bench("campaign", "c.toml")
        self.results = self.folder / "c.sqlite"

    def change(self, *statements):
        database = sqlite3.connect(self.results)
        for statement in statements:
            database.execute(statement)
        database.commit()
        database.close()

    def expect_refused(self, why):
        for words in (("campaign", "report", "c.sqlite"), ("campaign", "export", "c.sqlite"), ("campaign", "merge", "m.sqlite", "c.sqlite"),
                      ("campaign", "c.toml", "--resume")):
            with self.subTest(words):
                self.assertIn(why, self.refused(*words))

    def test_with_a_view_without_end_are_refused(self):
        self.change("alter table source rename to other", "create view source as with recursive n(i) as (select 1 union all select i + 1 from n) "
                    "select 'scenario' as kind, i as name, 'x' as content from n")
        self.expect_refused("has other tables or views")

    def test_with_a_trigger_are_refused(self):
        self.change("create trigger t after insert on run begin delete from run; end")
        self.expect_refused("has other tables or views")

    def test_with_a_huge_value_are_refused(self):
        self.change("update run set samples = zeroblob(300000000) where id = 0")
        limit = resource.getrlimit(resource.RLIMIT_AS)
        too_large = "a value is larger than 256 MiB"
        self.assertIn(too_large, self.refused("campaign", "report", "c.sqlite"))
        exported = self.bench("campaign", "export", "c.sqlite", codes=(2,))  # it has printed the heading when it reads the value
        self.assertIn(too_large, exported.stderr.decode())
        self.assertEqual(limit, resource.getrlimit(resource.RLIMIT_AS))

    def test_of_a_fault_matrix_that_were_edited_are_refused(self):
        self.write("f.toml", '[[fault]]\nkind = "lost"\nmessages = ["SeekerAngles"]\nfrom_s = 1.0\nto_s = 1.2\n')
        self.bench("faults", "q.toml", "--set", "f.toml")
        self.results = self.folder / "faults.sqlite"
        whole = self.results.read_bytes()
        self.change("update run set judged = replace(judged, 'detected', 'tolerated')")
        self.assertNotEqual(whole, self.results.read_bytes())
        self.assertIn("has another hash than its content", self.refused("faults", "merge", "faults.sqlite"))
        # a row of another matrix
        self.results.write_bytes(whole)
        self.bench("faults", "q.toml", "--set", "f.toml", "--runs", "2", "--out", "other")
        self.assertIn("is of another campaign", self.refused("faults", "merge", "faults.sqlite", "other/faults.sqlite"))
        self.bench("faults", "q.toml", "--set", "f.toml", "--resume")


class Signatures(InFolder):
    def test_are_named_by_the_commands_that_show_the_file(self):
        self.quick("q.toml")
        self.bench("run", "q.toml", "--bus", "in-process", "--json", "a.json")
        self.write("c.toml", 'title = "C"\nruns = 1\nseed = 1\n[[variant]]\nname = "V"\nscenario = "q.toml"\n')
        self.bench("campaign", "c.toml")
        self.write("f.toml", '[[fault]]\nkind = "lost"\nmessages = ["SeekerAngles"]\nfrom_s = 1.0\nto_s = 1.2\n')
        self.bench("faults", "q.toml", "--set", "f.toml")
        if shutil.which("ssh-keygen") is None:
            self.skipTest("ssh-keygen is missing, expected Debian's package openssh-client")
        subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", self.folder / "key"], check=True)
        for file, *words in (("a.json", "report", "a.json"), ("c.sqlite", "campaign", "report", "c.sqlite"),
                             ("faults.sqlite", "faults", "merge", "faults.sqlite"),
                             ("faults.sqlite", "faults", "q.toml", "--set", "f.toml", "--resume")):
            signature = self.folder / f"{file}.sig"
            signature.unlink(missing_ok=True)
            self.assertIn(f"{file}: no signature covers it", self.bench(*words).stderr.decode())
            subprocess.run(["ssh-keygen", "-q", "-Y", "sign", "-n", "canhil-report", "-f", self.folder / "key", self.folder / file],
                           check=True, capture_output=True)
            self.assertIn(f"the signature {file}.sig covers it", self.bench(*words).stderr.decode())
            other = self.write("other", "other content\n")
            (self.folder / "other.sig").unlink(missing_ok=True)
            subprocess.run(["ssh-keygen", "-q", "-Y", "sign", "-n", "canhil-report", "-f", self.folder / "key", other], check=True,
                           capture_output=True)
            shutil.copy(self.folder / "other.sig", signature)
            self.assertIn(f"the signature {file}.sig does NOT cover it", self.bench(*words).stderr.decode())


class Commands(InFolder):
    def test_of_a_scenario_are_refused_on_request(self):
        own = ROOT / "docs" / "examples" / "own_ecu"
        for name in ("own_ecu.mapping.toml", "own_ecu.dbc"):
            shutil.copy(own / name, self.folder)
        plain = (own / "own_ecu.toml").read_text()
        self.write("plain.toml", plain)
        target = ("--target", f"python3 {own / 'own_ecu.py'}")
        for key in ("before", "after"):
            self.write("s.toml", plain.replace("[target]\n", f'[target]\n{key} = "touch {self.folder}/was-run"\n'))
            self.write("c.toml", 'title = "C"\nruns = 1\nseed = 1\n[[variant]]\nname = "V"\nscenario = "s.toml"\n')
            for words in (("run", "s.toml", *target), ("campaign", "c.toml", *target), ("campaign", "replay", "c.toml", "0")):
                with self.subTest((key, words)):
                    err = self.refused(*words, "--no-commands")
                    self.assertIn(f"key 'target.{key}'", err)
                    self.assertFalse((self.folder / "was-run").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
