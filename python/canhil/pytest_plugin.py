"""pytest: a scenario is a test, and tests fly scenarios (docs/python.md)."""

from __future__ import annotations

import re
import shutil
import tomllib
from collections.abc import Generator, Iterable, Sequence
from pathlib import Path
from typing import Any

import pytest

from canhil.errors import Error
from canhil.flights import PAGE, Run, run
from canhil.report import Judgement, Verdict

_RUNS: pytest.StashKey[list[Run]] = pytest.StashKey[list[Run]]()
_NOT_MEASURED: pytest.StashKey[str] = pytest.StashKey[str]()
_SCENARIO_KEYS = ("duration_s", "truth", "target")


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
        __tracebackhide__ = True  # pytest then shows the line of the test
        for name in ("bus", "target"):
            options.setdefault(name, _option(self._item.config, name))
        options.setdefault("page", True)  # for the frames around the worst values, if the test fails
        flown = run(self._item.path.parent / scenario, **options)
        self._runs.append(flown)
        return flown

    def check(self, flown: Run) -> None:
        """Fails the test if the run failed. After a run that was not measured, a test that passes counts as skipped."""
        __tracebackhide__ = True
        if not isinstance(flown, Run):
            raise TypeError(f"bench.check({flown!r}): expected what bench.run returned")
        _add_requirements(self._item, (one.requirement for one in flown.judgements if one.requirement))
        if flown.verdict is Verdict.NOT_MEASURED and not self._fails:
            self._item.stash[_NOT_MEASURED] = flown.reason
        elif flown.verdict is not Verdict.PASS:
            pytest.fail(explain(flown), pytrace=False)


class ScenarioFile(pytest.File):
    """A TOML file that is a scenario."""

    def collect(self) -> Iterable[pytest.Item]:
        """One test: the scenario flies. The ids of the requirements of its checks are its markers."""
        item = ScenarioItem.from_parent(self, name="scenario")
        checks = (_tables(self.path) or {}).get("check")
        for one in checks if isinstance(checks, list) else []:
            if isinstance(one, dict) and isinstance(one.get("requirement"), str):
                item.add_marker(pytest.mark.requirement(one["requirement"]))
        yield item


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


def _tables(path: Path) -> dict[str, Any] | None:
    """The content of a TOML file; None: it is none."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError):
        return None


def is_scenario(path: Path) -> bool:
    """Whether a file is meant as a scenario. One that is wrong counts too: its test says so, and does not disappear."""
    if path.suffix != ".toml":
        return False
    tables = _tables(path)
    if tables is not None:
        return "duration_s" in tables or ("variant" not in tables and any(key in tables for key in _SCENARIO_KEYS))
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    return re.search(rf"^\s*\[*({'|'.join(_SCENARIO_KEYS)})\b", text, re.MULTILINE) is not None


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> ScenarioFile | None:
    """Scenarios among the collected files, and every TOML file that the command line names."""
    named = file_path.suffix == ".toml" and parent.session.isinitpath(file_path)
    return ScenarioFile.from_parent(parent, path=file_path) if named or is_scenario(file_path) else None


def _add_requirements(item: pytest.Item, ids: Iterable[str]) -> None:
    for one in dict.fromkeys(ids):
        if ("requirement", one) not in item.user_properties:
            item.user_properties.append(("requirement", one))


def pytest_collection_modifyitems(items: Sequence[pytest.Item]) -> None:
    """The ids of the marker `requirement` become properties of the test in JUnit."""
    for item in items:
        _add_requirements(item, (one for marker in item.iter_markers("requirement") for one in marker.args))


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
    folder = item.config.rootpath / (_option(item.config, "artefacts") or "") / re.sub(r"[^\w.-]+", "-", item.nodeid).strip("-")
    if runs and folder.is_dir():
        shutil.rmtree(folder)  # of an earlier failure of this test
    if report.failed:
        for number, flown in enumerate(runs, 1):
            page = flown.keep(folder if len(runs) == 1 else folder / str(number)) / PAGE
            report.sections.append(("hil-bench", f"{flown.title}: {flown.reason}\n{page}"))
    elif report.passed and _NOT_MEASURED in item.stash:
        report.outcome = "skipped"
        report.longrepr = (str(item.path), (item.location[1] or 0) + 1, f"Skipped: {item.stash[_NOT_MEASURED]}")
    runs.clear()  # removes the files of the runs
