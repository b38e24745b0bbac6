#!/usr/bin/env python3
"""Puts the records of tests/perf/run.sh into docs/performance.md: page.py FOLDER_OF_RECORDS; page.py --check

Each figure of the page stands in a block between two comments, which names the record (a text file) that is shown there:

    <!-- record NAME.txt -->
    <!-- /record -->

The records of the page are kept in tests/perf/record. --check: exit code 1 if the page is not what they make.
"""

import pathlib
import re
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs/performance.md"
KEPT = HERE / "record"
BLOCK = re.compile(r"(<!-- record (\S+) -->\n).*?(<!-- /record -->)", re.DOTALL)


def shown(text):
    """A record without progress lines, empty ends and trailing blanks."""
    lines = [line.rstrip() for line in text.split("\n") if "\r" not in line]
    return "\n".join(lines).strip("\n")


def page_of(text, folder):
    return BLOCK.sub(lambda block: f"{block[1]}```text\n{shown((folder / block[2]).read_text(encoding='utf-8'))}\n```\n{block[3]}", text)


def main():
    text = PAGE.read_text(encoding="utf-8")
    if sys.argv[1:] == ["--check"]:
        same = text == page_of(text, KEPT)
        if not same:
            print(f"{PAGE.name} is not what {KEPT} makes, expected no change by hand: python3 tests/perf/page.py FOLDER_OF_RECORDS", file=sys.stderr)
        return 0 if same else 1
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    names = [block[2] for block in BLOCK.finditer(text)]
    missing = [name for name in names if not (folder / name).exists()]
    if missing:
        print(f"page.py: {folder} has no {', '.join(missing)}, expected the records of a whole run of tests/perf/run.sh", file=sys.stderr)
        return 2
    KEPT.mkdir(exist_ok=True)
    for name in names:
        shutil.copyfile(folder / name, KEPT / name)
    PAGE.write_text(page_of(text, KEPT), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
