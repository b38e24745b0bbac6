#!/usr/bin/env python3
"""Checks that the outputs shown on a page are those that its commands print; --write replaces them.

    outputs.py BUILD PAGE... [--write]

A page's ```sh blocks are run in their order, in a scratch folder that has the project's folders and BUILD as
build/default. The ```text block after a ```sh block shows what the commands printed (stdout and stderr
together). HTML comments before a block:

    <!-- shown: REGEX -->   only the lines in which REGEX is found; '...' stands for the others
    <!-- varies -->         the output differs between runs or hosts: the commands are run only with --write
    <!-- not run -->        before a ```sh block that installs, clones or builds, which a test must not do

"""
import argparse
import difflib
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(
    r"(?P<skip><!-- not run -->\n+)?```sh\n(?P<sh>.*?)```\n"
    r"(?:\n*(?:<!-- shown: (?P<shown>.*?) -->|(?P<varies><!-- varies(?:; shown: (?P<also>.*?))? -->))\n+|\n+)?"
    r"(?P<text>```text\n(?P<output>.*?)```\n)?", re.S)


def of_any_host(line):
    """The line without parts that differ between hosts: the duration of a run, the revision, the fingerprint of a new key."""
    line = re.sub(r"\bin \d+(\.\d+)? ?s\b", "in T s", line.rstrip())
    line = re.sub(r"revision [0-9a-f]+(-dirty)?", "revision REVISION", line)
    return re.sub(r"SHA256:\S+", "SHA256:KEY", line)


def selected(output, pattern):
    """The lines that contain the pattern; '...' replaces each group of other lines."""
    if not pattern:
        return output
    lines = []
    for line in output:
        if re.search(pattern, line):
            lines.append(line)
        elif lines[-1:] != ["..."]:
            lines.append("...")
    return lines


def scratch_tree(folder, build):
    for entry in ROOT.iterdir():
        if entry.name not in ("build", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    (folder / "build/default").symlink_to(build.resolve())


def check(page, build, write):
    """The complaints about a page. With `write` the page is updated, and only failed commands remain as complaints."""
    text = page.read_text()
    complaints, pieces, end = [], [], 0
    # The folder must not be in /tmp: tests/vcan/run.sh may run a command in a guest system, which has a /tmp of its own.
    with tempfile.TemporaryDirectory(prefix="canhil-docs-", dir="/var/tmp") as name:
        folder = Path(name)
        scratch_tree(folder, build)
        env = dict(os.environ, PATH=f"{build.resolve()}:{os.environ['PATH']}", LC_ALL="C.UTF-8", TERM="dumb")
        for block in BLOCK.finditer(text):
            if block["skip"] or (block["varies"] and not write):
                continue
            place = f"{page.relative_to(ROOT)}:{text[:block.start()].count(chr(10)) + 1}"
            try:
                done = subprocess.run(["bash", "-c", block["sh"]], cwd=folder, env=env, stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=280)
            except subprocess.TimeoutExpired:
                complaints.append(f"{place}: takes more than 280 s")
                continue
            if done.returncode in (126, 127):
                complaints.append(f"{place}: {done.stdout.strip()}")
                continue
            if not block["text"]:
                continue
            is_lines = selected([line.rstrip() for line in done.stdout.replace(str(folder) + "/", "").splitlines()],
                                block["shown"] or block["also"])
            shown = block["output"].splitlines()
            if [of_any_host(line) for line in shown] == [of_any_host(line) for line in is_lines]:
                continue
            if write:
                pieces += [text[end:block.start("output")], "\n".join(is_lines) + "\n"]
                end = block.end("output")
            else:
                changes = difflib.unified_diff(shown, is_lines, "as shown", "as printed", lineterm="", n=0)
                complaints.append(f"{place}: prints something else\n  " + "\n  ".join(changes))
    if pieces:
        page.write_text("".join(pieces) + text[end:])
        print(f"{page.relative_to(ROOT)}: outputs made anew")
    return complaints


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("pages", type=Path, nargs="+")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    complaints = [c for page in options.pages for c in check(page.resolve(), options.build, options.write)]
    for complaint in complaints:
        print(complaint)
    if complaints:
        print(f"remake them: python3 tests/docs/outputs.py {options.build} PAGE... --write")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
