"""Scenarios over several benches of a lab, at once: by ssh, by labgrid's places, or on this machine.

    python3 -m canhil.lab lab.toml scenarios/*.toml --out results --junit results.xml
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import queue
import shlex
import subprocess
import sys
import tarfile
import threading
import tomllib
import xml.etree.ElementTree as xml
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from canhil import program
from canhil.errors import Error, error_of
from canhil.flights import Run
from canhil.report import Verdict

FILES = {"--json": "report.json", "--junit": "report.xml", "--csv": "values.csv", "--log": "frames.log"}
TAR = "in=$(mktemp -d) && out=$(mktemp -d) && trap 'rm -rf \"$in\" \"$out\"' EXIT && tar -xC \"$in\" && cd \"$in\""


UNREACHABLE = 255
"""The exit code of ssh, and of labgrid-client ssh, that did not reach the machine."""


class Unreachable(Exception):
    """A machine that does not answer."""


@dataclass(frozen=True)
class Bench:
    """A machine with hil-bench. A table [[bench]] of a lab's file has these keys."""

    name: str
    bus: str = ""
    """The bus of its runs; empty: the default of hil-bench. 'serial:NUMBER' is the adapter with this number."""
    ssh: str = ""
    """Destination of ssh, such as 'hil@rack1'; empty: this machine, or a place of labgrid."""
    labgrid: str = ""
    """A place of labgrid, which is acquired for the runs and released after them."""
    target: str = ""
    """The command of the target; "none": it runs already. Empty: the default of hil-bench."""
    program: str = "hil-bench"
    options: tuple[str, ...] = ()
    """Further options of hil-bench run, such as --realtime."""

    def command(self, shell: str) -> list[str]:
        """The words that run a line of a shell on the machine."""
        if self.labgrid:
            return ["labgrid-client", "-p", self.labgrid, "ssh", "--", shlex.join(["sh", "-c", shell])]
        if self.ssh:
            return ["ssh", "-o", "BatchMode=yes", self.ssh, shlex.join(["sh", "-c", shell])]
        return ["sh", "-c", shell]


@dataclass
class Flown:
    """A scenario on a bench."""

    scenario: Path
    bench: Bench
    run: Run | None = None
    error: Error | None = None
    """Why there are no results: the scenario was refused, or the machine could not be reached."""

    @property
    def outcome(self) -> str:
        """The verdict, or 'error'."""
        return "error" if self.run is None else str(self.run.verdict)


@dataclass
class Result:
    """What a lab has flown, in the order of the scenarios."""

    flown: list[Flown] = field(default_factory=list)

    @property
    def code(self) -> int:
        """As the exit code of hil-bench: the worst of the runs."""
        outcomes = {one.outcome for one in self.flown}
        worst = [("error", program.USAGE), (str(Verdict.FAIL), program.FAIL), (str(Verdict.NOT_MEASURED), program.NOT_MEASURED)]
        return next((code for outcome, code in worst if outcome in outcomes), program.PASS)

    def junit(self, path: program.StrPath) -> None:
        """Writes all results as one JUnit file. Each suite has the name of its bench as a property."""
        all_suites = xml.Element("testsuites")
        for one in self.flown:
            for suite in self._suites(one):
                properties = suite.find("properties")
                if properties is None:
                    properties = xml.Element("properties")
                    suite.insert(0, properties)
                xml.SubElement(properties, "property", name="bench", value=one.bench.name)
                all_suites.append(suite)
        xml.ElementTree(all_suites).write(path, encoding="utf-8", xml_declaration=True)

    @staticmethod
    def _suites(one: Flown) -> list[xml.Element]:
        if one.run is not None:
            root = xml.parse(one.run.folder / "report.xml").getroot()
            return list(root.iter("testsuite"))
        suite = xml.Element("testsuite", name=one.scenario.stem, tests="1", errors="1")
        case = xml.SubElement(suite, "testcase", classname=one.scenario.stem, name="run")
        xml.SubElement(case, "error", message=str(one.error))
        return [suite]


