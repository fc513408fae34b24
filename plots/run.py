"""The picture of a run: gear angle, gear speed with its modes, torques with the switching surface, tracking error,
temperatures."""

import textwrap
from typing import NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import controller
import coupling
import heat
import style
import teeth
from result import NotAResult, attribute, column, columns, flags, group, number, text, units

MOST_EVENTS = 200  # drawn one by one
LARGEST = 6  # times the motor torque: beyond it the switching surface no longer sets the limits of its axis
LONGEST_NOTE = 80  # characters on a line beside the reference; a longer one makes the panels narrower
NARROWEST = 1 / 700  # band that is drawn when there are more events, as part of the time axis

MODES = {  # (motion, flank): label, colour
    ("forward", "left"): ("forward, left flank", style.PALE_BLUE),
    ("forward", "right"): ("forward, right flank", style.MID_BLUE),
    ("forward", "none"): ("forward", style.PALE_BLUE),
    ("backward", "left"): ("backward, left flank", style.PALE_ORANGE),
    ("backward", "right"): ("backward, right flank", style.MID_ORANGE),
    ("backward", "none"): ("backward", style.PALE_ORANGE),
    ("stuck", "none"): ("stuck", style.STUCK),
}
ELASTIC_MODES = {  # of worm and teeth
    ("forward", "left"): ("forward, left flank", style.PALE_BLUE),
    ("forward", "right"): ("forward, right flank", style.MID_BLUE),
    ("backward", "left"): ("backward, left flank", style.PALE_ORANGE),
    ("backward", "right"): ("backward, right flank", style.MID_ORANGE),
    ("stuck", "left"): ("stuck, left flank", style.STUCK),
    ("stuck", "right"): ("stuck, right flank", style.DARK_STUCK),
    ("any", "none"): ("free in the gap", "white"),
}
EVENTS = {  # kind: label, marker, colour
    "break_away": ("break-away", "^", style.GREEN),
    "stop": ("stop", "s", style.INK),
    "reversal": ("reversal", "D", style.PURPLE),
    "flank_change": ("flank change", "o", "white"),
    "impact": ("impact", "v", style.VERMILLION),
    "opening": ("opening", "o", style.BLUE),
    "gear_break_away": ("gear break-away", "<", style.GREEN),
    "gear_stop": ("gear stop", "p", style.INK),
    "gear_reversal": ("gear reversal", "d", style.PURPLE),
}


class BreakAways(NamedTuple):
    """What a run is called and where the gear broke away."""

    title: str
    units: tuple  # of load, motor and angle
    load: np.ndarray  # and the motor torque, both just before
    motor: np.ndarray
    angle: np.ndarray
    forward: np.ndarray


def mode_bands(trajectory, time, modes):
    """Returns the bands of every one of these modes that occurs, as {mode: (starts, widths)}."""
    (motion, flank), meanings = columns(trajectory, "motion", "flank"), flags(trajectory, "flank")
    code = 10 * motion.astype(int) + flank
    start = np.flatnonzero(np.diff(code, prepend=code[0] - 1))
    stop = np.append(start[1:], time.size - 1)
    motions, bands = flags(trajectory, "motion"), {}
    for value in np.unique(code[start]):
        chosen = start[code[start] == value], stop[code[start] == value]
        now_motion = motions.get(int(motion[chosen[0][0]]))
        now_flank = meanings.get(int(flank[chosen[0][0]]))
        if modes is ELASTIC_MODES:
            now_motion = "any" if now_flank == "none" else now_motion
        elif now_motion == "stuck":
            now_flank = "none"
        if (now_motion, now_flank) not in modes:
            raise NotAResult("its modes are unknown")
        starts, widths = bands.get((now_motion, now_flank), (np.empty(0), np.empty(0)))
        bands[now_motion, now_flank] = (np.append(starts, time[chosen[0]]),
                                        np.append(widths, time[chosen[1]] - time[chosen[0]]))
    return bands


