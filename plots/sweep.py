"""The picture of a sweep: how a metric is distributed, how often it exceeds what, what it hangs on; worst runs."""

from typing import NamedTuple

import numpy as np

import controller
import style
from result import NotAResult, attribute, column, columns, dataset, group, number, text, units

DONE = 1  # status of a trial with metrics
LEADING = 3  # parameters in the scatter matrix
MOST_BARS = 8  # parameters in the tornado
MOST_POINTS = 3000  # trials in the scatter matrix
QUANTILES = 5, 50, 95, 99  # [%]


class Ranked(NamedTuple):
    """The metric by which trials are ranked, over the trials that have it."""

    name: str
    unit: str
    values: np.ndarray
    limits: list  # of its thresholds, with whether they are missed above
    without: int  # trials that were refused, halted or have no value: worse than all others


class Bar(NamedTuple):
    """How much a parameter matters."""

    name: str
    value: float
    low: float
    high: float


def texts(table, name):
    """Returns a column of fixed-length texts."""
    return [text(value.rstrip(b"\0")) for value in dataset(table, name)[:]]


def draws(result, count):
    """Returns which trials are draws of their own; others differ from one of them by some parameters alone."""
    if "block_trials" not in result.attrs:  # of an older version
        return np.ones(count, dtype=bool)
    first, block, own = (number(result, name) for name in ("first_trial", "block_trials", "block_draws"))
    if not block >= 1:
        raise NotAResult("its attribute 'block_trials' is less than 1")
    return (first + np.arange(count)) % block < own


def ranked(result):
    """Returns the ranked metric and which rows of /trials it is of."""
    trials, summary = group(result, "trials"), group(result, "summary")
    name = text(attribute(summary, "ranked_by"))
    values, status = columns(trials, name, "status")
    is_draw = draws(result, status.size)
    rows = np.flatnonzero((status == DONE) & np.isfinite(values) & is_draw)
    limits = []
    if "thresholds" in summary:
        table = summary["thresholds"]
        limits = [(limit, above > 0) for metric, limit, above in
                  zip(texts(table, "metric"), *columns(table, "limit", "above")) if metric == name]
    if rows.size == 0:
        raise NotAResult(f"no trial has a finite '{name}'")
    return Ranked(name, units(trials, name), values[rows], limits, np.count_nonzero(status[is_draw]) - rows.size), rows


def influences(result):
    """Returns the bars of the tornado, greatest first, and what they show."""
    summary = group(result, "summary")
    table = group(summary, "influences")
    names = texts(table, "parameter")
    total, low, high = columns(table, "total", "total_low", "total_high")
    label = "total Sobol index, with its 95 % interval"
    if not np.isfinite(total).any():
        total = low = high = column(table, "rank_correlation")
        label = "rank correlation with the metric"
    if "shapley" in summary:
        effects, ranked_by = summary["shapley"], text(attribute(summary, "ranked_by"))
        rows = [k for k, metric in enumerate(texts(effects, "metric")) if metric == ranked_by]
        names = [texts(effects, "parameter")[k] for k in rows]
        total, low, high = (values[rows] for values in columns(effects, "share", "share_low", "share_high"))
        label = "Shapley effect, with its 95 % interval"
    bars = [Bar(*bar) for bar in zip(names, total, low, high)]
    return sorted(bars, key=lambda bar: -abs(bar.value) if np.isfinite(bar.value) else 0.0), label


def labelled(name, unit):
    """Returns the label of an axis."""
    return f"{name} [{unit}]" if unit != "1" else name


def scaled(unit, values):
    """Returns a factor and a unit of readable size; pure numbers stay, and so do kg, which has a prefix already."""
    return (1.0, unit.replace("^2", "²")) if unit == "1" or unit.startswith("kg") else style.scale(unit, values)


def is_wide(values):
    """Returns whether a few values are so large that a straight axis would squeeze all others into a line."""
    return values.min() > 0 and values.max() > 100 * np.median(values)


def shown(metric):
    """Returns the limits that lie near the values; others would squeeze them into a line."""
    low, high = metric.values.min(), metric.values.max()
    width = high - low
    return [(limit, above) for limit, above in metric.limits if low - width <= limit <= high + width]


