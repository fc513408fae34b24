"""The pictures of a diagnosis: predictions before and after, maps of the residual torque, ranking, certificate."""

import textwrap

import numpy as np

import style
from result import attribute, columns, dataset, group, text, units

BEFORE, AFTER = style.VERMILLION, style.BLUE
MOST_EXAMPLES = 9  # stretches that fit into one picture
BINS = 40  # of a map
MOST_BARS = 15  # effects in the ranking


def legend_above(figure, handles):
    """One legend for all panels, in a strip of its own."""
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.95))
    figure.legend(handles=handles, loc="upper right", bbox_to_anchor=(1, 0.955), ncol=len(handles))


def texts(table, name):
    """Returns a text column."""
    return [text(value) for value in dataset(table, name)[:]]


def title(result):
    """Returns the sentence of a diagnosis below the scenario's title."""
    return text(attribute(result, "title"))


def new_figure(result, what):
    """Returns an empty figure called after the scenario and what it shows."""
    return style.new_figure(f"{title(result)}: {what}")


def empty(result, why):
    """Returns a picture that says why there is nothing to see."""
    figure = new_figure(result, "nothing to draw")
    figure.text(0.5, 0.5, why, ha="center", size=13, color=style.GREY)
    return figure


# ---- predictions ---------------------------------------------------------------------------------------------------