def draw_bands(axes, bands, modes, narrowest):
    """Draws the modes as bands; returns their legend and whether some were too narrow to draw."""
    handles, skipped = [], False
    for mode in modes:
        if mode not in bands:
            continue
        label, colour = modes[mode]
        start, width = bands[mode]
        wide = width >= narrowest
        skipped |= not wide.all()
        axes.broken_barh(np.column_stack([start, width])[wide], (0, 1), color=colour, linewidth=0, zorder=0,
                         transform=axes.get_xaxis_transform())
        handles.append(Patch(facecolor=colour, edgecolor=style.GREY, linewidth=0.5, label=label))
    return handles, skipped


def event_kinds(events):
    """Returns the rows of every kind of event that occurs, as {kind: rows}."""
    kind = column(events, "kind")
    found = {name: np.flatnonzero(kind == value) for value, name in flags(events, "kind").items() if name in EVENTS}
    return {name: found[name] for name in EVENTS if name in found and found[name].size}


def break_aways(result):
    """Returns the break-aways of a run."""
    events = group(result, "events")
    names = "load_torque_before", "motor_torque_before", "gear_angle"
    *values, motion, _ = columns(events, *names, "motion_after", "kind", may_be_empty=True)
    rows = event_kinds(events).get("break_away", [])
    forward = [value for value, name in flags(events, "motion_after").items() if name == "forward"]
    return BreakAways(text(attribute(result, "title")), tuple(units(events, name) for name in names),
                      *(v[rows] for v in values), np.isin(motion[rows], forward))


def draw_events(panels, curves, time, kinds):
    """Draws a thin line for every event, a marker by its kind on the curves, and returns their legend."""
    size, width, handles = (7.5, 0.8, []) if time.size <= 60 else (4.5, 0.4, [])
    for panel in panels:
        panel.vlines(time, 0, 1, transform=panel.get_xaxis_transform(), color=style.EVENT, linewidth=width, zorder=1)
    for kind, rows in kinds.items():
        label, marker, colour = EVENTS[kind]
        look = {"marker": marker, "color": colour, "markeredgecolor": style.INK, "linestyle": "none"}
        for panel, values in curves:
            panel.plot(time[rows], values[rows], **look, markersize=size, markeredgewidth=0.9, clip_on=False, zorder=5)
        handles.append(Line2D([], [], **look, markersize=8, label=f"{label} ({rows.size})"))
    return handles


def draw_curve(panel, time, values, colour, **look):
    """Draws values over time and returns the line."""
    marker = "o" if time.size == 1 else None
    return panel.plot(*style.decimate(time, values), color=colour, marker=marker, zorder=3, **look)[0]


def draw_torques(panel, time, motor, other, unit, word, other_label):
    """Draws the motor torque and what it is to be compared with; returns the factor to the unit of the axis."""
    hidden = 0.0 < LARGEST * np.abs(motor).max() < np.abs(other).max()
    shown = motor if hidden else np.concatenate([motor, other])
    factor, axis_unit = style.scale(unit, shown)
    if hidden:
        other_factor, other_unit = style.scale(unit, other)
        low, high = (style.number(other_factor * end) for end in (other.min(), other.max()))
        other_label += f" (at {low} {other_unit})" if low == high else f" (from {low} to {high} {other_unit})"
    handles = [draw_curve(panel, time, factor * motor, style.BLUE, label=f"motor {word}"),
               draw_curve(panel, time, factor * other, style.VERMILLION, linestyle=(0, (5, 2)), label=other_label)]
    panel.set(ylabel=f"{word} [{axis_unit}]", ylim=style.limits(factor * shown))
    style.header(panel, handles, handlelength=2.6)
    return factor


