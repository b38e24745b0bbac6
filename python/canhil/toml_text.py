"""Values of Python as TOML text, for settings and faults. (Python's tomllib only reads.)"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Union

Value = Union[str, bool, int, float, Sequence["Value"], Mapping[str, "Value"]]
"""What a key of a scenario may have."""


def toml_value(value: Value) -> str:
    """The text of one value.

    >>> toml_value({"kind": "bias", "by_degps": 10.0, "axes": [1, 2]})
    '{"kind" = "bias", "by_degps" = 10.0, "axes" = [1, 2]}'
    """
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else {"inf": "inf", "-inf": "-inf"}.get(repr(value), "nan")
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{toml_value(key)} = {toml_value(one)}" for key, one in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    if hasattr(value, "item"):  # a number of numpy
        return toml_value(value.item())
    raise TypeError(f"{type(value).__name__} is not a value of TOML, expected a string, number, list or dict")


def toml_tables(name: str, tables: Iterable[Mapping[str, Value]]) -> str:
    """A file with an array of tables.

    >>> print(toml_tables("fault", [{"kind": "lost", "from_s": 2}]), end="")
    [[fault]]
    "kind" = "lost"
    "from_s" = 2
    """
    lines: list[str] = []
    for table in tables:
        lines.append(f"[[{name}]]")
        lines += [f"{toml_value(key)} = {toml_value(value)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"
