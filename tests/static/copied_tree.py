"""A copy of the project that can be changed and built separately.

Unchanged files of the copy are not written again, so that its build is incremental.
"""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PARTS = ("CMakeLists.txt", "CMakePresets.json", "README.md", "bench", "cmake", "dbc", "docs", "target", "tests")


def copy_tree(target, changed=lambda name, content: content, made=()):
    """Copies the project into the folder `target`. The content of each file is changed(name, content).

    Deletes files of the copy that the project does not have. `made` are files that the build of the copy
    generates: they are copied only if they do not exist."""
    names = set()
    for part in PARTS:
        path = ROOT / part
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            if file.is_dir() or "__pycache__" in file.parts:
                continue
            name = file.relative_to(ROOT).as_posix()
            names.add(name)
            to, content = target / name, changed(name, file.read_bytes())
            if name in made and to.exists():
                continue
            if to.exists() and to.read_bytes() == content:
                continue
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes(content)
            to.chmod(file.stat().st_mode)
    for part in PARTS:
        for file in (target / part).rglob("*"):
            if file.is_file() and file.relative_to(target).as_posix() not in names:
                file.unlink()  # the project does not have this file
