"""Prints the estimated heading once a second, with its sigma: heading.py run.csv

run.csv comes from `hil-bench decode run.log --dbc dbc/canhil.dbc --format csv --out run.csv`. A row of the table is a
frame, so a cell is empty if the signal belongs to another message.
"""
import sys

import numpy
import pandas

table = pandas.read_csv(sys.argv[1])


def signal(name):
    """The times and values of one signal."""
    return table[["t_s", name]].dropna().rename(columns={name: name.split(".")[1]})


heading = signal("AlignAttitude.heading_deg")
sigma = signal("AlignAttitudeSigma.attitude_sigma_down_rad")
# For each heading, the newest sigma before it.
estimate = pandas.merge_asof(heading, sigma, on="t_s")
estimate["sigma_deg"] = numpy.degrees(estimate.pop("attitude_sigma_down_rad"))
print(estimate.groupby(estimate["t_s"].astype(int)).last().to_string(index=False))
