"""Validates reports of several kinds by the schemas in docs, and reads them by readers made of the schemas: schema_test.py HIL_BENCH SOURCE.

The validator is python3-jsonschema, the maker of readers python3-warlock. In this test the schema permits no key that it does not name, so a key that
a report gains must be described.
"""
import copy
import itertools
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

import jsonschema
import warlock

HIL_BENCH, SOURCE = sys.argv[1], Path(sys.argv[2])
SCHEMA = json.loads((SOURCE / "docs/report.schema.json").read_text(encoding="utf-8"))
FLIGHTS = sorted((SOURCE / "bench/flights").glob("*.toml"))
EXAMPLES = SOURCE / "docs/examples"
FAULT = """[[fault]]
name = "noise"
kind = "lost"
messages = ["%s"]
from_s = 1.0
to_s = 1.5
"""


def strict(part):
    """The schema with all keys named: without others, and with `allOf` and references merged."""
    if isinstance(part, list):
        return [strict(one) for one in part]
    if not isinstance(part, dict):
        return part
    if "allOf" in part:
        merged = {"properties": {}, "required": []}
        for one in part["allOf"]:
            one = SCHEMA["definitions"][one["$ref"].split("/")[-1]] if "$ref" in one else one
            merged["properties"].update(one["properties"])
            merged["required"] += one.get("required", [])
        return strict({"type": "object", **merged})
    result = {key: strict(value) for key, value in part.items()}
    if isinstance(result.get("properties"), dict) and "additionalProperties" not in result:
        result["additionalProperties"] = False
    return result


def in_limits(check):
    value = check["value"]
    lower, upper = check.get("lower"), check.get("upper")
    above = lower is None or value > lower or (check["lower_inclusive"] and value == lower)
    beneath = upper is None or value < upper or (check["upper_inclusive"] and value == upper)
    return above and beneath


