"""Reads the seeded defects of the target from the files in this folder: one file per family, one table [[mutant]] per defect.

Keys of a mutant: `name`; `file`; `was`, the original text, which occurs once in the file; `is`, the text that replaces `was`; `what`, a description
of the defect; `real_time = true` for a defect that affects only timing.
"""
import pathlib
import tomllib
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent
KEYS = {"name", "file", "was", "is", "what"}

# The families, and the smallest permitted number of mutants in each family.
FAMILIES = {"strapdown": 12, "imu_stream": 6, "transfer_alignment": 18, "inflight_alignment": 22, "los_rate": 14, "wind": 14,
            "device": 12, "timing": 4}
AT_LEAST = 95


@dataclass(frozen=True)
class Mutant:
    family: str
    name: str
    file: str
    was: str
    then: str
    what: str
    real_time: bool = False

    @property
    def full_name(self):
        return f"{self.family}.{self.name}"

    def applied(self, text):
        """The file's text with the defect inserted."""
        times = text.count(self.was)
        if times != 1:
            raise ValueError(f"{self.full_name}: its text is {times} times in {self.file}, expected once")
        return text.replace(self.was, self.then)


def mutants_of(family, text):
    """The mutants in the text of a family's file, in the same order."""
    read = tomllib.loads(text)
    if set(read) != {"mutant"}:
        raise ValueError(f"{family}: holds {', '.join(sorted(read)) or 'nothing'}, expected tables [[mutant]] and nothing else")
    found = []
    for number, table in enumerate(read["mutant"], 1):
        real_time = table.pop("real_time", False)
        if set(table) != KEYS or not all(isinstance(value, str) for value in table.values()) or not isinstance(real_time, bool):
            raise ValueError(f"{family}: mutant {number} has {', '.join(sorted(table))}, expected texts {', '.join(sorted(KEYS))}")
        found.append(Mutant(family, table["name"], table["file"], table["was"], table["is"], table["what"], real_time))
    return found


def equivalents():
    """{full name: proof} of the mutants that equivalent.toml lists as equivalent to the original."""
    read = tomllib.loads((HERE / "equivalent.toml").read_text())
    return {one["name"]: " ".join(one["proof"].split()) for one in read["equivalent"]}


def all_mutants():
    """The mutants of all families, in the order of FAMILIES."""
    return [mutant for family in FAMILIES for mutant in mutants_of(family, (HERE / f"{family}.toml").read_text())]