def benches(path: program.StrPath) -> list[Bench]:
    """The tables [[bench]] of a file. Error: the file is wrong."""
    file = Path(path)
    try:
        tables: Any = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as wrong:
        raise Error(f"{file}: {wrong}, expected a TOML file with [[bench]]", file=file) from None
    found = []
    known = list(Bench.__dataclass_fields__)
    if list(tables) != ["bench"] or not isinstance(tables["bench"], list):
        raise Error(f"{file}: expected tables [[bench]] and nothing else", file=file)
    for table in tables["bench"]:
        for key, value in table.items():
            expected: type = list if key == "options" else str
            texts = value if isinstance(value, list) else [value]
            if key not in known or not isinstance(value, expected) or not all(isinstance(one, str) for one in texts):
                raise Error(f"{file}: key 'bench.{key}': expected one of {', '.join(known)}, a text (options: a list)", file=file, key=key)
        if not table.get("name") or (table.get("ssh") and table.get("labgrid")):
            raise Error(f"{file}: key 'bench': expected a name, and at most one of ssh and labgrid", file=file, key="bench")
        found.append(Bench(**(table | {"options": tuple(table.get("options", ()))})))
    if len({one.name for one in found}) < len(found):
        raise Error(f"{file}: key 'bench.name': expected a name of its own for each", file=file, key="bench.name")
    return found


def _packed(folder: Path) -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as tar:
        tar.add(folder, arcname=".")
    return buffer.getvalue()


def _fly(bench: Bench, scenario: Path, tree: Path, packed: bytes, folder: Path) -> Run:
    words = [bench.program, "run", os.fspath(scenario.relative_to(tree)), *bench.options]
    words += ["--bus", bench.bus] if bench.bus else []
    words += ["--target", bench.target] if bench.target else []
    files = {option: name for option, name in FILES.items() if option != "--log" or "unrounded" not in bench.bus}
    line = shlex.join(words) + "".join(f' {option} "$out/{name}"' for option, name in files.items())
    # The files come back on standard output, whatever the verdict is.
    shell = f'{TAR} && {{ {line} >/dev/null; code=$?; tar -cC "$out" .; exit $code; }}'
    ended = subprocess.run(bench.command(shell), input=packed, capture_output=True, check=False)
    if ended.returncode == UNREACHABLE and (bench.ssh or bench.labgrid):
        raise Unreachable(f"{bench.name}: {ended.stderr.decode(errors='replace').strip()}")
    if ended.returncode not in (program.PASS, program.FAIL, program.NOT_MEASURED):
        raise error_of(ended.stderr.decode(errors="replace"))
    folder.mkdir(parents=True)
    with tarfile.open(fileobj=io.BytesIO(ended.stdout), mode="r:") as tar:
        for member in tar.getmembers():  # the names of other files are not to be trusted
            content = tar.extractfile(member) if Path(member.name).name in FILES.values() else None
            if content is not None:
                (folder / Path(member.name).name).write_bytes(content.read())
    if not (folder / "report.json").exists():
        raise Error(f"{bench.name}: gave no report, expected one from '{bench.program}'")
    return Run(folder)


def _labgrid(bench: Bench, what: str) -> None:
    ended = subprocess.run(["labgrid-client", "-p", bench.labgrid, what], capture_output=True, text=True, check=False)
    if ended.returncode != 0:
        raise Error(f"labgrid: place '{bench.labgrid}': {what}: {(ended.stderr or ended.stdout).strip()}")


