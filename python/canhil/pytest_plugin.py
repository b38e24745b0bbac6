"""pytest: a scenario is a test, and tests fly scenarios (docs/python.md)."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Generator, Iterable, Sequence
from pathlib import Path
from typing import Any

import pytest

from canhil.errors import Error
from canhil.flights import Run, run
from canhil.report import Judgement, Verdict

_RUNS: pytest.StashKey[list[Run]] = pytest.StashKey[list[Run]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options; each can be in the ini file too, so that a project has its bench in one place."""
    group = parser.getgroup("canhil", "scenarios of hil-bench")

    def add(name: str, help_text: str, default: str | None, **more: Any) -> None:
        group.addoption(f"--canhil-{name}", help=f"{help_text} (ini: canhil_{name.replace('-', '_')})", **more)
        parser.addini(f"canhil_{name.replace('-', '_')}", help_text, default=default)

    add("bus", "bus of the runs, as `hil-bench run --bus` takes it", None, metavar="BUS")
    add("target", "command of the target: 'python3 mine.py --gain 3'", None, metavar="COMMAND")
    add("not-measured", "what a verdict 'not measured' is", "skip", choices=["skip", "fail"])
    add("artefacts", "folder for the files of failed runs", "canhil-artefacts", metavar="FOLDER")


def _option(config: pytest.Config, name: str) -> str | None:
    value = config.getoption(f"--canhil-{name}") or config.getini(f"canhil_{name.replace('-', '_')}")
    return str(value) if value else None


def pytest_configure(config: pytest.Config) -> None:
    """Makes the marker known."""
    config.addinivalue_line("markers", "requirement(id, ...): ids of the requirements that the test verifies")
    not_measured = _option(config, "not-measured")
    if not_measured not in ("skip", "fail"):
        raise pytest.UsageError(f"canhil_not_measured = {not_measured}: expected skip or fail")


def _runs_of(item: pytest.Item) -> list[Run]:
    if _RUNS not in item.stash:
        runs: list[Run] = []
        item.stash[_RUNS] = runs
    return item.stash[_RUNS]


def explain(run: Run) -> str:
    """The verdict of a run and the checks that did not pass, a line for each."""

    def line(one: Judgement) -> str:
        named = f"{one.name} [{one.requirement}]" if one.requirement else one.name
        return f"  {one.outcome.value.upper():<12}  {named}: {one.measured}  (expected {one.expected})"

    open_checks = [one for one in run.judgements if not one]
    return "\n".join([f"{run.title}: {run.reason}", *map(line, open_checks)])


class Bench:
    """Flies scenarios with the bus and the target of the command line. What `canhil.run` takes, `run` takes too."""

    def __init__(self, item: pytest.Item) -> None:
        self._item = item
        self._runs = _runs_of(item)
        self._fails = _option(item.config, "not-measured") == "fail"

    def run(self, scenario: str | Path, **options: Any) -> Run:
        """Flies a scenario. Its files are kept if the test fails. Relative paths are relative to the test's folder."""
        for name in ("bus", "target"):
            options.setdefault(name, _option(self._item.config, name))
        flown = run(self._item.path.parent / scenario, **options)
        self._runs.append(flown)
        return flown

    def check(self, flown: Run) -> None:
        """Fails or skips the test if the run did not pass."""
        ids = dict.fromkeys(one.requirement for one in flown.judgements if one.requirement)
        self._item.user_properties += [("requirement", one) for one in ids]
        if flown.verdict is Verdict.NOT_MEASURED and not self._fails:
            pytest.skip(flown.reason)
        if flown.verdict is not Verdict.PASS:
            pytest.fail(explain(flown), pytrace=False)


class ScenarioFile(pytest.File):
    """A TOML file that is a scenario."""

    def collect(self) -> Iterable[pytest.Item]:
        """One test: the scenario flies."""
        yield ScenarioItem.from_parent(self, name="scenario")


class ScenarioItem(pytest.Item):
    """A scenario as a test."""

    def runtest(self) -> None:
        """Flies the scenario."""
        bench = Bench(self)
        bench.check(bench.run(self.path))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """What the bench says, without a traceback of this plugin."""
        if isinstance(excinfo.value, Error):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where the test is."""
        return self.path, None, self.path.stem


def is_scenario(path: Path) -> bool:
    """Whether `hil-bench run FOLDER` would fly this file of the folder: a TOML file with the key duration_s."""
    if path.suffix != ".toml":
        return False
    try:
        return "duration_s" in tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return False


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> ScenarioFile | None:
    """Scenarios among the collected files."""
    return ScenarioFile.from_parent(parent, path=file_path) if is_scenario(file_path) else None


def pytest_collection_modifyitems(items: Sequence[pytest.Item]) -> None:
    """The ids of the marker `requirement` become properties of the test in JUnit."""
    for item in items:
        for marker in item.iter_markers("requirement"):
            item.user_properties += [("requirement", one) for one in marker.args]


@pytest.fixture
def bench(request: pytest.FixtureRequest) -> Bench:
    """Flies scenarios with the bus and the target of the command line, and keeps the files of failed tests."""
    return Bench(request.node)


@pytest.fixture
def bus(request: pytest.FixtureRequest) -> str | None:
    """The value of --canhil-bus; None: not given."""
    return _option(request.config, "bus")


@pytest.fixture
def target(request: pytest.FixtureRequest) -> str | None:
    """The value of --canhil-target; None: not given."""
    return _option(request.config, "target")


@pytest.hookimpl(hookwrapper=True)  # type: ignore[misc]  # pytest types this decorator only from version 7.3 on
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Generator[None, Any, None]:
    """Keeps the files and the page of the runs of a failed test, and names their folders in the report."""
    outcome = yield
    report = outcome.get_result()
    if report.when != "call":
        return
    runs = _runs_of(item)
    if report.failed:
        root = item.config.rootpath / (_option(item.config, "artefacts") or "")
        name = re.sub(r"[^\w.-]+", "-", item.nodeid).strip("-")
        for number, flown in enumerate(runs):
            folder = root / (name if len(runs) == 1 else f"{name}-{number + 1}")
            report.sections.append(("hil-bench", f"{flown.title}: {flown.keep(folder) / 'report.html'}"))
    runs.clear()  # removes the files of the runs
