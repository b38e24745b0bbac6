"""The table of a run's quantities, which `hil-bench run --csv` writes."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_NUMBERS = ("t_s", "estimate", "truth", "error", "sigma")


@dataclass(frozen=True)
class Series:
    """A quantity over the run, in SI units and radians: lists of one length. NaN: the target sent no value."""

    estimator: str
    name: str
    unit: str
    t_s: list[float]
    """Times of validity of the measurements that were answered."""
    estimate: list[float]
    """What the target reported; statistics and innovations too. For an output of a plant: NaN."""
    truth: list[float]
    error: list[float]
    sigma: list[float]

    def __len__(self) -> int:
        return len(self.t_s)

    def pandas(self) -> Any:
        """A pandas.DataFrame with the index t_s and the columns estimate, truth, error and sigma."""
        import pandas

        columns = {name: getattr(self, name) for name in _NUMBERS[1:]}
        return pandas.DataFrame(columns, index=pandas.Index(self.t_s, name="t_s"))


class Table:
    """Reads a table once, when something is asked of it."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._series: dict[tuple[str, str], Series] = {}

    def all(self) -> dict[tuple[str, str], Series]:
        """The series by estimator and quantity, in the order of the table."""
        if not self._series:
            with self._path.open(newline="", encoding="utf-8") as file:
                self._read(csv.reader(file))
        return self._series

    def _read(self, rows: Iterator[list[str]]) -> None:
        columns = {name: place for place, name in enumerate(next(rows, []))}
        key_of = [columns[name] for name in ("estimator", "quantity")]
        places = [columns[name] for name in _NUMBERS]
        for row in rows:
            key = (row[key_of[0]], row[key_of[1]])
            series = self._series.get(key)
            if series is None:
                series = Series(*key, row[columns["unit"]], [], [], [], [], [])
                self._series[key] = series
            lists = (series.t_s, series.estimate, series.truth, series.error, series.sigma)
            for values, place in zip(lists, places):
                values.append(float(row[place]) if row[place] else math.nan)
