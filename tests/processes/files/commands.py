"""The commands of all programs with their files: which option reads a file, which option writes one."""

import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]

# What each option and argument with a text value does: R reads files, W writes a file, F writes files in a folder, N neither.
# The test compares this table with the --help of the programs.
TABLE = {
    "hil-bench": {},
    "hil-bench run": {"SCENARIO": "R", "--bus": "N", "--control": "N", "--bus-of": "N", "--target": "R", "--dbc": "R", "--set": "N", "--faults": "R", "--json": "W",
                      "--junit": "W", "--html": "W", "--csv": "W", "--operator": "N", "--log": "W", "--select": "N", "--out": "F",
                      "--live-address": "N"},
    "hil-bench new": {},
    "hil-bench new mapping": {"FILE": "N", "--dbc": "R", "--device": "N", "--encoding": "N"},  # FILE: a new file, so it is no input
    "hil-bench new scenario": {"FILE": "N", "--mapping": "R", "--estimator": "N"},
    "hil-bench report": {"FILE.json": "F"},
    "hil-bench compare": {"A.json": "R", "B.json": "R", "--before": "R", "--after": "R", "--history": "R", "--html": "W"},
    "hil-bench bus": {"BUS": "N"},
    "hil-bench accept": {"--target": "R", "--estimator": "N", "--suites": "R", "--family": "N", "--same-as": "N", "--json": "W", "--junit": "W",
                         "--html": "W"},
    "hil-bench campaign": {"FILE": "R", "--out": "F", "--shard": "N", "--target": "R", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W", "--live-address": "N",
                           "--paper": "N", "--exact": "R"},
    "hil-bench campaign merge": {"OUT": "W", "SHARD": "R"},
    "hil-bench campaign report": {"RESULTS": "R", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W"},
    "hil-bench campaign export": {"RESULTS": "R", "--format": "N", "--variant": "N", "--quantity": "N"},
    "hil-bench campaign replay": {"FILE": "R", "--variant": "N", "--log": "W", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W"},
    "hil-bench faults": {"SCENARIO": "R", "--set": "R", "--out": "F", "--shard": "N", "--target": "R", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W",
                         "--live-address": "N"},
    "hil-bench faults merge": {"RESULTS": "R", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W"},
    "hil-bench reference": {},
    "hil-bench diverge": {"A": "R", "B": "R"},
    "hil-bench golden": {},
    "hil-bench golden record": {"FOLDER": "F", "SCENARIO": "R", "--target": "R"},
    "hil-bench golden check": {"FOLDER": "F", "--target": "R", "--json": "W"},
    "hil-bench doctor": {"--bus": "N", "--loop": "N", "--json": "W"},
    "hil-bench schedulability": {"FILE": "R", "--queue": "N"},
    "hil-bench conformance": {"--target": "R", "--estimator": "N", "--scenario": "R", "--json": "W", "--junit": "W"},
    "hil-bench log": {},
    "hil-bench log convert": {"FROM": "R", "TO": "W", "--format": "N"},
    "hil-bench log compare": {"A": "R", "B": "R", "--dbc": "R", "--json": "W"},
    "hil-bench decode": {"LOG": "R", "--dbc": "R", "--encoding": "N", "--format": "N", "--only": "N", "--out": "W"},
    "hil-bench replay": {"LOG": "R", "--bus": "N", "--channel": "N", "--only": "N", "--direction": "N"},
    "hil-bench check": {"LOG": "R", "SCENARIO": "R", "--set": "N", "--faults": "R", "--json": "W", "--junit": "W", "--html": "W", "--csv": "W"},
    "hil-bench dbc": {},
    "hil-bench dbc lint": {"FILE": "R", "--encoding": "N", "--sarif": "W"},
    "hil-bench dbc show": {"FILE": "R", "MESSAGE": "N", "--encoding": "N"},
    "hil-bench dbc check": {"MAPPING": "R", "--scenario": "R"},
    "hil-bench dbc extract": {"MAPPING": "R", "LOG": "R", "--play": "N"},
    "hil-bench dbc wireshark": {"FILE": "R", "--encoding": "N", "--out": "W"},
    "hil-bench dbc rules": {},
    "hil-target": {"--bus": "N", "--replay": "R", "--dbc": "R"},
    "dbcgen": {"dbc": "R", "--output": "W", "--namespace": "N", "--source": "W", "--include": "N"},
}


def described(programs):
    """{command: its options and arguments with a text value}, as --help of the programs lists them."""
    found = {}

    def ask(words):
        text = subprocess.run([programs / words[0], *words[1:], "--help"], capture_output=True, text=True, timeout=60, check=True).stdout
        names = re.findall(r"^  (?:-\w,)?(\S+) TEXT\b", text, re.MULTILINE)
        found[" ".join(words)] = set(names)
        below = text.split("\nSubcommands:")[1] if "\nSubcommands:" in text else ""
        for name in re.findall(r"^  ([a-z][a-z-]*) ", below, re.MULTILINE):
            ask([*words, name])

    for program in ("hil-bench", "hil-target", "dbcgen"):
        ask([program])
    return found


class Workplace:
    """A folder with one file of each kind that a command reads, and a copy of the programs."""

    def __init__(self, folder, hil_bench, hil_target, dbcgen):
        self.folder = pathlib.Path(folder)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        campaign = pathlib.Path(hil_bench).with_name("hil-bench-campaign")
        for program in (hil_bench, campaign, hil_target, dbcgen):
            shutil.copy2(program, self.programs)
        flights = ROOT / "bench" / "flights"
        for name in ("own_ecu.toml", "own_ecu.mapping.toml", "own_ecu.dbc"):
            shutil.copy(ROOT / "docs" / "examples" / "own_ecu" / name, self.folder)
        shutil.copy(flights / "transfer_alignment_quick.toml", self.folder / "plain.toml")
        shutil.copy(ROOT / "dbc" / "canhil.dbc", self.folder / "canhil.dbc")
        shutil.copytree(ROOT / "bench" / "acceptance" / "los_rate", self.folder / "suites" / "acceptance" / "los_rate")
        shutil.copytree(flights, self.folder / "suites" / "flights")
        self.write("my-target", "#!/bin/sh\nexit 1\n").chmod(0o755)
        self.write("gain.txt", "3\n")
        self.write("faults.toml", '[[fault]]\nkind = "lost"\nmessages = ["MasterInsVelocityNE"]\nfrom_s = 1.0\nto_s = 1.5\n')
        self.run("hil-bench", "run", "plain.toml", "--bus", "in-process", "--log", "run.log", "--json", "run.json")
        self.run("hil-bench", "log", "convert", "run.log", "other.asc")
        plain = (self.folder / "plain.toml").read_text()
        imu = re.sub(r"(\n\[slave_imu\][^\n]*\n)[^\[]*", r'\1period_ms = 10\nrecorded = "run.log"\n\n', plain)
        self.write("recorded.toml", imu)
        rows = "".join(f"{0.1 * i:.1f},37.0,127.0,100.0,0,0,0,0,0,0\n" for i in range(400))
        self.write("flight.csv", "t_s,latitude_deg,longitude_deg,height_m,velocity_north_mps,velocity_east_mps,velocity_down_mps,roll_deg,"
                                 "pitch_deg,heading_deg\n" + rows)
        at = plain.index("[truth]")
        self.write("truth.toml", plain[:at] + '[truth]\ntrajectory = "recorded"\nfile = "flight.csv"\n\n' + plain[plain.index("\n[", at) + 1:])
        self.write("campaign.toml", 'title = "T"\nruns = 1\nseed = 1\n[[variant]]\nname = "A"\nscenario = "recorded.toml"\n')
        (self.folder / "golden").mkdir()
        shutil.copy(self.folder / "plain.toml", self.folder / "golden" / "plain.toml")
        shutil.copy(self.folder / "run.log", self.folder / "golden" / "plain.log")
        self.run("hil-bench", "campaign", "campaign.toml", "--out", "part.sqlite")
        (self.folder / "history").mkdir()
        shutil.copy(self.folder / "run.json", self.folder / "history" / "a.json")
        (self.folder / "matrix").mkdir()
        self.run("hil-bench", "faults", "plain.toml", "--set", "faults.toml", "--out", "matrix")

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def run(self, program, *words):
        done = subprocess.run([self.programs / program, *words], cwd=self.folder, capture_output=True, text=True, timeout=120, check=False)
        if done.returncode not in (0, 1, 3):
            raise AssertionError((words, done.stdout, done.stderr))
        return done

    def files(self):
        """{file: its content}; of a program, which is large, what changes with its content."""
        def content(path):
            state = path.stat()
            return path.read_bytes() if path.parent != self.programs else (state.st_ino, state.st_size, state.st_mtime_ns)
        return {path.relative_to(self.folder).as_posix(): content(path) for path in self.folder.rglob("*") if path.is_file()}


TARGET = ("--target", "./my-target gain.txt")
ECU = ("own_ecu.toml", "own_ecu.mapping.toml", "own_ecu.dbc")
SUITE = ("suites/acceptance/los_rate/suite.toml", "suites/acceptance/los_rate/campaign.toml", "suites/flights/los_closed_loop.toml")
BENCH, CAMPAIGN = "bin/hil-bench", "bin/hil-bench-campaign"

# For each command that writes: words with all its inputs, and these inputs. A command may have several such lines.
LINES = [
    ("hil-bench run", ("recorded.toml", "--faults", "faults.toml", "--dbc", "canhil.dbc", *TARGET),
     ("recorded.toml", "run.log", "faults.toml", "canhil.dbc", "my-target", "gain.txt", BENCH)),
    ("hil-bench run", ("truth.toml", "--bus", "in-process"), ("truth.toml", "flight.csv")),
    ("hil-bench run", ("own_ecu.toml", *TARGET), ECU),
    ("hil-bench run", ("plain.toml",), ("bin/hil-target",)),
    ("hil-bench accept", ("--suites", "suites/acceptance", *TARGET), (*SUITE, "my-target", CAMPAIGN)),
    ("hil-bench campaign", ("campaign.toml", "--out", "new.sqlite", *TARGET),
     ("campaign.toml", "recorded.toml", "run.log", "my-target", "gain.txt", CAMPAIGN)),
    ("hil-bench compare", ("--history", "history"), ("history/a.json",)),
    ("hil-bench campaign merge", ("part.sqlite",), ("part.sqlite",)),
    ("hil-bench campaign report", ("part.sqlite",), ("part.sqlite",)),
    ("hil-bench campaign replay", ("campaign.toml", "0"), ("campaign.toml", "recorded.toml", "run.log")),
    ("hil-bench faults", ("recorded.toml", "--set", "faults.toml", "--out", "new", *TARGET),
     ("recorded.toml", "run.log", "faults.toml", "my-target", "gain.txt")),
    ("hil-bench faults merge", ("matrix/faults.sqlite",), ("matrix/faults.sqlite",)),
    ("hil-bench golden check", ("golden", *TARGET), ("golden/plain.toml", "golden/plain.log", "my-target")),
    ("hil-bench doctor", ("--bus", "local:", "--seconds", "1"), (BENCH,)),
    ("hil-bench conformance", ("--scenario", "recorded.toml", *TARGET), ("recorded.toml", "run.log", "my-target")),
    ("hil-bench log convert", ("run.log",), ("run.log",)),
    ("hil-bench log compare", ("run.log", "other.asc", "--dbc", "canhil.dbc"), ("run.log", "other.asc", "canhil.dbc")),
    ("hil-bench decode", ("run.log", "--dbc", "canhil.dbc"), ("run.log", "canhil.dbc")),
    ("hil-bench check", ("run.log", "truth.toml", "--faults", "faults.toml"), ("run.log", "truth.toml", "flight.csv", "faults.toml")),
    ("hil-bench check", ("run.log", "own_ecu.toml"), ECU),
    ("hil-bench dbc lint", ("canhil.dbc", "own_ecu.dbc"), ("canhil.dbc", "own_ecu.dbc")),
    ("hil-bench dbc wireshark", ("canhil.dbc",), ("canhil.dbc",)),
    ("dbcgen", ("canhil.dbc",), ("canhil.dbc", "bin/dbcgen")),
]


def writers(command):
    """The options and arguments of a command that write one file."""
    return [name for name, what in TABLE[command].items() if what == "W"]


def with_output(command, words, option, path):
    """The command line with `path` as output of `option`; an option that is already in `words` is replaced."""
    if option == "OUT":  # the first argument
        return [*command.split(), path, *words]
    if option == "TO":
        return [*command.split(), *words, path]
    words = list(words)
    if option in words:
        at = words.index(option)
        del words[at:at + 2]
    return [*command.split(), *words, option, path]
