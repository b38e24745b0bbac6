"""Comparisons of runs: what got worse."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Union

from canhil import program
from canhil.flights import Run

Runs = Union[Run, program.StrPath, Sequence[Union[Run, program.StrPath]]]


@dataclass(frozen=True)
class Difference:
    """A line of the comparison."""

    what: str
    """'worse', 'same', 'changed', 'differs', 'unknown' ... (docs/report.md, Comparing runs)."""
    text: str


@dataclass(frozen=True)
class Comparison:
    """What `hil-bench compare` found."""

    worse: bool | None
    """Whether something got worse; None: the runs cannot be compared, or not fully."""
    lines: list[Difference]


def _reports(runs: Runs) -> list[program.StrPath]:
    several = [runs] if isinstance(runs, (Run, str, os.PathLike)) else runs
    files: list[program.StrPath] = []
    for one in several:
        files.append(one.folder / "report.json" if isinstance(one, Run) else one)
    return files


def compare(before: Runs, after: Runs, *, tolerance_percent: float | None = None) -> Comparison:
    """Compares runs of one scenario before and after a change, one or several on each side.

    `before`, `after`: runs or JSON reports. `tolerance_percent`: the largest loss of a check's margin that is not
    worse. Raises Error if a file is not a report.

    >>> import canhil
    >>> run = canhil.run("bench/flights/los_quick.toml", bus="in-process")
    >>> canhil.compare(run, run).worse
    False
    """
    words: list[program.StrPath] = ["compare", "--before", *_reports(before), "--after", *_reports(after)]
    if tolerance_percent is not None:
        words += ["--tolerance", str(tolerance_percent)]
    code, text = program.call(*words)
    lines = [Difference(*line.split(maxsplit=1)) for line in text.splitlines() if len(line.split()) > 1]
    return Comparison({program.PASS: False, program.FAIL: True}.get(code), lines)
