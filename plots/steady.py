"""The picture of steady motion: measured and modelled motor torque over worm speed, and what is left between them."""

import numpy as np

import style
from result import NotAResult, attribute, columns, dataset, group, number, text, units

MOST_NAMES = 8  # records that are named, those with the most samples left out
NAME_WIDTH = 0.115  # of the width of the axes


def spread(x, gap, low, high):
    """Returns positions near sorted x that are at least a gap apart, between low and high where they fit."""
    steps = gap * np.arange(x.size)
    right = np.maximum.accumulate(x - steps) + steps
    left = np.minimum.accumulate((x - steps)[::-1])[::-1] + steps
    middle = 0.5 * (left + right)
    return np.maximum(np.minimum(middle, high - steps[::-1]), low + steps)


def draw_model(axes, speed, torque):
    """Draws the model line with its gap at zero speed and returns its legend."""
    line = []
    for side in (speed < 0.0, speed > 0.0):
        order = np.argsort(speed[side])
        line = axes.plot(speed[side][order], torque[side][order], color=style.VERMILLION, label="model", zorder=4)
    return line


def draw_points(axes, x, y, left_out):
    """Draws one point per record, with a ring where samples were left out, and returns their legend."""
    handles = axes.plot(x, y, "o", color=style.BLUE, markersize=6.5, zorder=3, label="measured, mean of a record")
    ringed = left_out > 0
    if ringed.any():
        handles += axes.plot(x[ringed], y[ringed], "o", color="none", markeredgecolor=style.INK, markersize=13,
                             markeredgewidth=1.4, zorder=5, label="with samples left out")
    return handles


def name_records(axes, x, y, names, left_out):
    """Writes above the points the names of records with samples left out and how many, none over another."""
    rows = np.argsort(-left_out, kind="stable")[:MOST_NAMES]
    rows = np.sort(rows[left_out[rows] > 0])
    rows = rows[np.argsort(x[rows], kind="stable")]
    low, high = axes.get_xlim()
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, top + 0.45 * (top - bottom))
    width = NAME_WIDTH * (high - low)
    for row, place in zip(rows, spread(x[rows], width, low + 0.5 * width, high - 0.5 * width)):
        axes.annotate(f"{names[row]}\n{left_out[row]:.0f} left out", (x[row], y[row]),
                      (place, top + 0.17 * (top - bottom)), size=11, ha="center", va="bottom", parse_math=False,
                      arrowprops={"arrowstyle": "-", "color": style.GREY, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 6})


def rms_line(rms_error, rms_torque, unit):
    """Returns the words on the rms error."""
    factor, scaled = style.scale(unit, rms_torque)
    share = f", {100 * rms_error / rms_torque:.2g} % of the rms torque {factor * rms_torque:#.3g} {scaled}"
    return f"rms error {factor * rms_error:#.3g} {scaled}" + (share if rms_torque else "")


def draw(result):
    """Returns the figure of steady motion."""
    model = group(result, "model")
    speed, torque = columns(model, "worm_speed", "motor_torque")
    speed_unit, torque_unit = units(model, "worm_speed"), units(model, "motor_torque")
    linear = torque_unit == "N"
    speed_name, torque_name = ("speed", "motor force") if linear else ("worm speed", "motor torque")
    figure = style.new_figure(text(attribute(result, "title")))
    if "records" not in result:
        factor, unit = style.scale(torque_unit, torque)
        axes = figure.subplots()
        style.header(axes, draw_model(axes, speed, factor * torque), handlelength=2.6)
        axes.set(xlabel=f"{speed_name} [{speed_unit}]", ylabel=f"{torque_name} [{unit}]",
                 xlim=style.limits(speed, 0.03), ylim=style.limits(factor * torque))
        return figure

    records = group(result, "records")
    x, mean, of_model, left_out = columns(records, "worm_speed", "motor_torque", "motor_torque_model", "left_out")
    names = [text(name) for name in dataset(records, "record")[:]]
    if len(names) != x.size:
        raise NotAResult("the columns of '/records' differ in length")
    factor, unit = style.scale(torque_unit, torque, mean)
    above, below = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [1.5, 1.0]})
    rms = (number(result, name) for name in ("rms_error", "rms_torque"))
    above.set_title(rms_line(*rms, torque_unit), loc="left", size=13, pad=34)
    handles = draw_points(above, x, factor * mean, left_out)
    style.header(above, draw_model(above, speed, factor * torque) + handles, handlelength=1.8)
    above.set(ylabel=f"{torque_name} [{unit}]", xlim=style.limits(np.append(speed, x), 0.03),
              ylim=style.limits(factor * np.append(torque, mean), 0.1))

    residual = mean - of_model
    factor, prefix = (1e3, "m") if np.abs(residual).max() < 10.0 else (1.0, "")
    draw_points(below, x, factor * residual, left_out)
    below.axhline(0.0, color=style.VERMILLION, linewidth=1.4, zorder=2)
    below.set(xlabel=f"{speed_name} [{speed_unit}]", ylabel=f"measured − model [{prefix}{torque_unit}]",
              ylim=style.limits(factor * np.append(residual, 0.0), 0.12))
    name_records(below, x, factor * residual, names, left_out)
    figure.align_ylabels()
    return figure
