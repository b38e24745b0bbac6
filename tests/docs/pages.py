"""Finds the commands that a page of the documentation shows."""

import re
from dataclasses import dataclass
from pathlib import Path

# An indented block need not contain commands. In such a block, only a line that begins with one of these programs begins a command.
PROGRAMS = r"(?:sudo )?(?:hil-bench|hil-bench-campaign|hil-target|dbcgen|python3|bash|ctest|cmake|build/\S+|tests/\S+\.(?:sh|py))(?= |$)"
SHELLS = ("sh", "bash", "shell", "console")


@dataclass
class Command:
    text: str
    line: int
    block: int  # commands of the same block share a folder


def _blocks(lines: list[str]):
    """Yields (language, number of the first line, lines) for each fenced and each indented block of a page."""
    at = 0
    while at < len(lines):
        fence = re.match(r"(\s*)```(\w*)", lines[at])
        if fence:
            end = at + 1
            while end < len(lines) and not lines[end].strip().startswith("```"):
                end += 1
            yield fence[2], at + 1, [line.removeprefix(fence[1]) for line in lines[at + 1 : end]]
            at = end + 1
        elif lines[at].startswith("    ") and (at == 0 or not lines[at - 1].strip()):
            end = at
            while end < len(lines) and lines[end].startswith("    "):
                end += 1
            yield "", at, [line[4:] for line in lines[at:end]]
            at = end
        else:
            at += 1


def _without_remark(line: str) -> str:
    """The line without its shell comment: `# ...`."""
    quoted = re.sub(r"'[^']*'|\"[^\"]*\"", lambda text: "x" * len(text[0]), line)
    remark = re.search(r"(^|\s)#", quoted)
    return line[: remark.start()].rstrip() if remark else line.rstrip()


def commands_of(page: Path) -> list[Command]:
    commands: list[Command] = []
    for number, (language, first, lines) in enumerate(_blocks(page.read_text().splitlines())):
        going_on, ends_at = False, ""
        for offset, line in enumerate(lines):
            if ends_at:  # the command reads text up to this marker
                commands[-1].text += "\n" + line
                ends_at = "" if line.strip() == ends_at else ends_at
                continue
            text = _without_remark(line.removeprefix("$ "))
            if going_on:
                commands[-1].text += " " + text.strip().removesuffix("\\").rstrip()
            elif text.strip() and (language in SHELLS or (not language and re.match(PROGRAMS, text))):
                commands.append(Command(text.strip().removesuffix("\\").rstrip(), first + offset + 1, number))
            else:
                going_on = False
                continue
            here = re.search(r"<<-?\s*'?(\w+)'?", text)
            ends_at = here[1] if here else ""
            going_on = not here and text.endswith(("\\", "|")) and not text.endswith("||")
            if not going_on and offset + 1 < len(lines) and re.match(r"\s+[\[|]", lines[offset + 1]):
                going_on = True  # a synopsis continues on the next line
    return commands
