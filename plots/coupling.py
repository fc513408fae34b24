"""What a run with a load behind a coupling shows besides: the speed of the load, and the torque of the coupling."""

import style
from result import columns, number


def twists(trajectory):
    """Returns whether the load of a run turns on its own."""
    return "load_coupling_speed" in trajectory


def draw_load(panel, trajectory, time, factor):
    """Draws the speed of the load; returns its line and the values."""
    (speed,) = columns(trajectory, "load_coupling_speed")
    values = factor * speed
    line = panel.plot(*style.decimate(time, values), color=style.VERMILLION, linewidth=1.2, zorder=2.5, label="load")[0]
    return line, values


def on_worm(result, load, word):
    """Returns the torque of the coupling as a worm without friction feels it, and its label."""
    if "ratio" not in result.attrs:
        return load, f"{word} of the coupling"
    return load / number(result, "ratio"), f"{word} of the coupling / ratio"
