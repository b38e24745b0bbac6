"""Acceptance: what a target must do, requirement by requirement."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

from canhil import program
from canhil.report import Json, Verdict


@dataclass(frozen=True)
class Requirement:
    """A requirement and whether the target meets it."""

    suite: str
    id: str
    outcome: str
    """'pass', 'fail', 'not measured' or 'not reached'."""
    raw: Json
    """All keys of the requirement."""


class Acceptance:
    """The results of an acceptance."""

    def __init__(self, document: Json) -> None:
        self.document = document
        """The JSON of `hil-bench accept`."""

    def __repr__(self) -> str:
        return f"<Acceptance: {self.verdict}>"

    @property
    def verdict(self) -> Verdict:
        """Whether the target meets all requirements."""
        return Verdict(self.document["outcome"])

    @property
    def requirements(self) -> list[Requirement]:
        """The requirements of all suites."""
        return [
            Requirement(suite["estimator"], one["id"], one["outcome"], one)
            for suite in self.document["suites"]
            for one in suite["requirements"]
        ]


def accept(
    target: program.Target | None = None,
    *,
    estimators: Sequence[str] = (),
    suites: program.StrPath | None = None,
    families: Sequence[str] = (),
    first_failure: bool = False,
    seed: int | None = None,
) -> Acceptance:
    """Tests whether a target meets the requirements of its estimators, as `hil-bench accept` does.

    `estimators`, `families`: only these; empty: all. `suites`: a folder of suites in place of the project's.
    Raises Error if the bench refuses something.
    """
    words: list[program.StrPath] = ["accept", "--json", "-"]
    if target is not None:
        words += ["--target", program.command_of(target)]
    for option, texts in (("--estimator", estimators), ("--family", families)):
        for text in texts:
            words += [option, text]
    if suites is not None:
        words += ["--suites", suites]
    if seed is not None:
        words += ["--seed", str(seed)]
    return Acceptance(json.loads(program.call(*words, *["--first-failure"] * first_failure)[1]))
