#!/usr/bin/python3
"""Draws the acceleration of fig. 9 around its first flank change and a reversal: figure9.py OUT.png RUN.h5 ...

Every run has its own flank change and reversal; they are laid over each other. Above the acceleration, below its rate.
"""

import sys

import h5py
import numpy as np
from matplotlib.lines import Line2D

import run
import style
from result import attribute, column, columns, group, text

COLOURS = [style.INK, style.VERMILLION, style.GREEN, style.BLUE]
WINDOWS = {"flank change": ({"flank_change", "opening"}, 30.0), "reversal": ({"reversal"}, 30.0)}  # kinds, [ms]
AFTER = 0.2  # [s]: the first events follow the start too closely
RIGID = 3  # as many of the runs set the scales; impacts go beyond them


def moment(events, kinds, after):
    """Time of the first event of these kinds after a time, and the next one."""
    found = run.event_kinds(events)
    rows = np.sort(np.concatenate([found[kind] for kind in kinds if kind in found]))
    times = column(events, "time")[rows]
    return times[times > after][0]


def curves(path, kinds, half):
    """Returns time from the event [ms], acceleration, the middles of the rows and its rate there [10^3 rad/s^3]."""
    with h5py.File(path) as result:
        trajectory, events = group(result, "trajectory"), group(result, "events")
        time, acceleration = columns(trajectory, "time", "gear_acceleration")
        t = 1e3 * (time - moment(events, kinds, AFTER))
        near = np.abs(t) <= half
        t, a = t[near], acceleration[near]
        rate, middle = np.diff(a) / np.maximum(np.diff(t), 1e-9), 0.5 * (t[1:] + t[:-1])
        return t, a, middle, np.where(np.abs(np.diff(a)) > 0.5, np.nan, rate)  # a jump has no rate


def main():
    out, *files = sys.argv[1:]
    figure = style.new_figure("Fig. 9: acceleration of the gear around a flank change and a reversal")
    figure.set_figheight(9.0)
    panels = figure.subplots(2, 2, sharex="col")
    for (upper, lower), (name, (kinds, half)) in zip(panels.T, WINDOWS.items()):
        drawn = [curves(path, kinds, half) for path in files]
        for (t, a, middle, rate), colour in zip(drawn, COLOURS):
            upper.plot(t, a, color=colour)
            lower.plot(middle, rate, color=colour)
        upper.set(ylim=style.limits(np.concatenate([c[1] for c in drawn[:RIGID]]), 0.25))
        lower.set(ylim=style.limits(np.concatenate([c[3] for c in drawn[:RIGID]]), 0.25),
                  xlabel=f"time from the {name} [ms]")
        for panel in upper, lower:
            panel.axvline(0.0, color=style.EVENT, linewidth=0.8)
    panels[0, 0].set(ylabel="gear acceleration [rad/s²]")
    panels[1, 0].set(ylabel="its rate [10³ rad/s³]")
    lines = []
    for path, colour in zip(files, COLOURS):
        with h5py.File(path) as result:
            label = text(attribute(result, "title")).split(":")[0]
        lines.append(Line2D([], [], color=colour, label=label))
    panels[0, 0].legend(handles=lines, loc="lower right")
    figure.savefig(out)


if __name__ == "__main__":
    main()
