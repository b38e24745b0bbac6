"""Campaigns: variants of scenarios, run many times."""

from __future__ import annotations

import csv
import json
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

from canhil import program
from canhil.report import Json, Verdict


@dataclass(frozen=True)
class Answer:
    """What a metric of a campaign found for one variant."""

    metric: str
    variant: str
    measured: str
    met: bool | None
    """Whether the limits are met; None: the metric has none, or could not be judged."""
    raw: Json
    """All keys of the answer: curves, statistics, limits."""


class Campaign:
    """The results of a campaign: a file with all samples, and the answers of its metrics."""

    def __init__(self, results: Path, owner: tempfile.TemporaryDirectory[str] | None = None) -> None:
        self.results = results
        """The SQLite file of the results."""
        self._owner = owner
        self.document: Json = json.loads(program.call("campaign", "report", results, "--json", "-")[1])
        """The JSON of `hil-bench campaign report`."""

    def __repr__(self) -> str:
        return f"<Campaign {self.document['title']!r}: {self.verdict}>"

    @property
    def verdict(self) -> Verdict:
        """Whether all limits are met."""
        return Verdict(self.document["outcome"])

    @property
    def variants(self) -> list[str]:
        """The names of the variants."""
        return [str(one["name"]) for one in self.document["variants"]]

    @property
    def answers(self) -> list[Answer]:
        """What the metrics found, for each variant."""
        return [_answer_of(one) for one in self.document["answers"]]

    def samples(self) -> Iterator[dict[str, Any]]:
        """Every sample: variant, run, t_s, quantity, unit and value, in SI units and rad."""
        rows = csv.DictReader(StringIO(program.call("campaign", "export", self.results)[1]))
        for row in rows:
            yield {**row, "run": int(row["run"]), "t_s": float(row["t_s"]), "value": float(row["value"])}


def _answer_of(answer: Json) -> Answer:
    outcome = answer.get("outcome")
    met = None if outcome not in ("pass", "fail") else outcome == "pass"
    return Answer(answer["metric"], answer.get("variant", ""), answer["measured"], met, answer)


def campaign(
    file: program.StrPath,
    *,
    target: program.Target | None = None,
    runs: int | None = None,
    threads: int | None = None,
    results: program.StrPath | None = None,
    resume: bool = False,
) -> Campaign:
    """Runs a campaign, as `hil-bench campaign FILE` does, and judges it.

    `results`: where the SQLite file stays; None: it is removed with the returned object. `target`: a program to
    fly against; None: the target's own code in process. Raises Error if the bench refuses something.

    >>> import canhil
    >>> quick = canhil.campaign("bench/monte_carlo/quick.toml", runs=2, threads=1)
    >>> len(quick.variants), next(quick.samples())["unit"]
    (4, 'rad')
    """
    owner = None
    if results is None:
        owner = tempfile.TemporaryDirectory(prefix="canhil-")
        results = Path(owner.name) / "results.sqlite"
    words: list[program.StrPath] = ["campaign", file, "--out", results]
    for option, number in (("--runs", runs), ("--threads", threads)):
        if number is not None:
            words += [option, str(number)]
    if target is not None:
        words += ["--target", program.command_of(target)]
    program.call(*words, *["--resume"] * resume)
    return Campaign(Path(results), owner)
