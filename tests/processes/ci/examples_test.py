"""Runs the pipelines of docs/examples/ci as their CI systems would: examples_test.py BUILD SOURCE.

The shell lines of each step run in a folder that looks like a fresh checkout, but contains the finished
build. Five programs are replaced: apt-get; cmake; curl (its replacement reads GitLab's artifacts from a folder);
tests/setup/install.sh; tests/vcan/run.sh (its replacement uses the embedded bus, because other tests cover
tests/vcan). Between the steps, this test does what the CI systems do themselves (caches, artifacts).
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import yaml

BUILD, SOURCE = sys.argv[1:3]
EXAMPLES = f"{SOURCE}/docs/examples/ci"

STANDINS = {
    "bin/apt-get": "exit 0",
    "bin/cmake": 'case "$1" in --preset) grep -q "\\"name\\": \\"$2\\"" CMakePresets.json ;; --build) [ "$2" = build/default ] ;; *) exit 2 ;; esac',
    "bin/curl": 'out= url=; while [ $# -gt 0 ]; do case "$1" in --output) out=$2; shift ;; --header) shift ;; --*) ;; *) url=$1 ;; esac; shift; done\n'
                'name=$(basename "${url%%\\?*}"); [ -f "kept/$name" ] && cp "kept/$name" "$out"',
    "tests/setup/install.sh": "exit 0",
    "tests/vcan/run.sh": 'exec "${@/#vcan0/local:}"',
}


def github():
    with open(f"{EXAMPLES}/github.yml") as file:
        steps = yaml.safe_load(file)["jobs"]["bench"]["steps"]
    names = {"run", "uses"}
    assert all(names & set(step) for step in steps), "a step neither runs nor uses anything"
    return [step["run"] for step in steps if "run" in step]


def gitlab():
    with open(f"{EXAMPLES}/gitlab-ci.yml") as file:
        return yaml.safe_load(file)["bench"]["script"]


def jenkins():
    with open(f"{EXAMPLES}/Jenkinsfile") as file:
        text = file.read()
    assert text.count("{") == text.count("}"), "braces"
    return [long or short for long, short in re.findall(r"\bsh (?:'''(.*?)'''|'([^'\n]*)')", text, re.DOTALL)]


class Pipeline(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="canhil-ci-")
        self.addCleanup(folder.cleanup)
        self.here = folder.name
        for name in ("bench", "dbc", "docs", "CMakePresets.json"):
            os.symlink(f"{SOURCE}/{name}", f"{self.here}/{name}")
        os.mkdir(f"{self.here}/build")
        os.symlink(BUILD, f"{self.here}/build/default")
        for name, text in STANDINS.items():
            path = f"{self.here}/{name}"
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w") as file:
                file.write(f"#!/bin/bash\n{text}\n")
            os.chmod(path, 0o755)

    def run_steps(self, steps):
        """Runs the steps until one of them fails. Returns (output of all steps, exit code of the last one)."""
        environment = {**os.environ, "PATH": f"{self.here}/bin:/usr/bin:/bin", "CI_API_V4_URL": "x", "CI_PROJECT_ID": "1",
                       "CI_DEFAULT_BRANCH": "main", "CI_JOB_TOKEN": "x"}
        output = ""
        for step in steps:
            ended = subprocess.run(["bash", "-eo", "pipefail", "-c", step], cwd=self.here, env=environment, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            output += ended.stdout
            if ended.returncode != 0:
                return output, ended.returncode
        return output, 0

    def keep(self, change=None):
        """Stores the reports as the CI systems do after a run on the branch main: in the folders from which the next
        run reads the reports of the run before."""
        for folder in ("kept", "last_good"):
            os.makedirs(f"{self.here}/{folder}", exist_ok=True)
            for bus in ("local", "vcan"):
                with open(f"{self.here}/reports/{bus}.json") as file:
                    report = json.load(file)
                if change:
                    change(report)
                with open(f"{self.here}/{folder}/{bus}.json", "w") as file:
                    json.dump(report, file)

    def look_at(self, steps):
        output, code = self.run_steps(steps)
        self.assertEqual(code, 0, output)
        for bus in ("local", "vcan"):
            xml.etree.ElementTree.parse(f"{self.here}/reports/{bus}.xml")
            self.assertTrue(os.path.exists(f"{self.here}/reports/{bus}.html"))
        self.assertNotIn("no worse", output, "nothing to compare with yet")
        # A second run with equal results is 'no worse'. A run is worse if a check that passed in the earlier run fails.
        compare = [step for step in steps if "hil-bench compare" in step]
        self.assertEqual(len(compare), 1)
        self.keep()
        output, code = self.run_steps(compare)
        self.assertEqual((code, output.count("no worse")), (0, 2), output)
        path = f"{self.here}/reports/vcan.json"
        with open(path) as file:
            report = json.load(file)
        report["checks"][0]["outcome"] = "fail"
        with open(path, "w") as file:
            json.dump(report, file)
        output, code = self.run_steps(compare)
        self.assertEqual(code, 1, output)
        # A report of another scenario cannot be compared; this does not block a merge.
        self.keep(lambda report: report["provenance"].update(scenario_hash="0"))
        output, code = self.run_steps(compare)
        self.assertEqual(code, 0, output)
        self.assertIn("not comparable: the scenario differs", output)

    def test_github(self):
        steps = github()
        self.look_at([step for step in steps if "cp reports" not in step])
        shutil.rmtree(f"{self.here}/last_good")
        self.assertEqual(self.run_steps([step for step in steps if "cp reports" in step])[1], 0)
        self.assertEqual(sorted(os.listdir(f"{self.here}/last_good")), ["local.json", "vcan.json"])

    def test_gitlab(self):
        self.look_at(gitlab())

    def test_jenkins(self):
        self.look_at([step for step in jenkins()])

    def test_kubernetes(self):
        with open(f"{SOURCE}/docs/examples/kubernetes_job.yaml") as file:
            job = yaml.safe_load(file)["spec"]
        container = job["template"]["spec"]["containers"][0]
        words = " ".join(container["command"] + container["args"]).replace("$(JOB_COMPLETION_INDEX)", "0")
        self.assertIn(f"--shard 0/{job['completions']} ", words)
        words = words.replace("/campaign/campaign.toml", f"{SOURCE}/bench/monte_carlo/quick.toml").replace("/campaign/out", self.here)
        output, code = self.run_steps([f"build/default/{words} --runs 4"])
        self.assertEqual(code, 0, output)


unittest.main(argv=sys.argv[:1])
