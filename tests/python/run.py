"""Tests the Python package against a built bench. Usage: run.py CASE BUILD SOURCE, with a case of CASES."""

import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

CASE, BUILD, SOURCE = sys.argv[1], *map(Path, sys.argv[2:4])
HERE = Path(__file__).resolve().parent
PACKAGE = SOURCE / "python"
LEAST_COVERED_PERCENT = 95
LARGEST_OVERHEAD = 0.2  # of the time of the command
LARGEST_STEP = 6  # echoes; 1.4 to 1.5 on an idle machine
ENVIRONMENT = os.environ | {
    "PATH": f"{BUILD}:/usr/bin:/bin",
    "PYTHONPATH": str(PACKAGE),
    "PYTHONDONTWRITEBYTECODE": "1",
    "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",  # other plugins of the machine
    "LC_ALL": "C.UTF-8",
}
PLUGIN = ["-p", "canhil.pytest_plugin", "-p", "no:cacheprovider"]


def call(*words: object, cwd: Path = SOURCE, **environment: str) -> str:
    ended = subprocess.run(
        [str(word) for word in words], cwd=cwd, env=ENVIRONMENT | environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    if ended.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: exit code {ended.returncode}\n{ended.stdout}")
    return ended.stdout


def package(scratch: Path) -> None:
    """The tests and the examples in the docstrings; they cover the package."""
    file = {"COVERAGE_FILE": str(scratch / "coverage")}
    coverage = [sys.executable, "-m", "coverage"]
    tests = ["-m", "pytest", *PLUGIN, "-p", "pytester", "-q", "--doctest-modules", "--basetemp", scratch / "tests"]
    print(call(*coverage, "run", f"--source={PACKAGE}/canhil", *tests, "--rootdir", HERE,
               *sorted(HERE.glob("*_test.py")), PACKAGE / "canhil", **file))
    print(call(*coverage, "report", "--show-missing", f"--fail-under={LEAST_COVERED_PERCENT}", **file))


def types(scratch: Path) -> None:
    """mypy strict and flake8."""
    print(call("/usr/bin/mypy", f"--cache-dir={scratch}", "canhil", cwd=PACKAGE))
    example = SOURCE / "docs/examples/python"
    print(call("/usr/bin/flake8", "--max-line-length=140", "canhil", "setup.py", *example.glob("*.py"), cwd=PACKAGE))


def pip(scratch: Path) -> None:
    """pip installs the package from a copy of the source tree, and pytest loads the plugin by itself."""
    copy = scratch / "source"
    call("/usr/bin/cp", "-r", "--parents", "python", "CMakeLists.txt", scratch)  # pip leaves files in the tree
    python = scratch / "venv/bin/python"
    call(sys.executable, "-m", "venv", "--system-site-packages", scratch / "venv")
    call(python, "-m", "pip", "install", "--no-index", "--no-build-isolation", scratch / "python", PYTHONPATH="")
    copy.mkdir()
    (copy / "los_quick.toml").write_bytes((SOURCE / "bench/flights/los_quick.toml").read_bytes())
    environment = {name: value for name, value in ENVIRONMENT.items() if name not in ("PYTHONPATH", "PYTEST_DISABLE_PLUGIN_AUTOLOAD")}
    words = [python, "-m", "pytest", "-q", "-n", "2", "--canhil-bus", "in-process", "."]
    ended = subprocess.run(words, cwd=copy, env=environment, capture_output=True, text=True)
    assert "1 skipped" in ended.stdout, ended.stdout + ended.stderr
    version = re.search(r"project\(canhil VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())
    shown = subprocess.run([python, "-c", "import importlib.metadata as m; print(m.version('canhil'))"], env=environment, capture_output=True, text=True)
    assert version and shown.stdout.strip() == version[1], shown.stdout


def overhead(scratch: Path) -> None:
    """A run by the package takes little longer than the same command: medians, because other programs disturb single runs."""
    sys.path.insert(0, str(PACKAGE))
    os.environ.update(ENVIRONMENT)
    import canhil

    scenario = SOURCE / "bench/flights/los_quick.toml"
    files = [("--json", "r.json"), ("--junit", "r.xml"), ("--csv", "r.csv"), ("--log", "r.log")]
    words = ["hil-bench", "run", str(scenario), "--bus", "in-process"]
    words += [word for option, name in files for word in (option, str(scratch / name))]
    by_command, by_package = [], []
    for _ in range(11):
        start = time.perf_counter()
        subprocess.run(words, capture_output=True, check=False)
        by_command.append(time.perf_counter() - start)
        start = time.perf_counter()
        assert canhil.run(scenario, bus="in-process").verdict is canhil.Verdict.NOT_MEASURED
        by_package.append(time.perf_counter() - start)
    command_s = statistics.median(by_command)
    more_s = statistics.median(by_package) - command_s
    print(f"{1e3 * command_s:.1f} ms by the command, {1e3 * more_s:.1f} ms more by the package")
    assert more_s < LARGEST_OVERHEAD * command_s, f"{more_s:.3f} s more than {command_s:.3f} s, expected less than {LARGEST_OVERHEAD:.0%} of it"
    # On one CPU, as a wake-up on another one may cost ten times as much, for the echo too.
    cpus = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cpus)})
    step_s, echo_s = step_of_node(scratch, scenario), step_of_echo(scratch)
    os.sched_setaffinity(0, cpus)
    print(f"a step of a node in Python {1e6 * step_s:.1f} us, an echo in Python {1e6 * echo_s:.1f} us")
    assert step_s < LARGEST_STEP * echo_s, f"{step_s / echo_s:.1f} echoes, expected less than {LARGEST_STEP}"


