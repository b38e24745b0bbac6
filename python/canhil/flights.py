"""One run of a scenario, and its results."""

from __future__ import annotations

import difflib
import json
import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, Union

from canhil import program
from canhil.errors import Error
from canhil.report import Answers, Flag, Json, Judgement, Latency, Verdict, flag_of, judgement_of, latency_of
from canhil.table import Series, Table
from canhil.toml_text import Value, toml_tables, toml_value

Faults = Union[program.StrPath, Mapping[str, Value], Sequence[Mapping[str, Value]]]
PAGE = "report.html"
FAULTS = "faults.toml"
"""The file of the argument `faults` in the folder of a run."""


def _unknown(what: str, name: str, known: Sequence[str], all_of_them: str) -> str:
    near = [one for one in known if one.startswith(name + ".")] or difflib.get_close_matches(name, known, 5, 0.5)
    return f"no {what} '{name}', expected one of {f'{near}; {all_of_them} has all' if near else all_of_them}"


class Run:
    """The results of a run. They stay until the object is gone, or in `folder` if one was given."""

    def __init__(self, folder: Path, owner: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self.folder = folder
        """Where report.json, report.xml (JUnit), values.csv and frames.log are."""
        self._owner = owner  # removes the folder when this object is gone
        self._table = Table(folder / "values.csv")

    def __repr__(self) -> str:
        return f"<Run of {self.title!r}: {self.reason if self.verdict is not Verdict.PASS else self.verdict}>"

    @cached_property
    def document(self) -> Json:
        """The whole JSON report (docs/report.md describes its keys)."""
        report: Json = json.loads((self.folder / "report.json").read_bytes())
        return report

    @property
    def title(self) -> str:
        """The title of the scenario."""
        return str(self.document["title"])

    @property
    def verdict(self) -> Verdict:
        """The outcome of the run."""
        return Verdict(self.document["verdict"])

    @property
    def reason(self) -> str:
        """The reason of the verdict, in words."""
        return f"{self.document['verdict']}: {self.document['reason']}"

    @cached_property
    def judgements(self) -> list[Judgement]:
        """What the bench found for each check."""
        return [judgement_of(check) for check in self.document["checks"]]

    @property
    def failures(self) -> list[Judgement]:
        """The checks that failed."""
        return [one for one in self.judgements if one.outcome is Verdict.FAIL]

    def judgement(self, name: str) -> Judgement:
        """The check with this name; without one, the only check of this kind. KeyError: there is none."""
        named = [one for one in self.judgements if one.name == name]
        found = named or [one for one in self.judgements if one.kind == name]
        if len(found) != 1:
            raise KeyError(_unknown("single check", name, [one.name for one in self.judgements], "run.judgements"))
        return found[0]

    @property
    def quantities(self) -> list[str]:
        """The names of the quantities that series() knows."""
        return list(dict.fromkeys(name for _, name in self._table.all()))

    def series(self, name: str, *, estimator: str | None = None) -> Series:
        """A quantity over the run, such as "attitude.heading". KeyError: the target did not report it.

        `estimator`: needed if several estimators report the quantity. "plant": an output of what the target steers.
        """
        found = [
            one
            for (owner, quantity), one in self._table.all().items()
            if quantity == name and estimator in (None, owner)
        ]
        if not found:
            raise KeyError(_unknown("quantity", name, self.quantities, "run.quantities"))
        if len(found) > 1:
            found = [one for one in found if one.estimator != "plant"]
        if len(found) > 1:
            raise KeyError(f"'{name}' is of {[one.estimator for one in found]}, expected `estimator` too")
        return found[0]

    @cached_property
    def answers(self) -> dict[str, Answers]:
        """By the last message of each kind of answer: how many were due, and how many came."""
        return {name: Answers(**one) for name, one in self.document.get("answers", {}).items()}

    @cached_property
    def latencies(self) -> dict[str, Latency]:
        """By message; empty in virtual time without simulated frame times."""
        return {name: latency_of(one) for name, one in self.document.get("latency_s", {}).items()}

    @cached_property
    def flags(self) -> list[Flag]:
        """The flags that the target reported."""
        return [flag_of(one) for one in self.document["flags"]]

    @property
    def results(self) -> Json:
        """By estimator and kind of result: the figures of the report, such as the errors at the end."""
        figures: Json = self.document.get("results", {})
        return figures

    @property
    def duration_s(self) -> float:
        """The length of the run in the scenario's time."""
        return float(self.document["duration_s"])

    @property
    def wall_s(self) -> float:
        """How long the run took."""
        return float(self.document["wall_s"])

    @property
    def log(self) -> Path | None:
        """Every frame of the run, as candump writes it; None: frames of this bus cannot be logged."""
        path = self.folder / "frames.log"
        return path if path.exists() else None

    def report(self, path: program.StrPath) -> Path:
        """Writes the report to a file; its ending decides: .html, .json, .xml (JUnit), .csv or .log."""
        to = Path(path)
        files = {".json": "report.json", ".xml": "report.xml", ".csv": "values.csv", ".log": "frames.log"}
        if to.suffix == ".html":
            shutil.copyfile(self._page(), to)
        elif to.suffix in files:
            shutil.copyfile(self.folder / files[to.suffix], to)
        else:
            raise ValueError(f"{to}: ends in '{to.suffix}', expected one of {['.html', *files]}")
        return to

    def keep(self, folder: program.StrPath) -> Path:
        """Copies all files of the run, and the page, to a folder, which may exist."""
        to = Path(folder)
        self._page()
        shutil.copytree(self.folder, to, dirs_exist_ok=True)
        return to

    def _page(self) -> Path:
        page = self.folder / PAGE
        if not page.exists():
            program.call("report", self.folder / "report.json")
        return page


def settings_of(settings: Mapping[str, Value]) -> list[str]:
    """The words of a command line that set keys of a scenario."""
    if not isinstance(settings, Mapping):
        raise TypeError(f"set={settings!r}: expected a dict of keys and values")
    return [word for key, value in settings.items() for word in ("--set", f"{key}={toml_value(value)}")]


def run(
    scenario: program.StrPath,
    *,
    bus: str | None = None,
    target: program.Target | None = None,
    set: Mapping[str, Value] | None = None,
    faults: Faults = (),
    lockstep: bool = False,
    realtime: bool = False,
    seed: int | None = None,
    page: bool = False,
    folder: program.StrPath | None = None,
    options: Sequence[str] = (),
) -> Run:
    """Flies a scenario and judges it, as `hil-bench run` does.

    `bus`, `target`, `lockstep`, `realtime`, `seed`: the options of `hil-bench run` with these names.
    `set`: keys of the scenario with other values, such as ``{"slave_imu.period_ms": 5}``; a dict of dicts works
    too. `faults`: tables [[fault]] in addition to those of the scenario, one or several; or a file of them. `page`: writes
    the page at once, which then has the frames around the worst values. `folder`: where the files of the run
    stay; it must not hold those of another run. `options`: further words of the command line.

    Raises Error if the bench refuses something or cannot fly. A run that fails is no error: see Run.verdict.

    >>> import canhil
    >>> run = canhil.run("bench/flights/los_quick.toml", bus="in-process",
    ...                  faults=[{"name": "spike", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4,
    ...                           "from_s": 3.0, "to_s": 3.2}])
    >>> run.verdict, run.failures[0].quantity
    (<Verdict.FAIL: 'fail'>, 'los.rate')
    """
    __tracebackhide__ = True  # pytest then shows the line of the test
    command = command_of_run(
        scenario, bus=bus, target=target, set=set, faults=faults, lockstep=lockstep, realtime=realtime, seed=seed,
        page=page, folder=folder, options=options,
    )
    try:
        program.call(*command.words)
    except Error as error:
        raise command.explained(error) from None
    return command.run()


class Command(NamedTuple):
    """The command line of a run, and the folder of its files."""

    words: list[program.StrPath]
    folder: Path
    owner: tempfile.TemporaryDirectory[str] | None

    def explained(self, error: Error) -> Error:
        """An error in the argument `faults`: it names no file, because the caller wrote none."""
        if error.file != self.folder / FAULTS:
            return error
        lines = (line.removeprefix(str(error.file)).partition(": ")[2] for line in str(error).splitlines())
        return Error("\n".join(f"faults: {line}" for line in lines), key=error.key)

    def run(self) -> Run:
        """The run, after the command has ended."""
        if not (self.folder / "report.json").exists():
            raise Error("the run was interrupted before it began")
        return Run(self.folder, self.owner)


def command_of_run(
    scenario: program.StrPath,
    *,
    bus: str | None = None,
    target: program.Target | None = None,
    set: Mapping[str, Value] | None = None,
    faults: Faults = (),
    lockstep: bool = False,
    realtime: bool = False,
    seed: int | None = None,
    page: bool = False,
    folder: program.StrPath | None = None,
    options: Sequence[str] = (),
) -> Command:
    """The command line of run()."""
    if Path(scenario).is_dir():
        raise Error(f"{scenario}: is a folder, expected the file of one scenario", file=Path(scenario))
    owner = None
    if folder is None:
        owner = tempfile.TemporaryDirectory(prefix="canhil-")
        place = Path(owner.name)
    else:
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        if (place / "report.json").exists():
            raise Error(f"{place}: holds another run already, expected a new folder", file=place)
    words: list[program.StrPath] = ["run", scenario, "--json", place / "report.json", "--junit", place / "report.xml"]
    words += ["--csv", place / "values.csv"]
    if bus is None or "unrounded" not in bus:  # a log has no room for frames that round nothing
        words += ["--log", place / "frames.log"]
    if bus is not None:
        words += ["--bus", bus]
    if target is not None:
        words += ["--target", program.command_of(target)]
    words += settings_of(set or {})
    if isinstance(faults, (str, os.PathLike)):
        words += ["--faults", faults]
    elif faults:
        tables: Any = [faults] if isinstance(faults, Mapping) else faults
        if not all(isinstance(one, Mapping) for one in tables):
            raise TypeError(f"faults={faults!r}: expected a list of dicts, or a file")
        (place / FAULTS).write_text(toml_tables("fault", tables), encoding="utf-8")
        words += ["--faults", place / FAULTS]
    words += ["--lockstep"] * lockstep + ["--realtime"] * realtime
    if seed is not None:
        words += ["--seed", str(seed)]
    if page:
        words += ["--html", place / PAGE]
    return Command([*words, *options], place, owner)
