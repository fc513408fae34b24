"""What a run with a winding or a gearbox that warms up shows besides: how warm they are."""

import style
from result import columns

WARM = {  # column: label, colour
    "winding_temperature_rise": ("winding", style.VERMILLION),
    "gearbox_heat_temperature_rise": ("gearbox", style.BLUE),
}


def warm(trajectory):
    """Returns the columns of temperatures that change in a run."""
    return [name for name in WARM if name in trajectory and columns(trajectory, name)[0].any()]


def draw_temperatures(panel, trajectory, time, names):
    """Draws temperatures above that of the surroundings."""
    lines = []
    for name in names:
        label, colour = WARM[name]
        (rise,) = columns(trajectory, name)
        lines.append(panel.plot(*style.decimate(time, rise), color=colour, zorder=3, label=label)[0])
    panel.set(ylabel="above surroundings [K]")
    style.header(panel, lines)
