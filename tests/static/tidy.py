"""Runs clang-tidy on every source of a build folder, in parallel: tidy.py BUILD_FOLDER [NAME_PART...]

A file that was clean is not checked again until its text, a header it includes, its flags or the rules change:
BUILD_FOLDER/tidy/ holds one empty file for each such state, named by its hash. What a file includes is what Ninja recorded.
"""

import concurrent.futures
import hashlib
import json
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LONGEST_S = 900


def recorded_includes(build):
    """{object file: [files it was built from]}, for those whose record is up to date."""
    text = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    found = {}
    for block in text.split("\n\n"):
        head, *files = [line.strip() for line in block.strip().splitlines()] or [""]
        if head.endswith("(VALID)"):
            found[head.split(":")[0]] = [os.path.join(build, file) for file in files]
    return found


def main():
    build = Path(sys.argv[1]).resolve()
    parts = sys.argv[2:]
    cache = build / "tidy"
    cache.mkdir(exist_ok=True)
    commands = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = Path(entry["file"])
        if file.is_relative_to(ROOT) and not file.is_relative_to(build):
            commands.append(entry)
    if not commands:
        sys.exit(f"tidy.py: {build}/compile_commands.json names no source of the project, expected all of them")

    rules = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    rules += (ROOT / ".clang-tidy").read_bytes()
    includes = recorded_includes(build)
    hashes = {}

    def hash_of(path):
        if path not in hashes:
            hashes[path] = hashlib.sha256(Path(path).read_bytes()).digest()
        return hashes[path]

    def state_of(entry):
        files = includes.get(entry.get("output"))
        if files is None:
            return None  # not built: nothing known, always checked
        digest = hashlib.sha256(rules + entry["command"].encode())
        for path in [entry["file"], *sorted(files)]:
            if os.path.isfile(path):
                digest.update(hash_of(path))
        return cache / digest.hexdigest()

    def tidy(entry):
        name = os.path.relpath(entry["file"], ROOT)
        state = state_of(entry)
        if state and state.exists():
            return name, 0.0, True, ""
        start = time.monotonic()
        try:
            run = subprocess.run(["clang-tidy", "-p", build, "--quiet", entry["file"]], capture_output=True, text=True,
                                 cwd=ROOT, timeout=LONGEST_S)
            clean, output = run.returncode == 0, run.stdout + run.stderr
        except subprocess.TimeoutExpired:
            clean, output = False, f"not done after {LONGEST_S} s"
        if clean and state:
            state.touch()
        return name, time.monotonic() - start, clean, output

    chosen = [c for c in commands if not parts or any(p in c["file"] for p in parts)]
    checked, unclean = 0, []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, (name, seconds, clean, output) in enumerate(pool.map(tidy, chosen), 1):
            if seconds:
                checked += 1
                print(f"[{done}/{len(chosen)}] {name} {seconds:.1f} s", flush=True)
            if not clean:
                unclean.append(name)
                print(output, flush=True)
    print(f"clang-tidy: {len(chosen)} files, {checked} checked now, {len(unclean)} not clean: {' '.join(unclean) or 'none'}")
    sys.exit(bool(unclean))


if __name__ == "__main__":
    main()
