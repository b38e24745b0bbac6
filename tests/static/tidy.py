"""Runs clang-tidy on every source of a build folder: tidy.py [--each] BUILD_FOLDER [NAME_PART...]

clang-tidy spends most of its time in headers (Eigen, Boost): half a minute for a source of ten lines. Therefore one file includes all sources of a part
of the tree, and the headers are read only once. A source that does not compile together with the others (because of a local name that exists
twice) goes into the next such file. The static analyser does not analyse joined sources; --each checks every source separately, with the analyser.

A clean source is not checked again until its text, an included header, its compiler flags or the rules of clang-tidy change: BUILD_FOLDER/tidy/ contains
an empty file for each clean state, whose name is the hash of the state. The list of included headers comes from Ninja.
"""

import concurrent.futures
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST_S = 900
PARTS = ("bench/", "dbc/", "target/", "tests/unit/", "tests/")  # a source belongs to the first part with which its path begins
ANALYSER = {True: "clang-analyzer-*", False: "-clang-analyzer-*"}


class Source:
    def __init__(self, entry):
        self.file = entry["file"]
        self.name = os.path.relpath(self.file, ROOT)
        self.object = None
        self.flags = []  # tuples: (option,) or (option, value)
        words = iter(shlex.split(entry["command"]))
        for word in words:
            if word == "-o":
                self.object = next(words)
            elif word in ("-I", "-isystem"):
                self.flags.append((word, next(words)))
            elif word.startswith("-") and word not in ("-c", "-Werror"):
                self.flags.append((word,))
        self.macros = {flag[0].partition("=")[0]: flag for flag in self.flags if flag[0].startswith("-D")}


def sources_of(build):
    """The project's sources that compile_commands.json lists, each once; generated sources are left out."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        files = [entry["file"]]
        if Path(files[0]).parent.name == "Unity":  # a generated file that includes several sources, to compile them as one
            files = re.findall(r'^#include "(/.*)"$', Path(files[0]).read_text(), re.MULTILINE)
        for name in files:
            file = Path(name)
            if file.is_relative_to(ROOT) and not file.is_relative_to(build):
                found[name] = Source({**entry, "file": name})
    return list(found.values())


def recorded_includes(build):
    """{object file: [files that it was built from]}, for the object files whose dependencies Ninja lists as valid."""
    text = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    found = {}
    for block in text.split("\n\n"):
        head, *files = [line.strip() for line in block.strip().splitlines()] or [""]
        if head.endswith("(VALID)"):
            found[head.split(":")[0]] = [os.path.join(build, file) for file in files]
    return found


class Cache:
    """Remembers in BUILD_FOLDER/tidy which versions of the sources were clean."""

    def __init__(self, build, each):
        self.folder = build / "tidy"
        self.folder.mkdir(exist_ok=True)
        self.rules = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
        self.rules += (ROOT / ".clang-tidy").read_bytes() + ANALYSER[each].encode()
        self.includes = recorded_includes(build)
        self.hashes = {}

    def hash_of(self, path):
        if path not in self.hashes:
            self.hashes[path] = hashlib.sha256(Path(path).read_bytes()).digest()
        return self.hashes[path]

    def state_of(self, source):
        """The path of a file that exists if this version of the source was found clean before. None if the source
        has not been compiled."""
        files = self.includes.get(source.object)
        if files is None:
            return None
        digest = hashlib.sha256(self.rules + repr(source.flags).encode())
        for path in [source.file, *sorted(files)]:
            if os.path.isfile(path):
                digest.update(self.hash_of(path))
        return self.folder / digest.hexdigest()

    def holds(self, source):
        state = self.state_of(source)
        return state is not None and state.exists()

    def keep(self, source):
        state = self.state_of(source)
        if state:
            state.touch()


def run(*command):
    try:
        ended = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, timeout=LONGEST_S)
        return ended.returncode == 0, ended.stdout + ended.stderr
    except subprocess.TimeoutExpired:
        return False, f"{command[0]}: not done after {LONGEST_S} s"


def flags_of(sources):
    return [word for flag in dict.fromkeys(f for source in sources for f in source.flags) for word in flag]


def write_joined(file, sources):
    """Writes a file that includes the sources, with three lines for each source. Renames every main() except
    the first, because one file can define main() only once."""
    text, mains = "", 0
    for source in sources:
        mains += re.search(r"^int main\(", Path(source.file).read_text(), re.MULTILINE) is not None
        text += f"#define main main_{mains}\n" if mains > 1 else "\n"
        text += f'#include "{source.file}"  // NOLINT\n'
        text += "#undef main\n"
    file.write_text(text)


def wrong_ones(file, sources, output):
    """The sources that caused compiler errors: an error is in the source itself, or in a header that no earlier
    source included."""
    found, number = set(), None
    for line in output.splitlines():
        stack = re.match(rf"In file included from {re.escape(str(file))}:(\d+):", line)
        if stack:  # the compiler prints the include stack only when it changes
            number = int(stack[1]) // 3
        elif number is not None and re.search(r": (fatal )?error: ", line):
            found.add(sources[number].file)
    return found


def join(file, sources):
    """Writes a file that includes those of the sources that can be compiled together; returns these sources."""
    held, macros = [], {}
    for source in sources:
        if all(macros.setdefault(name, flag) == flag for name, flag in source.macros.items()):
            held.append(source)
    while True:
        write_joined(file, held)
        compiles, output = run("clang++", "-fsyntax-only", "-w", "-ferror-limit=0", *flags_of(held), file)
        wrong = wrong_ones(file, held, output)
        rest = [source for source in held if source.file not in wrong] or held[:1]
        if compiles or len(rest) == len(held):
            return held  # if these sources still do not compile, clang-tidy reports why
        held = rest


def main():
    arguments = [word for word in sys.argv[1:] if word != "--each"]
    each = len(arguments) < len(sys.argv) - 1
    build = Path(arguments[0]).resolve()
    chosen = [s for s in sources_of(build) if not arguments[1:] or any(part in s.name for part in arguments[1:])]
    if not chosen:
        sys.exit(f"tidy.py: {build}/compile_commands.json names no such source of the project, expected some")
    cache = Cache(build, each)
    open_ = [source for source in chosen if not cache.holds(source)]
    unclean = []

    def tidy(file, sources):
        start = time.monotonic()
        clean, output = run("clang-tidy", "--quiet", f"--checks={ANALYSER[each]}", file, "--", *flags_of(sources))
        what = sources[0].name if len(sources) == 1 else f"{len(sources)} sources like {sources[0].name}"
        print(f"{what}: {time.monotonic() - start:.0f} s", flush=True)
        if clean:
            for source in sources:
                cache.keep(source)
        else:
            unclean.append(what)
            print(output, flush=True)

    def tidy_part(part):
        left = [s for s in open_ if next(p for p in (*PARTS, "") if s.name.startswith(p)) == part]
        while left:
            file = cache.folder / f"{part.replace('/', '_')}.cpp"
            held = join(file, left)
            tidy(file, held)
            left = [source for source in left if source not in held]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        if each:
            list(pool.map(lambda source: tidy(source.file, [source]), open_))
        else:
            list(pool.map(tidy_part, (*PARTS, "")))
    print(f"clang-tidy: {len(chosen)} sources, {len(open_)} checked now, not clean: {'; '.join(unclean) or 'none'}")
    sys.exit(bool(unclean))


if __name__ == "__main__":
    main()
