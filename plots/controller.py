"""What a controlled run shows besides: its reference, and a panel with the tracking error."""

import numpy as np

import style
from result import NotAResult, attribute, column, columns, group, text, units


def samples(result):
    """Returns the controller's samples, nothing for a run without controller or before its first sample."""
    if "controller" not in result:
        return None
    table = group(result, "controller")
    return table if column(table, "time").size else None


def follows(result):
    """Returns whether a controlled run has a reference, without which there is no tracking error."""
    lines = text(attribute(result, "scenario")).splitlines()
    return any(line.startswith(("[reference]", "[[reference]]")) for line in lines)


def draw_reference(panel, table, factor):
    """Draws the reference over the gear angle and returns its line."""
    time, reference = columns(table, "time", "reference_angle")
    return panel.plot(*style.decimate(time, factor * reference), color=style.VERMILLION, linestyle=(0, (5, 2)),
                      linewidth=1.4, zorder=4, label="reference")[0]


def draw_error(panel, table):
    """Draws the tracking error of the true angle at the samples, and what Lemma 1 promises if it is near."""
    time, angle, reference = columns(table, "time", "gear_angle", "reference_angle")
    error, unit = angle - reference, units(table, "gear_angle")
    if not np.isfinite(error).all():
        raise NotAResult("its tracking error is not finite")
    factor, unit = style.scale(unit, error)
    if unit.startswith("µ") and np.abs(factor * error).max() > 1e3:
        factor, unit = 1e-3 * factor, "m" + unit[1:]
    panel.plot(*style.decimate(time, factor * error), color=style.PURPLE, linewidth=1.2, zorder=3)
    panel.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=2)
    panel.set(ylabel=f"error [{unit}]", ylim=style.limits(factor * np.append(error, 0.0)))
