"""What a run with elastic teeth shows besides: the worm's speed, and a panel with the force between the teeth."""

import style
from result import columns, number, units


def elastic(trajectory):
    """Returns whether worm and gear of a run move on their own."""
    return "worm_speed" in trajectory


def draw_worm(panel, result, trajectory, time, factor):
    """Draws the worm's speed as the gear would have it on rigid teeth; returns its line and the values."""
    (worm,) = columns(trajectory, "worm_speed")
    values = factor * worm / number(result, "ratio")
    line = panel.plot(*style.decimate(time, values), color=style.VERMILLION, linewidth=1.2, zorder=4,
                      label="worm speed / ratio")[0]
    return line, values


def draw_force(panel, trajectory, time):
    """Draws the normal force, positive on the left flank and negative on the right one."""
    force, flank = columns(trajectory, "normal_force", "flank")
    factor, unit = style.scale(units(trajectory, "normal_force"), force)
    panel.plot(*style.decimate(time, factor * force * flank), color=style.PURPLE, linewidth=1.2, zorder=3)
    panel.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=2)
    panel.set(ylabel=f"force, left +\nright − [{unit}]", ylim=style.limits(factor * force * flank))