def margin(check):
    shares = [(check[key] - check["value"]) * (1 if key == "upper" else -1) / abs(check[key])
              for key in ("lower", "upper") if check.get(key)]
    return min(shares) if shares else None


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.reports = {}
        for flight in FLIGHTS:
            cls.fly(flight.stem, flight, "--bus", "in-process")
        cls.fly("wire", SOURCE / "bench/flights/all_four.toml", "--bus", "in-process?bitrate=1000000")
        cls.fly("fd wire", SOURCE / "bench/flights/wind_quick.toml", "--dbc", "canhil-fd",
                "--bus", "in-process?bitrate=500000&data-bitrate=2000000")
        cls.fly("real time", SOURCE / "bench/flights/los_quick.toml", "--operator", "Ada")
        for name, message in (("los_quick", "SeekerAngles"), ("wind_quick", "GliderNavAttitude")):
            faults = Path(cls.folder.name, f"{name}.faults.toml")
            faults.write_text(FAULT % message, encoding="utf-8")
            cls.fly(f"{name} with a fault", SOURCE / f"bench/flights/{name}.toml", "--bus", "in-process", "--faults", faults)
        for name in ("own_ecu", "car", "marine", "uav", "auv", "odometer", "autopilot", "hover"):
            device = EXAMPLES / name / name
            cls.fly(name, f"{device}.toml", "--lockstep", "--target", f"/usr/bin/python3 {device}.py")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return Path(cls.folder.name, f"{name}.json")

    @classmethod
    def fly(cls, name, scenario, *options):
        junit = cls.path(name).with_suffix(".xml")
        done = subprocess.run([HIL_BENCH, "run", scenario, "--json", cls.path(name), "--junit", junit,
                               "--html", cls.path(name).with_suffix(".html"), *options],
                              capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode in (0, 1, 3), (name, done.stderr)
        cls.reports[name] = json.loads(cls.path(name).read_text(encoding="utf-8"))

    def checks(self):
        for name, report in self.reports.items():
            for check in report["checks"]:
                yield f"{name}: {check['name']}", check

    def compare(self, before, after, *options):
        paths = []
        for name, report in (("before", before), ("after", after)):
            paths.append(self.path(name))
            paths[-1].write_text(json.dumps(report), encoding="utf-8")
        return subprocess.run([HIL_BENCH, "compare", *paths, *options], capture_output=True, text=True, timeout=60, check=False)

    def test_fit_the_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        validator = jsonschema.Draft7Validator(strict(SCHEMA))
        for name, report in self.reports.items():
            with self.subTest(name):
                self.assertEqual([f"{list(error.path)}: {error.message[:200]}" for error in validator.iter_errors(report)], [])

    def test_frames_around_the_worst_value_have_its_time_and_their_signals(self):
        for name, report in self.reports.items():
            at = {check["name"]: check["worst_at_s"] for check in report["checks"] if "worst_at_s" in check}
            with self.subTest(name):
                self.assertEqual({around["check"] for around in report["frames"]}, set(at))
                for around in report["frames"]:
                    frames, worst_s = around["frames"], at[around["check"]]
                    self.assertGreater(len(frames), 5, around["check"])
                    self.assertLess(abs(frames[min(10, len(frames) - 1)]["t_s"] - worst_s), 1.2, around["check"])
                    self.assertTrue(any(frame["transmitted"] for frame in frames))
                    self.assertGreater(sum(len(frame.get("signals", [])) for frame in frames), len(frames) / 2, around["check"])

    def batches(self):
        """Reports of a campaign, a matrix of faults and a suite, each with its schema."""
        folder = Path(self.folder.name)
        faults = folder / "set.toml"
        faults.write_text(FAULT % "SeekerAngles", encoding="utf-8")
        campaign = folder / "batch.toml"
        campaign.write_text(f"""title = "Batch"
runs = 2
seed = 1
[[variant]]
name = "A"
scenario = "{SOURCE}/bench/flights/transfer_alignment_quick.toml"
[[check]]
kind = "error"
quantity = "attitude.heading"
below_deg = 90
[[metric]]
kind = "rms_curve"
quantity = "attitude.heading"
[[metric]]
kind = "value_at"
quantity = "attitude.heading"
at_s = 2.0
at_most_mrad = 2000
""", encoding="utf-8")
        for schema, words in (("campaign", ("campaign", campaign)), ("campaign", ("faults", FLIGHTS[0].parent / "los_quick.toml", "--set", faults)),
                              ("accept", ("accept", "--estimator", "los_rate", "--family", "protocol"))):
            out = ("--out", folder) if schema == "campaign" else ()
            done = subprocess.run([HIL_BENCH, *words, *out, "--json", "-"], capture_output=True, text=True, timeout=120, check=False)
            assert done.returncode in (0, 1), done.stderr
            yield words[0], json.loads((SOURCE / f"docs/{schema}.schema.json").read_text(encoding="utf-8")), json.loads(done.stdout)

    def test_of_campaigns_matrices_and_suites_fit_their_schemas(self):
        for name, schema, report in self.batches():
            with self.subTest(name):
                jsonschema.Draft7Validator.check_schema(schema)
                errors = jsonschema.Draft7Validator(strict(schema)).iter_errors(report)
                self.assertEqual([f"{list(error.path)}: {error.message[:200]}" for error in errors], [])
                reader = warlock.model_factory(schema)  # a reader that a public tool makes of the schema
                self.assertEqual(reader(**report).outcome, report["outcome"])

    def test_a_reader_made_of_the_schema_reads_them_all(self):
        reader = warlock.model_factory(SCHEMA)
        self.assertGreater(len(self.reports), 10)
        for name, report in self.reports.items():
            with self.subTest(name):
                read = reader(**report)
                self.assertEqual((read.verdict, len(read.checks)), (report["verdict"], len(report["checks"])))
        with self.assertRaises(warlock.InvalidOperation):
            read.verdict = "maybe"

    def test_numbers_of_a_check_agree_with_its_outcome(self):
        judged = set()
        for name, check in self.checks():
            if "value" not in check or check["outcome"] == "not measured":
                continue
            with self.subTest(name):
                judged.add(check["kind"])
                self.assertEqual(in_limits(check), check["outcome"] == "pass", check)
                if "margin" in check:
                    self.assertAlmostEqual(check["margin"], margin(check), 12)
                self.assertLessEqual(check.get("worst_at_s", 0), check.get("to_s", 1e9))
        self.assertGreaterEqual(judged, {"error", "consistency", "miss_distance", "answers", "counters", "convergence", "sigma",
                                         "latency", "output_period", "heartbeat", "response", "bus_load", "flag"})

    def test_a_check_without_a_value_is_one_that_has_none(self):
        without = {check["kind"] for _, check in self.checks() if check["outcome"] == "pass" and "value" not in check}
        self.assertLessEqual(without, {"answering", "recovers_within", "event"})

    def test_the_reader_refuses_what_the_schema_refuses(self):
        good = self.reports["los_quick"]
        validator = jsonschema.Draft7Validator(SCHEMA)
        whole = {"lower": 1, "lower_inclusive": True, "from_s": 1, "to_s": 2, "time_to_go_s": [1, 2], **good["checks"][0]}
        for key, wrong in itertools.product(SCHEMA["definitions"]["check"]["properties"], ([], None)):
            if key == "requirement":  # the bench does not read it
                continue
            with self.subTest(key=key, wrong=wrong):
                bad = copy.deepcopy(good)
                bad["checks"][0] = {**whole, key: wrong}
                self.assertFalse(validator.is_valid(bad))
                done = self.compare(good, bad)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(key, done.stderr)

    def test_names_of_test_cases_are_unique_over_all_files(self):
        flights = [flight.stem for flight in FLIGHTS]
        names = [(case.get("classname"), case.get("name")) for flight in flights
                 for case in xml.etree.ElementTree.parse(self.path(flight).with_suffix(".xml")).iter("testcase")]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 10 * len(flights) / 2)

    def test_a_gain_that_changes_an_rms_by_45_percent_is_worse(self):
        scenario = Path(self.folder.name, "gain.toml")
        text = (SOURCE / "bench/flights/los_quick.toml").read_text(encoding="utf-8")
        gain = "jerk_density_m2ps5 = 300"
        self.assertIn(gain, text)
        scenario.write_text(text.replace(gain, "jerk_density_m2ps5 = 2300"), encoding="utf-8")
        self.fly("gain", scenario, "--bus", "in-process")
        # As if the gain were the target's own: the report says that the scenario is the same.
        drifted = self.reports["gain"]
        drifted["provenance"]["scenario_hash"] = self.reports["los_quick"]["provenance"]["scenario_hash"]
        done = self.compare(self.reports["los_quick"], drifted)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("worse    check 'error los.rate rms 3 to 2 s to go': pass; 0.9849 -> 1.451 mrad/s, limit < 2.3 mrad/s, "
                      "margin 57.2 % -> 36.9 %\n", done.stdout)
        self.assertEqual(self.compare(self.reports["los_quick"], drifted, "--tolerance", "30").returncode, 0)
        folder = Path(self.folder.name, "history")
        folder.mkdir()
        for day, report in enumerate((self.reports["los_quick"], self.reports["los_quick"], drifted), 1):
            report = copy.deepcopy(report)
            report["provenance"].update(date=f"2026-11-0{day}T00:00:00Z", scenario="los_quick.toml")
            (folder / f"{9 - day}.json").write_text(json.dumps(report), encoding="utf-8")
        page = Path(self.folder.name, "history.html")
        told = subprocess.run([HIL_BENCH, "compare", "--history", folder, "--html", page], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(told.returncode, 1, told)
        self.assertIn("worse  error los.rate rms 3 to 2 s to go: pass; 0.9849 -> 1.451 mrad/s, limit < 2.3 mrad/s; margin 36.9 %, "
                      "before 57.2 % (median of 2, 57.2 to 57.2 %)", told.stdout)
        self.assertIn("same   miss_distance: pass", told.stdout)
        self.assertIn("margins of the checks", page.read_text(encoding="utf-8"))
        (folder / "6.json").unlink()
        self.assertEqual(subprocess.run([HIL_BENCH, "compare", "--history", folder], capture_output=True, timeout=60, check=False).returncode, 0)
        (folder / "7.json").unlink()
        self.assertEqual(subprocess.run([HIL_BENCH, "compare", "--history", folder], capture_output=True, timeout=60, check=False).returncode, 3)
        for wrong in ("-1", "nan", "x"):
            self.assertEqual(self.compare(drifted, drifted, "--tolerance", wrong).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