def missing_note(metric, factor, unit):
    """Returns words on the limits and trials that are not shown."""
    far = [limit for limit in metric.limits if limit not in shown(metric)]
    without = f", {metric.without} trials without" if metric.without else ""
    return without + "".join(f", limit {style.number(factor * limit)} {unit} far {'above' if above else 'below'}"
                   for limit, above in far)


def draw_histogram(axes, metric, factor, unit):
    """Draws the histogram with quantiles and limits."""
    values = factor * metric.values
    bins = min(80, max(10, int(np.sqrt(values.size))))
    if is_wide(values):
        axes.set_xscale("log")
        bins = np.geomspace(values.min(), values.max(), bins + 1)
    else:
        style.few_ticks(axes.xaxis)
    axes.hist(values, bins=bins, color=style.MID_BLUE)
    handles = []
    for percent, dash in zip(QUANTILES, (":", "-", "--", "-.")):
        handles.append(axes.axvline(np.quantile(values, percent / 100), color=style.INK, linestyle=dash, linewidth=1.2,
                                    label=f"{percent} %"))
    for limit, _ in shown(metric):
        handles.append(axes.axvline(factor * limit, color=style.VERMILLION, label="limit"))
    style.header(axes, handles)
    axes.set(xlabel=labelled(metric.name, unit) + missing_note(metric, factor, unit), ylabel="trials")


def draw_exceedance(axes, metric, factor, unit):
    """Draws which share of all trials lies above a value; below it where the thresholds ask that."""
    values = np.sort(factor * metric.values)
    below = any(not above for _, above in metric.limits)
    trials = values.size + metric.without
    share = (np.arange(values.size, 0, -1) + metric.without) / trials
    wide = is_wide(values)
    x = np.log(values) if wide else values
    x, y = style.decimate(x, share[::-1] if below else share) if values[-1] > values[0] else (x, share)
    axes.semilogy(np.exp(x) if wide else x, y, color=style.BLUE, drawstyle="steps-post")
    for limit, above in shown(metric):
        axes.axvline(factor * limit, color=style.VERMILLION)
        missed = np.count_nonzero(values > factor * limit if above else values < factor * limit)
        beyond = (missed + metric.without) / trials
        # beside the crossing, on the side from which the curve comes down
        axes.annotate(f"{100 * beyond:.3g} %", (factor * limit, max(beyond, share[-1])), textcoords="offset points",
                      xytext=(-6 if below else 6, 4), ha="right" if below else "left", color=style.VERMILLION)
    if wide:
        axes.set_xscale("log")
    else:
        style.few_ticks(axes.xaxis)
    axes.set(xlabel=labelled(metric.name, unit), ylabel=f"share of the trials {'below' if below else 'above'}")


def draw_tornado(axes, bars, label):
    """Draws the parameters that matter most, the greatest on top."""
    bars = bars[:MOST_BARS]
    places = np.arange(len(bars))[::-1]
    values = np.array([bar.value for bar in bars])
    errors = np.abs(np.array([[bar.value - bar.low, bar.high - bar.value] for bar in bars]).T)
    axes.barh(places, np.nan_to_num(values), color=[style.BLUE if v >= 0 else style.VERMILLION for v in values],
              xerr=np.nan_to_num(errors) if errors.any() else None, ecolor=style.INK, height=0.6)
    axes.set_yticks(places, [bar.name for bar in bars], size=10)
    axes.axvline(0.0, color=style.GREY, linewidth=0.8)
    axes.grid(False, axis="y")
    axes.set(xlabel=label)


def short(name):
    """Returns the last two words of a parameter's path, one over the other."""
    return "\n".join(name.split(".")[-2:])


