"""The parts of a report: verdict, judgements, latencies, answers, flags (docs/report.md has their meaning)."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

Json = dict[str, Any]


class Verdict(enum.Enum):
    """The outcome of a run or of a check."""

    PASS = "pass"
    FAIL = "fail"
    NOT_MEASURED = "not measured"

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True)
class Judgement:
    """What the bench found for one check, in words and in numbers."""

    name: str
    kind: str
    outcome: Verdict
    measured: str
    expected: str
    requirement: str = ""
    quantity: str = ""
    estimator: str = ""
    statistic: str = ""
    value: float | None = None
    """The measured value, in `unit`, as the limits are; None: the check has no number, or nothing was measured."""
    lower: float | None = None
    upper: float | None = None
    unit: str = ""
    margin: float | None = None
    """Distance from the value to the nearest limit, as a share of this limit; negative beyond the limit."""
    count: int | None = None
    worst_at_s: float | None = None

    def __bool__(self) -> bool:
        """Whether the check passed, so that `assert run.judgement("latency")` can be written."""
        return self.outcome is Verdict.PASS


def judgement_of(check: Mapping[str, Any]) -> Judgement:
    """The judgement that an element of a report's `checks` holds."""
    known = {name: check[name] for name in Judgement.__dataclass_fields__ if name in check and name != "outcome"}
    return Judgement(outcome=Verdict(check["outcome"]), **known)


@dataclass(frozen=True)
class Latency:
    """The latencies of the answers in one message, in s."""

    count: int
    unanswered: int
    min: float | None = None
    p50: float | None = None
    p90: float | None = None
    p99: float | None = None
    p999: float | None = None
    max: float | None = None
    buckets_us: tuple[tuple[int, int], ...] = ()
    """How many latencies are in each bucket: its lower bound in us, and the count."""


def latency_of(distribution: Mapping[str, Any]) -> Latency:
    """The latency that an element of a report's `latency_s` holds."""
    known = {name: distribution[name] for name in Latency.__dataclass_fields__ if name in distribution}
    known["buckets_us"] = tuple((start, count) for start, count in known.get("buckets_us", ()))
    return Latency(**known)


@dataclass(frozen=True)
class Answers:
    """How many answers of a kind the target had to send, and how many came."""

    due: int
    came: int


@dataclass(frozen=True)
class Flag:
    """A flag of the target: the first answer that could report it, and each change."""

    estimator: str
    name: str
    changes: tuple[tuple[float, bool], ...]
    change_count: int


def flag_of(flag: Mapping[str, Any]) -> Flag:
    """The flag that an element of a report's `flags` holds."""
    changes = tuple((float(t_s), bool(is_set)) for t_s, is_set in flag["changes"])
    return Flag(flag["estimator"], flag["name"], changes, flag["change_count"])
