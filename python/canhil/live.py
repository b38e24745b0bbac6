"""A run that a script takes part in while it goes on."""

from __future__ import annotations

import contextlib
import os
import socket
import subprocess
import tempfile
import time
from collections.abc import Generator, Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType

from canhil import partner, program
from canhil.errors import Error, error_of
from canhil.flights import Command, Faults, Run, command_of_run
from canhil.toml_text import Value

CONNECTS_WITHIN_S = 60.0


class Flight:
    """A run that goes on. Iterating gives its steps; in virtual time, the run waits for each.

    At the end of the `with` block, the run goes on to its end without the script. After an exception, it is ended.
    """

    def __init__(self, command: Command, period: float, truth: Sequence[str], hears: Sequence[str]) -> None:
        self.run: Run
        """The results; only after the `with` block."""
        self._command = command
        self._asks = (period, list(truth), list(hears))
        self._folder = tempfile.TemporaryDirectory(prefix="canhil-live-")
        path = Path(self._folder.name) / "control"
        self._errors = open(path.with_name("errors"), "w+", encoding="utf-8", errors="replace")
        words = [str(program.bench_program()), *(os.fspath(word) for word in command.words)]
        words += ["--control", str(path), "--await-control"]
        self._bench = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=self._errors)
        self._socket = self._connect(path)
        source = self._socket.makefile("r", encoding="utf-8", newline="\n")
        self._lines = partner.Lines(source, self._socket.makefile("w", encoding="utf-8", newline="\n"))
        try:
            partner.opening(self._lines)
        except EOFError:
            self._kill()
            raise self._error() from None
        self._steps: Generator[partner.Bench, None, None] = partner.steps(self._lines, *self._asks)

    def _connect(self, path: Path) -> socket.socket:
        own = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        deadline = time.monotonic() + CONNECTS_WITHIN_S
        while True:
            try:
                own.connect(str(path))
                return own
            except (FileNotFoundError, ConnectionRefusedError):
                if self._bench.poll() is not None or time.monotonic() > deadline:
                    own.close()
                    self._kill()
                    raise self._error() from None
                time.sleep(0.002)

    def _error(self) -> Error:
        self._errors.seek(0)
        return self._command.explained(error_of(self._errors.read()))

    def __enter__(self) -> Flight:
        return self

    def __iter__(self) -> Iterator[partner.Bench]:
        return self

    def __next__(self) -> partner.Bench:
        try:
            return next(self._steps)
        except RuntimeError as refused:
            raise Error(str(refused)) from None
        except (BrokenPipeError, ConnectionResetError):  # the run ended while the script was busy
            raise StopIteration from None

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            self._kill()
            self._errors.close()
            return
        refused = self._leave()
        ended = self._bench.wait()
        if ended not in (program.PASS, program.FAIL, program.NOT_MEASURED):
            raise self._error()
        self._errors.close()
        self.run = self._command.run()
        if refused:
            raise Error(refused)

    def _leave(self) -> str:
        """Sends what the last step did, and returns why the bench refuses it."""
        refused = ""
        try:
            self._steps.close()
            self._socket.shutdown(socket.SHUT_WR)
            for line in self._lines.source:
                if line.startswith("error "):
                    refused = line.partition(" ")[2].rstrip("\n")
        except OSError:  # the run ended while the script was busy
            pass
        for close in (self._lines.sink.close, self._lines.source.close, self._socket.close):
            with contextlib.suppress(OSError):  # what was not sent has nobody to read it
                close()
        return refused

    def _kill(self) -> None:
        self._bench.terminate()
        self._bench.wait()


def live(
    scenario: program.StrPath,
    *,
    period: float = 0.01,
    truth: Sequence[str] = (),
    hears: Sequence[str] = (),
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
) -> Flight:
    """Begins a run of a scenario, in which the script takes part as a node (docs/programs.md).

    `period`: how often it is asked, in s. `truth`: the true values that it gets. `hears`: the messages that it
    gets; "*": every frame. The other arguments are those of run().

    A fault that begins when the missile is within 1 km of its target:

    >>> import canhil
    >>> spike = {"name": "spike", "kind": "bias", "quantity": "seeker.error_pitch", "by_mrad": 4, "when": "command"}
    >>> with canhil.live("bench/flights/los_quick.toml", bus="in-process", faults=[spike], truth=["plant.range"]) as flight:
    ...     for now in flight:
    ...         if now.truth["plant.range"] < 1000:
    ...             now.begin("spike")
    ...             break
    >>> flight.run.verdict
    <Verdict.FAIL: 'fail'>
    """
    return Flight(
        command_of_run(
            scenario, bus=bus, target=target, set=set, faults=faults, lockstep=lockstep, realtime=realtime, seed=seed,
            page=page, folder=folder, options=options,
        ),
        period, truth, hears,
    )