def rms(values):
    """Returns the root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if values.size else 0.0


def draw_torques(result, table):
    """Returns measured and predicted torques over speed or load, and the errors below."""
    speed, load, measured, before, after = columns(table, "worm_speed", "load_torque", "measured", "before", "after")
    moving, si = np.any(speed != 0.0), units(table, "measured")
    word, speed_name = ("force", "speed") if si == "N" else ("torque", "worm speed")
    x, label = (speed, f"{speed_name} [{units(table, 'worm_speed')}]") if moving else (load, f"load {word} [{si}]")
    factor, unit = style.scale(si, measured)
    figure = new_figure(result, f"{word}s that no fit has seen")
    above, below = figure.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": [1.5, 1.0]})
    rows = np.argsort(x, kind="stable")
    handles = above.plot(x, factor * measured, "o", color=style.INK, markersize=6, label="measured")
    for values, colour, name in ((before, BEFORE, "before"), (after, AFTER, "after")):
        for k, side in enumerate((measured < 0.0, measured >= 0.0)):
            chosen = rows[side[rows]]
            line = above.plot(x[chosen], factor * values[chosen], "-", color=colour, linewidth=1.6, label=name)
            handles += line if k == 0 else []
    style.header(above, handles)
    above.set(ylabel=f"motor {word} [{unit}]")
    error_factor, error_unit = style.scale(si, (measured - before))
    handles = []
    for values, colour, name in ((before, BEFORE, "before"), (after, AFTER, "after")):
        error = error_factor * (measured - values)
        handles += below.plot(x, error, "o", color=colour, markersize=5,
                              label=f"{name}, rms {style.number(float(f'{rms(error):.3g}'))} {error_unit}")
    below.axhline(0.0, color=style.GREY, linewidth=1.0, zorder=1)
    style.header(below, handles)
    below.set(xlabel=label, ylabel=f"measured − predicted [{error_unit}]")
    figure.align_ylabels()
    return figure


def stretches(table):
    """Returns the examples as a list of (horizon, time, measured, before, after)."""
    time, number_of, horizon, measured, before, after = columns(
        table, "time", "example", "horizon", "measured", "before", "after", may_be_empty=True)
    return [(float(horizon[number_of == k][0]), time[number_of == k], measured[number_of == k],
             before[number_of == k], after[number_of == k]) for k in np.unique(number_of)]


def chosen(examples):
    """Returns few examples, as evenly as may be of every horizon."""
    by_horizon = {}
    for example in examples:
        by_horizon.setdefault(example[0], []).append(example)
    each = max(1, MOST_EXAMPLES // max(1, len(by_horizon)))
    picked = []
    for horizon in sorted(by_horizon):
        own = by_horizon[horizon]
        picked.append([own[k] for k in np.unique(np.linspace(0, len(own) - 1, each).astype(int))])
    return picked


def draw_examples(result, examples, si):
    """Returns stretches of the gear angle, whose unit it is, a row for every horizon."""
    rows = chosen(examples)
    figure = new_figure(result, "predictions of data that no fit has seen")
    grid = figure.subplots(len(rows), max(len(row) for row in rows), squeeze=False)
    for row, cells in zip(rows, grid):
        for cell in cells[len(row):]:
            cell.set_visible(False)
        for (horizon, time, measured, before, after), cell in zip(row, cells):
            scale, unit = style.scale(si, measured - measured[0], after - measured[0])
            handles = cell.plot(time, scale * (measured - measured[0]), color=style.INK, linewidth=2.4, alpha=0.55,
                                label="measured")
            handles += cell.plot(time, scale * (before - measured[0]), color=BEFORE, linewidth=1.5, label="before")
            handles += cell.plot(time, scale * (after - measured[0]), color=AFTER, linewidth=1.5, linestyle=(0, (4, 2)),
                                 label="after")
            style.few_ticks(cell.xaxis)
            style.few_ticks(cell.yaxis)
            cell.set_title(f"{horizon:g} s ahead [{unit}]", loc="left", size=12)
            cell.tick_params(labelsize=10)
    for cell in grid[-1]:
        cell.set_xlabel("time [s]")
    figure.supylabel("change of the position" if si == "m" else "change of the gear angle", size=13)
    legend_above(figure, handles)
    return figure


def draw_prediction(result):
    """Returns the picture of what was predicted before and after."""
    if "examples" in result and (examples := stretches(group(result, "examples"))):
        return draw_examples(result, examples, units(group(result, "examples"), "measured"))
    torques = group(result, "torques")
    if torques["measured"].size:
        return draw_torques(result, torques)
    return empty(result, "There were no data that were not used for the fit.")


# ---- residual torque -----------------------------------------------------------------------------------------------


def means(x, values):
    """Returns the middles of the bins of x that hold enough samples, with mean and standard error of the values."""
    edges = np.linspace(np.min(x), np.max(x), BINS + 1) if np.ptp(x) > 0 else np.array([np.min(x) - 1, np.max(x) + 1])
    place = np.clip(np.digitize(x, edges) - 1, 0, edges.size - 2)
    counts = np.bincount(place, minlength=edges.size - 1)
    kept = counts >= max(3, 0.002 * x.size)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(place, values, edges.size - 1) / counts
        spread = np.sqrt(np.bincount(place, values**2, edges.size - 1) / counts - mean**2)
        error = spread / np.sqrt(np.maximum(counts / 20.0, 1.0))  # neighbours are not independent
    middle = 0.5 * (edges[1:] + edges[:-1])
    return middle[kept], mean[kept], error[kept]


def axes_of_maps(table):
    """Returns what the residual torque is drawn over: (label, values, rows)."""
    names = ("time", "gear_angle", "gear_speed", "load_torque", "worm_phase")
    time, angle, speed, load, phase = columns(table, *names)
    everything = np.ones(speed.size, bool)
    of_angle, of_speed, of_load = (units(table, name) for name in ("gear_angle", "gear_speed", "load_torque"))
    linear = of_angle == "m"
    angle_name, speed_name, load_name = (("position", "speed", "load force") if linear else
                                         ("gear angle", "gear speed", "load torque"))
    maps = [(f"{speed_name} [{of_speed}]", speed, everything),
            (f"{angle_name}, forward [{of_angle}]", angle, speed > 0.0),
            (f"{angle_name}, backward [{of_angle}]", angle, speed < 0.0),
            (f"{load_name} [{of_load}]", load, everything),
            ("worm phase [rad]", phase, everything & (not linear)), ("time [s]", time, everything)]
    return [(label, x, rows) for label, x, rows in maps
            if np.isfinite(x[rows]).sum() > 10 and np.ptp(x[rows & np.isfinite(x)]) > 0.0]


def draw_residual(result):
    """Returns maps of the residual torque before and after."""
    table = group(result, "residual")
    before, after = columns(table, "before", "after", may_be_empty=True)
    if not after.size:
        return empty(result, "There is no residual torque.")
    maps = axes_of_maps(table)
    if not maps:
        return empty(result, "The residual torque has nothing to be drawn over.")
    si = units(table, "before")
    word = "force" if si == "N" else "torque"
    factor, unit = style.scale(si, np.quantile(np.abs(before), [0.98]))
    figure = new_figure(result, f"{word} that the model lacks")
    rows = (len(maps) + 1) // 2
    cells = figure.subplots(rows, 2 if len(maps) > 1 else 1, squeeze=False).ravel()
    for cell in cells[len(maps):]:
        cell.set_visible(False)
    handles = []
    few = after.size < 500  # points of their own rather than means
    for (label, x, chosen_rows), cell in zip(maps, cells):
        handles = []
        used = chosen_rows & np.isfinite(x)
        for values, colour, name in ((before, BEFORE, "before"), (after, AFTER, "after")):
            if few:
                handles += cell.plot(x[used], factor * values[used], "o", color=colour, markersize=4.5, label=name)
                continue
            middle, mean, error = means(x[used], values[used])
            cell.fill_between(middle, factor * (mean - 2 * error), factor * (mean + 2 * error), color=colour,
                              alpha=0.15, linewidth=0)
            handles += cell.plot(middle, factor * mean, color=colour, linewidth=1.6, label=name)
        cell.axhline(0.0, color=style.GREY, linewidth=0.9, zorder=1)
        cell.set(xlabel=label, ylabel=f"{word} [{unit}]")
    legend_above(figure, handles)
    return figure


# ---- ranking and certificate ---------------------------------------------------------------------------------------


def draw_ranking(result):
    """Returns bars of the evidence for every effect, with the reason for its rejection."""
    table = group(result, "ranking")
    evidence, gain, named = columns(table, "delta_bic", "held_out_gain", "named", may_be_empty=True)
    if not evidence.size:
        return empty(result, "No effect was tried.")
    effects, outcomes = texts(table, "effect"), texts(table, "outcome")
    rows = np.arange(min(evidence.size, MOST_BARS))
    figure = new_figure(result, "which effects explain the data")
    axes = figure.subplots()
    size = np.maximum(evidence[rows], 1.0)
    colours = [style.BLUE if named[k] else style.MID_BLUE if "can stand for" in outcomes[k] else style.DARK_STUCK
               for k in rows]
    axes.barh(rows, size, color=colours, height=0.62)
    axes.set_xscale("log")
    # as far as the longest bar with its words reaches
    axes.set_xlim(1.0, max(30.0, np.max(size) ** 1.6))
    axes.set_yticks(rows, [effects[k] for k in rows])
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    for k in rows:
        words = outcomes[k] if len(outcomes[k]) < 64 else outcomes[k][:61] + "..."
        axes.annotate(f"{words}" + (f"; held-out gain {gain[k]:.0f} nats" if named[k] else ""), (size[k], k),
                      xytext=(6, 0), textcoords="offset points", va="center", size=10, parse_math=False,
                      color=style.INK if named[k] else style.GREY)
    axes.set_xlabel("evidence: BIC without the effect less BIC with it")
    return figure


def draw_certificate(result):
    """Returns what the data could have shown: smallest visible and nameable size of every effect."""
    table = group(result, "certificate")
    seen, named, likeness, observable = columns(table, "detectable", "nameable", "likeness", "observable",
                                                may_be_empty=True)
    rows = np.flatnonzero((observable > 0) & np.isfinite(seen) & (seen > 0))
    if not rows.size:
        return empty(result, "These data show no effect.")
    effects, unit_of, nearest = texts(table, "effect"), texts(table, "unit"), texts(table, "nearest")
    parameters = texts(table, "parameter")
    chosen = texts(table, "chosen") if "chosen" in table else [""] * len(effects)  # older files do not say
    figure = new_figure(result, "what these data can show")
    axes = figure.subplots()
    place = np.arange(rows.size)
    ratio = np.where(np.isfinite(named[rows]), named[rows] / seen[rows], np.nan)
    widest = np.nanmax(ratio, initial=2.0)
    axes.hlines(place, 1.0, np.where(np.isfinite(ratio), ratio, widest * 1.6), color=style.MID_BLUE, linewidth=3)
    dots = axes.plot(np.ones(rows.size), place, "o", color=style.BLUE, label="can be seen")
    finite = np.isfinite(ratio)
    dots += axes.plot(ratio[finite], place[finite], "s", color=style.VERMILLION, label="can be told from the nearest")
    axes.set_xscale("log")
    axes.set_xlim(0.7, widest * 40.0)
    axes.set_ylim(-0.6, rows.size - 0.4)
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.set_yticks(place, [" ".join(filter(None, (effects[k], parameters[k], chosen[k]))) for k in rows], size=10)
    for row, k in zip(place, rows):
        unit = "" if unit_of[k] == "1" else f" {unit_of[k]}"
        words = f"{seen[k]:.2g}{unit} seen"
        if np.isfinite(named[k]):
            words += f", {named[k]:.2g}{unit} named"
        else:
            words += ", never named"
        words += f" (like {nearest[k]}, {100 * likeness[k]:.0f} %)" if nearest[k] else ""
        at = ratio[row] if np.isfinite(ratio[row]) else widest * 1.6
        axes.annotate(words, (max(1.0, at), row), xytext=(9, 0), textcoords="offset points", va="center", size=9,
                      color=style.INK, parse_math=False)
    axes.set_xlabel("size, in units of the smallest that can be seen")
    hidden = [f"{effects[k]} {chosen[k]}".strip() for k in np.flatnonzero(observable == 0)]
    if hidden:
        figure.supxlabel("\ncannot be seen at all: " + textwrap.fill(", ".join(hidden), 150), x=0.012, ha="left", size=10)
    style.header(axes, dots)
    return figure


PARTS = {"prediction": draw_prediction, "residual": draw_residual, "ranking": draw_ranking,
         "certificate": draw_certificate}


def draw(result, part="prediction"):
    """Returns one of the pictures of a diagnosis."""
    return PARTS[part](result)
