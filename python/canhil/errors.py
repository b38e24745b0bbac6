"""What goes wrong outside the target: a file, an option, a bus, a missing program."""

from __future__ import annotations

import re
from pathlib import Path

_PLACE = re.compile(r"(?P<file>[^:]+)(?::(?P<line>\d+))?: (?:key '(?P<key>[^']*)': )?")


class Error(Exception):
    """The bench refused its input or could not fly.

    ``str()`` is the line of the bench: what, where, what was expected. If several keys of a file are wrong, it has
    a line for each; `line` and `key` are those of the first.

    >>> import canhil
    >>> try:
    ...     canhil.run("bench/flights/los_quick.toml", set={"seeker.perod_ms": 5})
    ... except canhil.Error as error:
    ...     str(error.file), error.line, error.key
    ('bench/flights/los_quick.toml', None, 'seeker.perod_ms')
    """

    def __init__(
        self, message: str, *, file: Path | None = None, line: int | None = None, key: str | None = None
    ) -> None:
        super().__init__(message)
        self.file = file
        """The file that is wrong, if the bench names one."""
        self.line = line
        """The line in this file; None: the value did not come from a line, or the bench names none."""
        self.key = key
        """The key of a scenario, mapping or campaign, such as 'slave_imu.period_ms'."""


def error_of(stderr: str) -> Error:
    """The error that a program of the bench printed: its last line says what was wrong, as do the lines before it
    about the same file."""
    lines = [line for line in stderr.splitlines() if line.strip()]
    if not lines:
        return Error("the bench ended without a message")
    lines = [line.removeprefix("hil-bench: ") for line in lines]
    last = _PLACE.match(lines[-1])
    if last is None or not (last["line"] or Path(last["file"]).suffix or Path(last["file"]).exists()):
        return Error(lines[-1])
    first = len(lines) - 1
    while first > 0 and lines[first - 1].startswith(f"{last['file']}:"):
        first -= 1
    place = _PLACE.match(lines[first]) or last
    line = int(place["line"]) if place["line"] else None
    return Error("\n".join(lines[first:]), file=Path(place["file"]), line=line, key=place["key"])
