"""Scripts for hil-bench, a hardware-in-the-loop bench over CAN.

The package starts the programs of the bench and reads what they write. It judges and computes nothing itself.

>>> import canhil
>>> run = canhil.run("bench/flights/los_quick.toml", bus="in-process")
>>> run.verdict
<Verdict.NOT_MEASURED: 'not measured'>
>>> worst = run.judgement("miss_distance")
>>> worst.outcome, worst.value < worst.upper, worst.unit
(<Verdict.PASS: 'pass'>, True, 'm')
>>> rate = run.series("los.rate.pitch")
>>> rate.unit, len(rate.t_s) == len(rate.error) > 1000
('rad/s', True)
"""

from canhil import golden, partner
from canhil.acceptance import Acceptance, Requirement, accept
from canhil.campaigns import Answer, Campaign, campaign
from canhil.comparison import Comparison, Difference, compare
from canhil.errors import Error
from canhil.flights import Run, run
from canhil.live import Flight, live
from canhil.program import bench_program
from canhil.report import Answers, Flag, Judgement, Latency, Verdict
from canhil.table import Series

__all__ = [
    "Acceptance",
    "Answer",
    "Answers",
    "Campaign",
    "Comparison",
    "Difference",
    "Error",
    "Flight",
    "Flag",
    "Judgement",
    "Latency",
    "Requirement",
    "Run",
    "Series",
    "Verdict",
    "accept",
    "bench_program",
    "campaign",
    "compare",
    "golden",
    "live",
    "partner",
    "run",
]
