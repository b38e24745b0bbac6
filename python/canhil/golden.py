"""Golden answers: what a target answered in some flights, kept to find the first answer that changes."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass

from canhil import program


@dataclass(frozen=True)
class Compared:
    """A flight compared with its golden answers."""

    scenario: str
    same: bool
    frames: int
    """How many frames were compared."""
    difference: str = ""
    """The first answer that differs; empty: none does."""


def record(
    folder: program.StrPath, scenarios: Sequence[program.StrPath], *, target: program.Target | None = None
) -> None:
    """Flies scenarios in lockstep and keeps every frame in a folder. Raises Error, for example if it has them already."""
    program.call("golden", "record", *_target(target), folder, *scenarios, codes=[program.PASS])


def check(folder: program.StrPath, *, target: program.Target | None = None, tolerance: int = 0) -> list[Compared]:
    """Flies the kept scenarios again and compares the target's frames.

    `tolerance`: by how many steps of its resolution a signal may differ.
    """
    words = [*_target(target), "--tolerance", str(tolerance), "--json", "-"]
    return [
        Compared(one["scenario"], one["outcome"] == "pass", one["frames"], one.get("difference", ""))
        for one in json.loads(program.call("golden", "check", folder, *words)[1])
    ]


def _target(target: program.Target | None) -> list[str]:
    return [] if target is None else ["--target", program.command_of(target)]
