#!/usr/bin/python3
"""Draws the curves of bench/figure10.cpp: figure10.py FIGURE10.csv OUT.png [bare|loaded]"""

import csv
import sys
from collections import defaultdict

import numpy as np
from matplotlib.lines import Line2D

import style

COLOURS = {"0.14 rad, cosine": style.BLUE, "0.14 rad, sine": style.GREEN, "0.14°, cosine": style.VERMILLION,
           "0.14°, sine": style.PURPLE}
LAMBDA_C = 30 * np.pi  # bandwidth of the sliding controller [rad/s]


def read(path, inertia):
    """Returns {(reading, controller): (radius, error)} of one inertia."""
    curves = defaultdict(list)
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            reading, _, of = row["reading"].rpartition(", ")
            if of == inertia:
                curves[reading, row["controller"]].append(
                    (float(row["radius_rad_per_s"]), float(row["error_peak_to_peak_rad"])))
    return {key: np.array(points).T for key, points in curves.items()}


def draw(curves, inertia):
    """Returns the figure: error of the PID over its bandwidth, that of the sliding controller as a line."""
    figure = style.new_figure(f"Fig. 10, {inertia} gear: error of the PID over its bandwidth, "
                              "and of sliding control")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    for panel, controller, words in zip(panels, ("pid", "pid_feedforward"), ("PID", "PID with feedforward")):
        for reading, colour in COLOURS.items():
            radius, error = curves[reading, controller]
            kept = np.isfinite(error)
            panel.loglog(radius[kept], error[kept], "o-", color=colour, markersize=3.5, zorder=3)
            panel.axhline(curves[reading, "sliding"][1][0], color=colour, linestyle=(0, (5, 2)), linewidth=1.3)
        panel.axvline(LAMBDA_C, color=style.INK, linewidth=1.0)
        panel.annotate("$\\lambda_c$", (LAMBDA_C, 0.985), (5, 0), xycoords=("data", "axes fraction"), va="top",
                       textcoords="offset points")
        panel.set_title(words, loc="left", size=13, pad=10)
        panel.set(xlabel="pole radius p [rad/s]")
    panels[0].set(ylabel="error, peak to peak [rad]")
    handles = [Line2D([], [], color=colour, label=reading) for reading, colour in COLOURS.items()]
    handles.append(Line2D([], [], color=style.INK, linestyle=(0, (5, 2)), label="sliding"))
    panels[0].legend(handles=handles, loc="lower left")
    return figure


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    chosen = sys.argv[3] if len(sys.argv) == 4 else "bare"
    draw(read(sys.argv[1], chosen), chosen).savefig(sys.argv[2])
