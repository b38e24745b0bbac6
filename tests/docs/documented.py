#!/usr/bin/env python3
"""Runs the commands that one page of the documentation shows, in the order of the page, in a separate folder.

    documented.py PAGE SOURCE BUILD SCRATCH    PAGE: path from the root of the project, such as docs/campaigns.md

Each command must end with exit code 0, or with another code that rules.py permits. For a command that cannot be
run here, rules.py gives the reason. Of such a command, two things are checked: its options must be in the help of
its program, and its files must exist. Exit code 1: a command does not do what the page says.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))
from pages import Command, commands_of  # noqa: E402
from rules import PLACEHOLDERS, PREPARED, Rule, rule_of  # noqa: E402

LONGEST_S = 120
# In this test no CPU is reserved for the target, so a busy host can stall the target. A run in real time then prints a line that STALLED matches. The
# command is repeated in this case, because a real defect occurs in every repetition.
STALLED = re.compile(r"target silent|FAIL +(output_period|latency|heartbeat) ")
WRITTEN_TO = ("docs", "dbc")  # copied, because commands write to them; all other folders are linked


def scratch_tree(source: Path, build: Path, scratch: Path) -> None:
    """Makes a folder that looks like a clone of the project in which canhil was built."""
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    for entry in source.iterdir():
        if entry.name in WRITTEN_TO:
            shutil.copytree(entry, scratch / entry.name)
        elif entry.name not in ("build", ".git"):
            (scratch / entry.name).symlink_to(entry)
    (scratch / "build").mkdir()
    (scratch / "build" / "default").symlink_to(build)


class Session:
    """The shell of a user who types the commands of a page: each command starts in the working directory that the one before left."""

    def __init__(self, scratch: Path, build: Path):
        self.root = self.folder = scratch
        self.environment = os.environ | {"PATH": f"{build}:{build}/dbc/codegen:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}

    def run(self, text: str) -> tuple[int, str]:
        where = self.root / ".folder"
        script = f"set -o pipefail\n{text}\ncode=$?\npwd > {shlex.quote(str(where))}\nexit $code\n"
        try:
            ended = subprocess.run(
                ["bash", "-c", script], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST_S, text=True, errors="replace",
            )  # fmt: skip
        except subprocess.TimeoutExpired as late:
            return -1, f"{late.output or ''}\nnot ended after {LONGEST_S} s"
        self.folder = Path(where.read_text().strip()) if where.exists() else self.folder
        return ended.returncode, ended.stdout

    def unknown_words(self, text: str) -> list[str]:
        """A complaint for each option that is not in the help of its program, and for each file that does not exist."""
        unknown = []
        for call in re.split(r"[;|&]+|\$\(|\|\|", re.sub(r"'[^']*'|\"[^\"]*\"", "QUOTED", text)):
            words = call.replace("[", " ").replace("]", " ").split()
            while words and (words[0] == "sudo" or "=" in words[0]):
                words.pop(0)
            for word in words:  # complains about files of the project that do not exist
                if re.match(r"(bench|dbc|docs|target|tests|packaging)/", word) and not re.search(r"[*A-Z]", word) and not (self.root / word).exists():
                    unknown.append(f"{word} is not there")
            scripts = [self.root / word for word in words[:2] if word.endswith(".py") and (self.root / word).is_file()]
            for option in (word.split("=")[0] for word in words if word.startswith("--") and scripts):
                if option not in scripts[0].read_text():
                    unknown.append(f"{scripts[0].name} has no option {option}")
            if not words or Path(words[0]).name not in ("hil-bench", "hil-target", "dbcgen"):
                continue
            command = [words[0]]
            for word in words[1:]:
                if not re.fullmatch(r"[a-z]+", word) or len(command) == 3:
                    break
                longer = subprocess.run([*command, word, "--help"], env=self.environment, cwd=self.root, capture_output=True, text=True)
                if longer.returncode:
                    break
                command.append(word)
            help_text = subprocess.run([*command, "--help"], env=self.environment, cwd=self.root, capture_output=True, text=True).stdout
            for option in (word.split("=")[0] for word in words if word.startswith("-") and word != "-"):
                if not re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", help_text):
                    unknown.append(f"{' '.join(command)} has no option {option}")
        return unknown


def attempt(command: Command, rule: Rule, session: Session) -> str:
    """Runs a command. Returns the complaint about it, or an empty text."""
    wrong = session.unknown_words(command.text) if rule.why_not else []
    if wrong or rule.why_not:
        return "; ".join(wrong)
    text = command.text
    for pattern, replacement in (*rule.instead, *PLACEHOLDERS):
        text = re.sub(pattern, replacement, text)
    code, printed = session.run(text)
    for _ in range(3):
        if code in rule.codes or not STALLED.search(printed):
            break
        code, printed = session.run(text)
    tail = "\n    ".join(printed.splitlines()[-12:])
    if code not in rule.codes:
        return f"exit code {code}, expected {' or '.join(map(str, rule.codes))}\n    ran: {text}\n    {tail}"
    if not re.search(rule.says, printed):
        return f"does not say '{rule.says}'\n    ran: {text}\n    {tail}"
    return ""


def main() -> int:
    page, source, build, scratch = sys.argv[1], *(Path(name).resolve() for name in sys.argv[2:5])
    scratch_tree(source, build, scratch)
    commands = commands_of(source / page)
    session = Session(scratch, build)
    for line in PREPARED.get(page, ()):
        code, printed = session.run(line)
        if code not in (0, 3):
            print(f"{page}: what its commands need cannot be made: {line}\n{printed}")
            return 1
    failed, block = 0, -1
    for command in commands:
        if command.block != block:
            session.folder, block = session.root, command.block
        rule = rule_of(command.text, page)
        wrong = attempt(command, rule, session)
        state = "FAILED" if wrong else "not run" if rule.why_not else "ok"
        print(f"{state:7}  {page}:{command.line}: {command.text.splitlines()[0]}{'  (' + rule.why_not + ')' if rule.why_not else ''}", flush=True)
        if wrong:
            print(f"    {wrong}")
            failed += 1
    if failed:
        print(f"{failed} of {len(commands)} commands of {page} do not do what the page says: mend the page, or tests/docs/rules.py")
        return 1
    shutil.rmtree(scratch, ignore_errors=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
