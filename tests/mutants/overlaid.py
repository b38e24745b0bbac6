"""Builds a target with one file replaced: compiles all sources that read the file, and links them with the existing objects.

build(folder, name, file, text) returns the path of the program. All information comes from the build folder: `ninja -t deps` lists the object files
whose compilation reads the file, `ninja -t compdb` lists their compiler commands, `ninja -t commands` lists the command that links the target.
"""
import functools
import json
import re
import shlex
import shutil
import subprocess
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class DoesNotBuild(Exception):
    """Holds the first error line of the compiler or linker."""


ONE_AT_A_TIME = threading.Lock()  # ninja may rewrite its log of dependencies when it reads it


def ask(folder, *words):
    with ONE_AT_A_TIME:
        return subprocess.run(["ninja", "-C", str(folder), "-t", *words], capture_output=True, text=True, check=True).stdout


@functools.lru_cache(maxsize=None)
def readers(folder):
    """{file: object files of the target whose compilation reads this file}. The keys are absolute. (Ninja records
    absolute names, or names relative to the build folder; this depends on the compiler and on ccache.)"""
    found, name = {}, None
    for line in ask(folder, "deps").splitlines():
        if line and not line.startswith(" "):
            name = line.split(":", 1)[0]
        elif line and name.startswith("target/"):
            found.setdefault(line.strip(), set()).add(name)
    whole = {}
    for file, names in found.items():
        whole.setdefault((folder / file).resolve(), set()).update(names)
    return whole


@functools.lru_cache(maxsize=None)
def compilations(folder):
    """{object file: compiler command}"""
    return {entry["output"]: entry["command"] for entry in json.loads(ask(folder, "compdb")) if entry["output"].endswith(".o")}


@functools.lru_cache(maxsize=None)
def linking(folder):
    """The command line that links the target, as a list of words."""
    last = [line for line in ask(folder, "commands", "hil-target").splitlines() if "-o hil-target" in line][-1]
    return shlex.split(re.sub(r"^: && (.*?) && :$", r"\1", last))


def source_again(place, file, source):
    """The file to compile in place of `source`. If `source` is the changed file, this is the changed copy in `place`. If `source` includes
    several files to compile them as one, this is a version of `source` that includes the changed copy."""
    if Path(source) == ROOT / file:
        return place / file
    if "/Unity/" not in source:
        return source
    was = Path(source).read_text()
    text = was.replace(f'"{ROOT / file}"', f'"{place / file}"')
    if text == was and Path(file).suffix == ".cpp":
        raise DoesNotBuild(f"{file}: not in {source}, which reads it")
    again = place / source.split("/CMakeFiles/", 1)[1]
    again.parent.mkdir(parents=True, exist_ok=True)
    again.write_text(text)
    return again


def compile_again(folder, place, file, name):
    """Compiles the object file `name` again, with the changed file in `place`; returns the path of the new object file."""
    words, again = shlex.split(compilations(folder)[name]), place / name
    again.parent.mkdir(parents=True, exist_ok=True)
    kept, skip = [], 0
    for word in words:
        if skip:
            skip -= 1
        elif word in ("-MT", "-MF", "-o"):
            skip = 1
        elif word != "-MD":
            kept.append(str(source_again(place, file, word)) if word.endswith((".cpp", ".cxx")) else word)
    first = next(i for i, word in enumerate(kept) if word.startswith("-I"))
    kept[first:first] = [f"-I{place}"]  # the compiler searches `place` before the project's own folders
    finished = subprocess.run([*kept, "-o", str(again)], cwd=folder, capture_output=True, text=True)
    if finished.returncode != 0:
        lines = [line for line in finished.stderr.splitlines() if re.search(r"\berror\b", line)]
        raise DoesNotBuild((lines or finished.stderr.splitlines() or ["no output"])[0])
    return again


def linked(folder, place, file):
    """Builds the target in the folder `place`, with the changed file of this folder instead of the project's file."""
    names = sorted(readers(folder).get(ROOT / file, ()))
    if not names:
        raise DoesNotBuild(f"{file}: no object of the target reads it")
    again = {one: compile_again(folder, place, file, one) for one in names}
    words = linking(folder)
    words = [str(again.pop(word)) if word in again else word for word in words]
    target = place / "hil-target"
    at = words.index("-o")
    # The recompiled object files precede the libraries, which contain the old object files: the linker uses the first definition.
    words[at:at + 2] = [str(one) for one in again.values()] + ["-o", str(target)]
    finished = subprocess.run(words, cwd=folder, capture_output=True, text=True)
    if finished.returncode != 0:
        raise DoesNotBuild((finished.stderr.splitlines() or ["no output"])[-1])
    return target


def build(folder, name, file, text):
    place = folder / "mutants" / name
    (place / file).parent.mkdir(parents=True, exist_ok=True)
    (place / file).write_text(text)
    try:
        return linked(folder, place, file)
    except DoesNotBuild:
        shutil.rmtree(place)
        raise


def remove(target):
    shutil.rmtree(target.parent)
