"""Asks hil-bench accept about a target, for programs that ask about many."""

import json
import os
import signal
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/default"
BENCH = BUILD / "hil-bench"
PYTHON = "/usr/bin/python3"  # Debian's, which has numpy
LONGEST_S = 900  # time limit of one call of hil-bench accept

# Families of requirements in three stages. The fastest requirements come first. Those about timing come last and run alone.
SINGLE_FLIGHTS = ("algorithms", "parameters", "flags and states", "protocol")
CAMPAIGNS = ("errors", "honesty")
TIMES = ("timing",)


def run(command, longest_s=None, **more):
    """Runs a command and, at its end or at the time limit, kills all its processes. Returns (exit code, output); exit code None: time limit
    exceeded."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", start_new_session=True, **more)
    try:
        output = process.communicate(timeout=longest_s)[0]
        return process.returncode, output
    except subprocess.TimeoutExpired:
        return None, ""
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()


def accept(target, estimator, families, question=(), bench=BENCH, longest_s=LONGEST_S):
    """Flies the requirements of some families of one suite until the target violates one. Returns (exit code, (requirement, observation) or None);
    exit code 3: no requirement is violated, and one was not measured."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        wanted = [word for family in families for word in ("--family", family)]
        code, output = run([str(bench), "accept", *question, "--first-failure", "--target", str(target), "--json", str(report), "--estimator", estimator,
                            *wanted], longest_s, cwd=ROOT)
        if code is None:
            return 1, ("no end", f"not within {longest_s} s")
        if code in (0, 3):
            return code, None
        if not report.exists():
            return code, ("no report", f"exit code {code}: {(output.strip().splitlines() or ['no output'])[-1]}")
        return code, first_failure(json.loads(report.read_text())) or ("no requirement", f"exit code {code}")


def first_failure(report):
    """(requirement, observation) of the first item of a report of accept that failed."""
    for suite in report["suites"]:
        for requirement in suite["requirements"]:
            for item in requirement["items"]:
                if item["outcome"] == "fail":
                    return requirement["id"], f"{item['name']}: {item['measured']}"
    return None