def step_of_node(scratch: Path, scenario: Path) -> float:
    """What a step of a node costs in virtual time: the same run with the node asked often and seldom."""
    path = scratch / "node.py"
    path.write_text(f"import sys\nsys.path.append({str(PACKAGE / 'canhil')!r})\nimport partner\n\n"
                    "class Node:\n    def __init__(self, period): self.period = period\n    def step(self, bench): pass\n\npartner.serve(Node)\n")
    medians = []
    for period_s in (0.001, 1):
        file = scratch / f"every_{period_s}.toml"
        file.write_text(scenario.read_text() + f'\n[[node]]\nname = "node"\ncommand = "{sys.executable} {path}"\nparameters = {{period = {period_s}}}\n')
        taken = []
        for _ in range(7):
            start = time.perf_counter()
            subprocess.run(["hil-bench", "run", str(file), "--bus", "in-process"], capture_output=True, check=False)
            taken.append(time.perf_counter() - start)
        medians.append(statistics.median(taken))
    return (medians[0] - medians[1]) / 6000


def step_of_echo(scratch: Path) -> float:
    """A line to a Python program, and one back."""
    path = scratch / "echo.py"
    path.write_text("import sys\nfor line in sys.stdin:\n    sys.stdout.write('done\\n')\n    sys.stdout.flush()\n")
    with subprocess.Popen([sys.executable, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as echo:
        assert echo.stdin and echo.stdout
        taken = []
        for _ in range(6000):
            start = time.perf_counter()
            echo.stdin.write(b"step 0 1000\n")
            echo.stdin.flush()
            echo.stdout.readline()
            taken.append(time.perf_counter() - start)
        echo.stdin.close()
    return statistics.median(taken)


def page(scratch: Path) -> None:
    """The examples of docs/python.md do what the page says, and draw its pictures."""
    print(call(sys.executable, HERE / "page.py", BUILD))


CASES = {"Package": package, "Types": types, "Pip": pip, "Overhead": overhead, "Page": page}
with tempfile.TemporaryDirectory(prefix="canhil-python-") as folder:
    CASES[CASE](Path(folder))