def run(
    scenarios: Sequence[program.StrPath],
    lab: Sequence[Bench],
    *,
    folder: program.StrPath,
    tree: program.StrPath | None = None,
) -> Result:
    """Flies each scenario on a bench that is free. A bench flies one scenario at a time.

    `tree`: the folder that is sent to the machines for each run, with all files that the scenarios name; by default
    the innermost folder that has all scenarios. `folder`: a new folder for the files of the runs.
    """
    paths = [Path(one).resolve() for one in scenarios]
    if not paths or not lab:
        raise Error("the lab has nothing to do, expected scenarios and benches")
    root = Path(tree).resolve() if tree is not None else Path(os.path.commonpath([one.parent for one in paths]))
    place = Path(folder)
    if place.exists() and any(place.iterdir()):
        raise Error(f"{place}: is not empty, expected a new folder", file=place)
    for path in paths:
        if not path.is_file() or root not in path.parents:
            raise Error(f"{path}: is no file in {root}, expected a scenario", file=path)
    packed = _packed(root)
    waiting: queue.SimpleQueue[int] = queue.SimpleQueue()
    results: list[Flown | None] = [None] * len(paths)
    for index in range(len(paths)):
        waiting.put(index)

    def serve(bench: Bench) -> None:
        try:
            if bench.labgrid:
                _labgrid(bench, "acquire")
        except (Error, OSError) as wrong:
            print(f"{bench.name}: {wrong}", file=sys.stderr)  # the other benches fly its scenarios
            return
        try:
            while True:
                index = waiting.get_nowait()
                flown = results[index] = Flown(paths[index], bench)
                try:
                    flown.run = _fly(bench, paths[index], root, packed, place / f"{index + 1}-{paths[index].stem}")
                except Unreachable as wrong:
                    print(wrong, file=sys.stderr)  # the other benches fly what is left
                    results[index] = None
                    waiting.put(index)
                    return
                except (Error, OSError, tarfile.TarError) as wrong:
                    flown.error = wrong if isinstance(wrong, Error) else Error(f"{bench.name}: {wrong}")
        except queue.Empty:
            return
        finally:
            if bench.labgrid:
                try:
                    _labgrid(bench, "release")
                except (Error, OSError) as wrong:
                    print(f"{bench.name}: {wrong}", file=sys.stderr)

    threads = [threading.Thread(target=serve, args=(bench,)) for bench in lab]
    for thread in threads:
        thread.start()
    try:
        for thread in threads:
            thread.join()
    except KeyboardInterrupt:
        with contextlib.suppress(queue.Empty):  # begins nothing more; Ctrl-C reaches the runs that go on, too
            while True:
                waiting.get_nowait()
        for thread in threads:
            thread.join()
        raise
    nobody = Error("no bench of the lab could fly it")
    return Result([one or Flown(path, lab[0], error=nobody) for one, path in zip(results, paths)])


def main(words: Sequence[str] | None = None) -> int:
    """The command. Returns its exit code."""
    parser = argparse.ArgumentParser(prog="python3 -m canhil.lab", description="Flies scenarios over the benches of a lab.")
    parser.add_argument("lab", metavar="LAB.toml", help="file of [[bench]] tables")
    parser.add_argument("scenarios", metavar="SCENARIO", nargs="+")
    parser.add_argument("--out", required=True, help="new folder for the files of the runs")
    parser.add_argument("--tree", help="folder that is sent to the machines (default: that of the scenarios)")
    parser.add_argument("--junit", help="one JUnit file of all runs")
    asked = parser.parse_args(words)
    try:
        result = run(asked.scenarios, benches(asked.lab), folder=asked.out, tree=asked.tree)
        if asked.junit:
            result.junit(asked.junit)
    except Error as error:
        print(f"canhil.lab: {error}", file=sys.stderr)
        return program.USAGE
    except KeyboardInterrupt:
        print(f"canhil.lab: interrupted; {asked.out} has the runs that had ended", file=sys.stderr)
        return program.NOT_MEASURED
    for one in result.flown:
        print(f"{one.outcome:13} {one.bench.name}: {one.scenario.name}: {one.run.reason if one.run else one.error}")
    return result.code


if __name__ == "__main__":
    sys.exit(main())
