"""Starts the programs of the bench."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Union

from canhil.errors import Error, error_of

StrPath = Union[str, "os.PathLike[str]"]
Target = Union[str, Sequence[str]]
"""The command of a target: one text as for a shell, or a list of words."""

PASS, FAIL, USAGE, NOT_MEASURED = range(4)
"""The exit codes of the bench."""


def bench_program() -> Path:
    """The program hil-bench: the value of the environment variable CANHIL_BENCH, or the one in PATH."""
    named = os.environ.get("CANHIL_BENCH")
    if named:
        if not (os.path.isfile(named) and os.access(named, os.X_OK)):
            raise Error(f"CANHIL_BENCH: '{named}' is not a program, expected hil-bench")
        return Path(named)
    found = shutil.which("hil-bench")
    if found is None:
        raise Error("hil-bench is not in PATH, expected it there or its path in CANHIL_BENCH")
    return Path(found)


def command_of(target: Target) -> str:
    """The command of a target as one word of a command line."""
    return target if isinstance(target, str) else shlex.join(target)


def call(*words: StrPath, codes: Iterable[int] = (PASS, FAIL, NOT_MEASURED)) -> tuple[int, str]:
    """Runs hil-bench to its end. Returns its exit code and its standard output; other codes raise Error."""
    __tracebackhide__ = True  # pytest then shows the line of the test
    process = subprocess.run(
        [str(bench_program()), *(os.fspath(word) for word in words)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    if process.returncode not in codes:
        if process.returncode < 0:
            raise Error(f"hil-bench was ended by signal {-process.returncode}")
        raise error_of(process.stderr)
    return process.returncode, process.stdout