def draw(result):
    """Returns the figure of a run."""
    trajectory, events = group(result, "trajectory"), group(result, "events")
    names = "time", "gear_angle", "gear_speed", "motor_torque", "load_torque"
    time, angle, speed, motor, load = columns(trajectory, *names)
    if not (np.diff(time) > 0).all():
        raise NotAResult("its times do not increase")
    angle_factor, angle_unit = style.scale(units(trajectory, "gear_angle"), angle)
    speed_factor, speed_unit = style.scale(units(trajectory, "gear_speed"), speed)
    linear = units(trajectory, "gear_angle") == "m"
    angle_name, speed_name, word = ("position", "speed", "force") if linear else ("gear angle", "gear speed", "torque")
    elastic, twists = teeth.elastic(trajectory), coupling.twists(trajectory)
    if twists:
        other, label = coupling.on_worm(result, load, word)
    elif "surface" in result.attrs and not elastic:
        other, label = number(result, "surface") * load, r"switching surface $(J_w i/J_g)\,\tau_l$"
    else:
        other, label = load, f"load {word}"

    figure = style.new_figure(text(attribute(result, "title")))
    samples = controller.samples(result) if controller.follows(result) else None
    warm = heat.warm(trajectory)
    heights = [1.0, 1.25, 1.25] + [1.0] * elastic + [0.9] * bool(warm) + [0.9] * bool(samples)
    if len(heights) > 3:
        figure.set_figheight(2.55 * len(heights))  # so that more panels stay readable
    panels = figure.subplots(len(heights), 1, sharex=True, gridspec_kw={"height_ratios": heights})
    legend = []
    if samples:
        controller.draw_error(panels[-1], samples)
        legend = [controller.draw_reference(panels[0], samples, angle_factor)]
    draw_curve(panels[0], time, angle_factor * angle, style.INK)
    panels[0].set(ylabel=f"{angle_name} [{angle_unit}]", ylim=style.limits(angle_factor * angle))
    speeds, speed_lines = speed_factor * speed, [draw_curve(panels[1], time, speed_factor * speed, style.INK,
                                                            label=speed_name)]
    if elastic:
        line, worm = teeth.draw_worm(panels[1], result, trajectory, time, speed_factor)
        speeds, speed_lines = np.append(speeds, worm), [*speed_lines, line]
        teeth.draw_force(panels[3], trajectory, time)
    if warm:
        heat.draw_temperatures(panels[3 + elastic], trajectory, time, warm)
    if twists:
        line, of_load = coupling.draw_load(panels[1], trajectory, time, speed_factor)
        speeds, speed_lines = np.append(speeds, of_load), [*speed_lines, line]
    panels[1].set(ylabel=f"{speed_name} [{speed_unit}]", ylim=style.limits(speeds))
    panels[1].axhline(0.0, color=style.GREY, linewidth=0.8, zorder=2)
    torque_factor = draw_torques(panels[2], time, motor, other, units(trajectory, "motor_torque"), word, label)

    event_time, kinds = column(events, "time"), event_kinds(events)
    few = event_time.size <= MOST_EVENTS
    span = time[-1] - time[0]
    modes = ELASTIC_MODES if elastic else MODES
    bands, skipped = draw_bands(panels[1], mode_bands(trajectory, time, modes), modes, 0.0 if few else NARROWEST * span)
    several = len(speed_lines) > 1
    style.header(panels[1], speed_lines + bands if several else bands, **({"ncol": 4} if several else {}))
    if few and event_time.size:
        curves = [(panels[1], speed_factor * column(events, "gear_speed"))]
        if not elastic:
            curves.append((panels[2], torque_factor * column(events, "motor_torque_after")))
        legend += draw_events(panels, curves, event_time, kinds)
    elif not few:
        counts = ", ".join(f"{rows.size} × {EVENTS[kind][0]}" for kind, rows in kinds.items())
        note = f"{event_time.size} events, not drawn: {counts}" + ("; white: modes too brief" if skipped else "")
        legend.append(Line2D([], [], linestyle="none", label=textwrap.fill(note, LONGEST_NOTE)))
    if legend:
        bare = len(legend) == 1 and not few  # a note alone has no line to show
        style.header(panels[0], legend, **({"handlelength": 0.0, "handletextpad": 0.0} if bare else {}),
                     **({"ncol": 4} if elastic else {}))

    for panel in panels:
        style.few_ticks(panel.yaxis)
    panels[-1].set(xlabel="time [s]", xlim=(time[0], time[-1]) if span > 0.0 else (time[0] - 0.5, time[0] + 0.5))
    figure.align_ylabels()
    return figure
