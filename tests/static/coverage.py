"""Prints the share of the lines of dbc, target and bench that the programs of a build folder have run: coverage.py BUILD_FOLDER

The build needs --coverage. All lines for which the compiler generated code are included, in headers and in sources, but not in generated files. A line
is covered if it was executed in at least one object file. An object file that no program ran covers none of its lines.
"""

import concurrent.futures
import json
import os
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PARTS = ("dbc", "target", "bench")


def lines_of(notes):
    """[(file, line, whether the line was executed)] of one object file, as gcov reports them; `notes`: its .gcno file."""
    ended = subprocess.run(["gcov", "--json-format", "--stdout", notes], capture_output=True, cwd=notes.parent)
    if ended.returncode != 0:
        sys.exit(f"coverage.py: {notes}: gcov ended with {ended.returncode}: {ended.stderr.decode(errors='replace').strip()}")
    found = []
    for text in ended.stdout.splitlines():
        for file in json.loads(text)["files"]:
            name = os.path.relpath(os.path.join(notes.parent, file["file"]), ROOT)
            if name.split("/")[0] in PARTS:
                found += [(name, line["line_number"], line["count"] > 0) for line in file["lines"]]
    return found


def table(files):
    """The rows of the printed table: a row for each folder below a part (dbc, target, bench), a row for each
    part, and a total. Each row has the covered share, the number of covered lines and the number of all lines."""
    sums = defaultdict(lambda: [0, 0])
    for name, lines in files.items():
        part, folder, *_ = name.split("/")
        for key in ((part, folder if "/" in name[len(part) + 1:] else ""), (part, "~"), ("~", "~")):
            sums[key][0] += sum(lines.values())
            sums[key][1] += len(lines)
    rows = []
    for (part, folder), (covered, count) in sorted(sums.items()):
        name = "total" if part == "~" else part if folder == "~" else f"  {part}/{folder}"
        rows.append(f"{name:<28} {100 * covered / count:6.1f} % {covered:7d} of {count} lines")
    return rows


def main():
    build = Path(sys.argv[1]).resolve()
    if not any(build.rglob("*.gcda")):
        sys.exit(f"coverage.py: {build}: no program counted anything, expected a build with --coverage whose tests ran")
    files = defaultdict(dict)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        whole = [notes for notes in build.rglob("*.gcno") if notes.with_suffix(".o").exists()]  # whose compilation succeeded
        for found in pool.map(lines_of, whole):
            for name, line, ran in found:
                files[name][line] = files[name].get(line, False) or ran
    print("\n".join(table(files)))


if __name__ == "__main__":
    main()
