"""A copy of the project that can be changed and built separately.

Files of the copy that have not changed are not written again, so that the copy is built incrementally.
"""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("CMakeLists.txt", "CMakePresets.json", "README.md", "bench", "cmake", "dbc", "docs", "python", "target", "tests")


def write(file, content):
    """Writes the file, unless the file already has this content. Returns the file."""
    if not file.exists() or file.read_bytes() != content:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content)
    return file


def copy_tree(target, changed=lambda name, content: content, made=(), added=None):
    """Copies the project into the folder `target`. The content of each file is changed(name, content).

    Deletes files of the copy that the project does not have. `made`: names of files that the build of the copy
    generates; such a file is copied only if the copy does not have it yet. `added`: {name: content} of further
    files for the copy."""
    names = set(added or ())
    for part in PARTS:
        path = ROOT / part
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            if file.is_dir() or "__pycache__" in file.parts:
                continue
            name = file.relative_to(ROOT).as_posix()
            names.add(name)
            if name in made and (target / name).exists():
                continue
            write(target / name, changed(name, file.read_bytes())).chmod(file.stat().st_mode)
    for name, content in (added or {}).items():
        write(target / name, content)
    for part in PARTS:
        for file in (target / part).rglob("*"):
            if file.is_file() and file.relative_to(target).as_posix() not in names:
                file.unlink()  # neither the project nor `added` has this file
