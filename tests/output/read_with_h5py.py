#!/usr/bin/env python3
"""Reads a wormdrive run as any user of h5py would: read_with_h5py.py RUN.h5 prints one line a column.

    trajectory/gear_speed: 2013 float64 over time, rad/s, gear speed theta_g'
    trajectory/motion: 2013 int8 over time, -1 backward 0 stuck 1 forward, sign of the gear speed

Ends with an error if a column has neither units nor flags, is no column over an attached time axis, or if times do not
increase strictly (in /events: decrease).
"""

import sys

import h5py
import numpy


def meaning(column):
    """Returns the units of a column, or what its flags mean."""
    if "units" in column.attrs:
        return column.attrs["units"]
    return " ".join(f"{value} {word}" for value, word in zip(column.attrs["flag_values"],
                                                             column.attrs["flag_meanings"].split(), strict=True))


def describe(table):
    """Prints every column of a table and checks that it stands over the table's time."""
    times = table["time"]
    assert h5py.h5ds.is_scale(times.id), f"{times.name} is no dimension scale"
    for name, column in table.items():
        assert column.shape == times.shape, f"{column.name} is longer or shorter than {times.name}"
        if name != "time":
            scales = list(column.dims[0].values())
            assert scales == [times], f"{column.name} does not stand over {times.name}"
        if "flag_values" in column.attrs:
            assert column.attrs["flag_values"].dtype == column.dtype
            assert set(column[:]) <= set(column.attrs["flag_values"]), f"{column.name} has values without a meaning"
        print(f"{column.name[1:]}: {len(column)} {column.dtype} over time, {meaning(column)}, {column.attrs['long_name']}")


with h5py.File(sys.argv[1], "r") as run:
    describe(run["trajectory"])
    describe(run["events"])
    assert (numpy.diff(run["trajectory/time"]) > 0).all(), "times do not increase"
    assert (numpy.diff(run["events/time"]) >= 0).all(), "events are not in order"
    print(f"{run.attrs['kind']} of '{run.attrs['title']}' by {run.attrs['command_line']}")
