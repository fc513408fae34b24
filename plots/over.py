"""The picture of runs over the motor torque: gear angle, with the break-aways."""

from typing import NamedTuple

import numpy as np
from matplotlib.lines import Line2D

import style
from result import columns, group, units
from run import BreakAways, break_aways

WINDOW = {"rad": 5.0}  # gear angles beyond it do not set the limits of the axes
MOST_NUMBERS = 8  # break-aways whose motor torque is written beside them
COLOURS = style.BLUE, style.VERMILLION, style.GREEN, style.PURPLE, style.INK
DASHES = "-", (0, (5, 2)), (0, (1, 1.5))
WAYS = (1, "^", "break-away forward"), (-1, "v", "break-away backward")


class Curve(NamedTuple):
    """What the picture shows of a run."""

    units: tuple  # of motor and angle
    motor: np.ndarray
    angle: np.ndarray
    broken: BreakAways


def read(result):
    """Returns the curve of a run."""
    trajectory, names = group(result, "trajectory"), ("motor_torque", "gear_angle")
    unit = tuple(units(trajectory, name) for name in names)
    return Curve(unit, *columns(trajectory, *names), break_aways(result))


def write_numbers(axes, points, sign, unit):
    """Writes the motor torques of the break-aways in one direction above or below them, where the curve bends from."""
    place = axes.transLimits.transform([point[:2] for point in points])  # the axes from 0 to 1
    side = -sign if 0.2 < place[:, 0].min() and place[:, 0].max() < 0.8 else sign
    order = np.argsort(-side * place[:, 0])
    x = place[order[0], 0] + 0.06 * side
    for k, row in enumerate(order):
        *point, colour = points[row]
        y = np.clip(place[row, 1] + sign * (0.10 + 0.06 * k), 0.05, 0.95)
        axes.annotate(f"{point[0]:.3g} {unit}".replace("-", "−"), point, (x, y), textcoords="axes fraction",
                      color=colour, zorder=4, ha="left" if side > 0 else "right", va="center",
                      bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5},
                      arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.9, "shrinkA": 2, "shrinkB": 5,
                                  "relpos": (0.5 - 0.5 * side, 0.5)})


def draw(curves, names):
    """Returns the figure of runs over the motor torque; their names stand in for titles that do not differ."""
    motor, angle = (np.concatenate(values) for values in zip(*((c.motor, c.angle) for c in curves)))
    motor_unit, angle_unit = curves[0].units
    window = WINDOW.get(angle_unit, np.inf)
    within = np.abs(angle) <= window
    if not within.any():
        within, window = ~within, np.inf
    x_factor, x_unit = style.scale(motor_unit, motor[within])
    y_factor, y_unit = style.scale(angle_unit, angle[within])
    y_name, x_name = ("position", "motor force") if angle_unit == "m" else ("gear angle", "motor torque")

    titles = [c.broken.title for c in curves]
    title, labels = style.split_titles(titles)
    if len(set(titles)) == 1:
        title = titles[0]
    if len(set(titles)) < len(titles):
        labels = names
    figure = style.new_figure(title or f"{y_name} over {x_name}".capitalize())
    axes = figure.subplots()
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    axes.axvline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    axes.set(xlabel=f"{x_name} [{x_unit}]", xlim=style.limits(x_factor * motor[within], 0.04),
             ylabel=f"{y_name} [{y_unit}]", ylim=style.limits(y_factor * np.clip(angle, -window, window), 0.04))

    handles, points = [], {sign: [] for sign, _, _ in WAYS}
    for k, (curve, label) in enumerate(zip(curves, labels)):
        colour, dash = COLOURS[k % len(COLOURS)], DASHES[k // len(COLOURS) % len(DASHES)]
        line = axes.plot(x_factor * curve.motor, y_factor * curve.angle, color=colour, linestyle=dash, zorder=3,
                         label=label.replace("$", r"\$"))
        handles += line if len(curves) > 1 else []
        for sign, marker, _ in WAYS:
            rows = curve.broken.forward == (sign > 0)
            x, y = x_factor * curve.broken.motor[rows], y_factor * curve.broken.angle[rows]
            axes.plot(x, y, marker, color=colour, markeredgecolor=style.INK, markeredgewidth=0.9, markersize=7.5,
                      zorder=5)
            points[sign] += [(a, b, colour) for a, b in zip(x, y) if abs(b) <= y_factor * window]
    few = sum(map(len, points.values())) <= MOST_NUMBERS
    for sign, marker, label in WAYS:
        if points[sign]:
            handles.append(Line2D([], [], marker=marker, color="white", markeredgecolor=style.INK, markersize=8,
                                  linestyle="none", label=label))
            if few:
                write_numbers(axes, points[sign], sign, x_unit)
    if handles:
        longest = max(len(handle.get_label()) for handle in handles)
        style.header(axes, handles, handlelength=1.8, ncol=int(np.clip(96 // (longest + 6), 1, 6)))
    return figure
