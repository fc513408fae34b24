"""The picture of the efficiency: what comes out of the drive over what goes in, over worm speed and load torque."""

import numpy as np

import style
from result import NotAResult, attribute, columns, group, text, units

LEVELS = np.arange(0, 101, 5)  # [%]


def grid(speed, load, share):
    """Returns the axes of the map and the efficiency on it, a row for each load."""
    speeds, loads = np.unique(speed), np.unique(load)
    if speeds.size * loads.size != share.size or speeds.size < 2:
        raise NotAResult("'/efficiency' is not a grid of speeds and loads")
    order = np.lexsort((speed, load))
    return speeds, loads, share[order].reshape(loads.size, speeds.size)


def draw_quadrant(axes, speeds, loads, share):
    """Draws the map where speeds and loads keep their signs, beyond which it jumps; returns what a colour bar needs."""
    percent = np.ma.masked_invalid(100.0 * share)
    filled = axes.contourf(speeds, loads, percent, levels=LEVELS, cmap="Blues", extend="max")
    for where, colour in ((share == 0.0, style.STUCK), (np.isnan(share), style.PALE_ORANGE)):
        if where.any():
            axes.contourf(speeds, loads, np.ma.masked_where(~where, np.ones_like(share)), [0.5, 1.5], colors=[colour])
    there = percent.compressed()
    crossed = LEVELS[(LEVELS > np.min(there, initial=100.0)) & (LEVELS < np.max(there, initial=0.0))]
    if crossed.size:
        lines = axes.contour(speeds, loads, percent, levels=crossed, colors=style.INK, linewidths=0.7)
        axes.clabel(lines, crossed[-4:], fmt="%d %%", fontsize=10)  # below they crowd towards no load
    return filled


def draw(result):
    """Returns the figure of the efficiency map."""
    table = group(result, "efficiency")
    speeds, loads, share = grid(*columns(table, "worm_speed", "load_torque", "efficiency"))
    factor, unit = style.scale(units(table, "load_torque"), loads)
    figure = style.new_figure(text(attribute(result, "title")))
    axes = figure.subplots()
    for fast in (speeds < 0.0, speeds > 0.0):
        for heavy in (loads < 0.0, loads > 0.0):
            if fast.sum() < 2 or heavy.sum() < 2:
                raise NotAResult("'/efficiency' has fewer than two speeds or loads of a sign")
            filled = draw_quadrant(axes, speeds[fast], factor * loads[heavy], share[np.ix_(heavy, fast)])
    for x, y, words in ((0.98, 0.02, "the motor drives"), (0.02, 0.98, "the motor drives"),
                        (0.98, 0.98, "the load drives"), (0.02, 0.02, "the load drives")):
        axes.text(x, y, words, transform=axes.transAxes, ha="right" if x > 0.5 else "left",
                  va="top" if y > 0.5 else "bottom",
                  bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 2.5})
    note = "grey: the motor has to help the load along, nothing comes back"
    if np.isnan(share).any():
        note += "; orange: no motor torque keeps this speed"
    axes.set_title(note, loc="left", size=12)
    figure.colorbar(filled, ax=axes, pad=0.015).set_label("efficiency [%]")
    axes.grid(False)
    axes.set(xlabel=f"worm speed [{units(table, 'worm_speed')}]", ylabel=f"load torque [{unit}]")
    return figure