def draw_matrix(figure, place, parameters, metric):
    """Draws the leading parameters against each other and against the metric, trials beyond a limit in another colour."""
    beyond = np.zeros(metric.values.size, dtype=bool)
    for limit, above in metric.limits:
        beyond |= metric.values > limit if above else metric.values < limit
    rows = [*parameters[1:], (metric.name, metric.unit, metric.values)]
    grid = place.subgridspec(len(rows), len(parameters), hspace=0.06, wspace=0.06)
    chosen = np.linspace(0, beyond.size - 1, min(beyond.size, MOST_POINTS)).astype(int)
    colours = np.where(beyond[chosen], style.VERMILLION, style.BLUE)
    for i, (y_name, y_unit, y) in enumerate(rows):
        for j, (x_name, x_unit, x) in enumerate(parameters[:i + 1] if i + 1 < len(rows) else parameters):
            axes = figure.add_subplot(grid[i, j])
            y_factor, y_scaled = scaled(y_unit, y)
            x_factor, x_scaled = scaled(x_unit, x)
            axes.scatter(x_factor * x[chosen], y_factor * y[chosen], s=4, c=colours, linewidths=0, rasterized=True)
            style.few_ticks(axes.xaxis, 3)  # of narrow panels: their labels stand side by side
            if y is metric.values and is_wide(y):
                axes.set_yscale("log")
            else:
                style.few_ticks(axes.yaxis)
            axes.tick_params(labelsize=9, labelbottom=i + 1 == len(rows), labelleft=j == 0)
            if i + 1 == len(rows):
                axes.set_xlabel(labelled(short(x_name), x_scaled), size=9)
            if j == 0:
                axes.set_ylabel(labelled(short(y_name), y_scaled), size=9)


def draw(result):
    """Returns the figure of a sweep."""
    metric, rows = ranked(result)
    bars, label = influences(result)
    trials = group(result, "trials")
    by_name = {bar.name: bar for bar in bars}
    leading = []
    for name in trials:  # a parameter's long name has its path
        path = text(attribute(trials[name], "long_name")).removeprefix("parameter ")
        if path in by_name and name not in (item[0] for item in leading):
            leading.append((name, units(trials, name), column(trials, name)[rows], bars.index(by_name[path])))
    leading = [item[:3] for item in sorted(leading, key=lambda item: item[3])][:LEADING]
    factor, unit = scaled(metric.unit, metric.values)
    figure = style.new_figure(text(attribute(result, "title")))
    figure.set_size_inches(12.5, 10.5)
    grid = figure.add_gridspec(2, 2, height_ratios=(2, 3))
    draw_histogram(figure.add_subplot(grid[0, 0]), metric, factor, unit)
    draw_exceedance(figure.add_subplot(grid[0, 1]), metric, factor, unit)
    draw_tornado(figure.add_subplot(grid[1, 0]), bars, label)
    if leading:
        draw_matrix(figure, grid[1, 1], leading, metric)
    return figure


class Course(NamedTuple):
    """A run in an overlay."""

    units: str  # of the angle
    title: str
    angle: tuple  # time and gear angle
    error: tuple  # time and tracking error; nothing without a reference


def read_course(result):
    """Returns what an overlay shows of a run."""
    trajectory = group(result, "trajectory")
    time, angle = columns(trajectory, "time", "gear_angle")
    error = ()
    if "controller" in result and controller.follows(result):
        table = result["controller"]
        at, seen, wanted = columns(table, "time", "measured_angle", "reference_angle")
        error = at, seen - wanted
    return Course(units(trajectory, "gear_angle"), text(attribute(result, "title")), (time, angle), error)


def draw_overlay(courses):
    """Returns the figure of the courses of several trials, one over the other."""
    common, own = style.split_titles([course.title for course in courses])
    figure = style.new_figure(common or "Trials of a sweep")
    has_error = any(course.error for course in courses)
    panels = figure.subplots(2 if has_error else 1, 1, sharex=True, squeeze=False)[:, 0]
    factor, unit = style.scale(courses[0].units, *(course.angle[1] for course in courses))
    colours = style.BLUE, style.VERMILLION, style.GREEN, style.PURPLE, style.INK
    handles = []
    for k, course in enumerate(courses):
        look = {"color": colours[k % len(colours)], "linewidth": 1.2, "alpha": 0.9,
                "linestyle": ("-", "--", ":")[k // len(colours) % 3]}
        x, y = style.decimate(course.angle[0], factor * course.angle[1])
        handles += panels[0].plot(x, y, label=own[k] or course.title, **look)
    panels[0].set(ylabel=f"gear angle [{unit}]")
    if has_error:
        error_factor, error_unit = style.scale(courses[0].units, *(c.error[1] for c in courses if c.error))
        for k, course in enumerate(courses):
            if course.error:
                x, y = style.decimate(course.error[0], error_factor * course.error[1])
                panels[1].plot(x, y, color=colours[k % len(colours)], linewidth=1.0, alpha=0.9)
        panels[1].set(ylabel=f"tracking error [{error_unit}]")
    panels[-1].set(xlabel="time [s]")
    style.header(panels[0], handles, ncol=4)
    return figure
