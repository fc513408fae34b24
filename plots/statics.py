"""The picture of the statics: which motor torque turns the gear at a load, and which leaves it stuck."""

import numpy as np
from matplotlib.transforms import Affine2D, ScaledTranslation

import style
from result import NotAResult, attribute, columns, group, number, text, units

U, V = np.meshgrid(*2 * [np.linspace(-1.0, 1.0, 201)])  # places for a label: the axes from -1 to 1
STEP = U[0, 1] - U[0, 0]
LETTER, LINE = 0.0125, 0.04  # half the width of a letter and half the height of a label there
ASPECT = 0.7  # height of the axes over their width, about


def diagonal(C1, C2, H):
    """Returns the slope of the picture's diagonal, chosen so that all regions can be seen."""
    small, large = sorted((abs(C1), abs(C2)))
    return 1.35 * large if large <= abs(H) else 1.2 * np.sqrt(small * large)


def room_for_label(wide, slopes, placed):
    """Returns how far a label at each place is from the edges, the lines through the origin and other labels."""
    room = np.minimum(1.0 - np.abs(U) - wide, 1.0 - np.abs(V) - LINE)
    for slope in slopes:
        room = np.minimum(room, (np.abs(V - slope * U) - LINE - abs(slope) * wide) / np.hypot(1.0, slope))
    for u, v, other in placed:
        room = np.minimum(room, np.maximum(np.abs(U - u) - wide - other, np.abs(V - v) - 2 * LINE))
    return room


def holds_label(region, wide):
    """Returns the places at which all corners of a label lie in the region."""
    x, y = int(np.ceil(wide / STEP)), int(np.ceil(LINE / STEP))
    corners = [np.roll(region, (dy, dx), axis=(0, 1)) for dy in (-y, y) for dx in (-x, x)]
    return region & np.logical_and.reduce(corners)


def label_region(axes, words, region, colour, fill, slopes, placed):
    """Writes into a region where most room is, or beside it with a line to it where it is too narrow."""
    wide = LETTER * len(words)
    room = room_for_label(wide, slopes, placed)
    frame = Affine2D().translate(1.0, 1.0).scale(0.5) + axes.transAxes
    look = {"color": colour, "size": 15, "weight": "bold", "ha": "center", "va": "center", "zorder": 5}
    choice = np.where(holds_label(region, wide), room, -1.0)
    middle = region & (np.abs(np.abs(U) - 0.5) < 0.5 * STEP)  # of the region, half way out
    if choice.max() > 0.0:
        place = np.unravel_index(choice.argmax(), U.shape)
        axes.text(U[place], V[place], words, transform=frame, **look,
                  bbox={"facecolor": fill, "edgecolor": "none", "pad": 2})
    elif middle.any():
        u, v = U[middle].mean(), V[middle].mean()
        place = np.unravel_index(np.where(room > 0.05, np.hypot(U - u, (V - v) * ASPECT), 9.0).argmin(), U.shape)
        axes.annotate(words, (u, v), (U[place], V[place]), xycoords=frame, textcoords=frame, **look,
                      arrowprops={"arrowstyle": "-", "color": colour, "shrinkA": 2, "shrinkB": 0})
    else:
        return
    placed.append((U[place], V[place], wide))


def label_line(axes, words, slope, steepness, side, above, colour):
    """Writes along a line through the origin, near its left (side -1) or right (+1) end; steepness 1: the diagonal."""
    angle = np.arctan(steepness * ASPECT)
    gap = (4.0 if above else -4.0) / 72 * np.array([-np.sin(angle), np.cos(angle)])
    x = side * 0.97 * axes.get_xlim()[1] / max(1.0, abs(steepness))
    axes.text(x, slope * x, words, color=colour, zorder=5, ha="right" if side > 0 else "left",
              va="bottom" if above else "top", rotation_mode="anchor", transform_rotates_text=True,
              rotation=np.degrees(np.arctan(slope)),
              transform=axes.transData + ScaledTranslation(*gap, axes.figure.dpi_scale_trans))


def fill_regions(axes, load, low, high, outside):
    """Shades what the gear does at every pair of torques."""
    above, below, left, right = style.PALE_BLUE, style.PALE_ORANGE, style.STUCK, style.STUCK
    if outside:
        above, below, left, right = style.STUCK, style.STUCK, style.PALE_ORANGE, style.PALE_BLUE
    far = 10.0 * (np.abs(high).max() + np.abs(low).max() + axes.get_ylim()[1])
    for bottom, top, where, fill in ((high, far, None, above), (-far, low, None, below),
                                     (low, high, load <= 0.0, left), (low, high, load >= 0.0, right)):
        axes.fill_between(load, bottom, top, where=where, color=fill, linewidth=0, zorder=0)


def draw_measured(axes, load, motor, direction):
    """Draws measured break-in torques by direction and returns their legend."""
    handles = []
    for sign, words, marker, colour in ((1, "measured, forward", "^", style.BLUE),
                                        (-1, "measured, backward", "v", style.VERMILLION)):
        rows = np.sign(direction) == sign
        if rows.any():
            handles += axes.plot(load[rows], motor[rows], marker, color=colour, label=words, markersize=9,
                                 markeredgecolor=style.INK, zorder=6)
    return handles


def draw(result):
    """Returns the figure of the statics."""
    table = group(result, "statics")
    load, low, high, surface = columns(table, "load_torque", "stick_low", "stick_high", "static_surface")
    measured = columns(group(result, "measured"), "load_torque", "motor_torque", "direction") \
        if "measured" in result else None
    C1, C2, H, mu, mu_w, mu_g = (number(result, name) for name in ("C1", "C2", "H", "mu", "mu_w", "mu_g"))
    outside = number(result, "stuck_outside") != 0.0

    x_end = np.abs(load).max()
    y_end = diagonal(C1, C2, H) * x_end
    if not outside:
        y_end = max(y_end, 4.0 * np.interp(0.0, load, high))  # bearings hold without a load
    if measured:
        x_end, y_end = max(x_end, 1.1 * np.abs(measured[0]).max()), max(y_end, 1.2 * np.abs(measured[1]).max())
    if not (0.0 < x_end < np.inf and 0.0 < y_end < np.inf):
        raise NotAResult("its torques are all zero or not finite")
    x_factor, x_unit = style.scale(units(table, "load_torque"), x_end)
    y_factor, y_unit = style.scale(units(table, "stick_low"), y_end)
    x_end, y_end = x_factor * x_end, y_factor * y_end
    load, low, high, surface = x_factor * load, y_factor * low, y_factor * high, y_factor * surface

    figure = style.new_figure(text(attribute(result, "title")))
    axes = figure.subplots()
    axes.set(xlim=(-x_end, x_end), ylim=(-y_end, y_end), xlabel=f"load torque on the gear [{x_unit}]",
             ylabel=f"motor torque [{y_unit}]")
    axes.set_title(f"{text(attribute(result, 'regime'))}:  $\\mu$ = {mu:.4g},  $\\mu_w$ = {mu_w:.4g},  "
                   f"$\\mu_g$ = {mu_g:.4g}", loc="left", size=13, pad=34)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    axes.axvline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    fill_regions(axes, load, low, high, outside)

    slopes = np.array([-C1, -C2, H]) * y_factor / x_factor
    steepness = slopes * x_end / y_end
    side = -1 if measured and np.sum(np.sign(measured[0])) > 0 else 1  # away from the measured points
    ends = np.array([load.min(), load.max()])
    for k, C, colour in ((0, C1, style.GREEN), (1, C2, style.PURPLE)):
        axes.plot(ends, slopes[k] * ends, color=colour, zorder=3)
        label_line(axes, rf"$-C_{k + 1}\,\tau_l$, slope {style.number(-C)}", slopes[k], steepness[k], side,
                   side * slopes[k] >= side * slopes[1 - k], colour)
    handles = axes.plot(load, surface, color=style.INK, linestyle=(0, (5, 3)), linewidth=1.4, zorder=2,
                        label=rf"static surface $\tau_m = H\,\tau_l$, slope {style.number(H)}")
    if measured:
        handles += draw_measured(axes, x_factor * measured[0], y_factor * measured[1], measured[2])
    style.header(axes, handles, handlelength=2.6)

    over, under = V * y_end > np.interp(U * x_end, load, high), V * y_end < np.interp(U * x_end, load, low)
    within, placed = ~over & ~under, []
    forward, backward, stuck = (within & (U > 0), within & (U < 0), ~within) if outside else (over, under, within)
    label_region(axes, "turns forward", forward, style.BLUE, style.PALE_BLUE, steepness, placed)
    label_region(axes, "turns backward", backward, style.VERMILLION, style.PALE_ORANGE, steepness, placed)
    label_region(axes, "stuck", stuck & (U > 0), style.INK, style.STUCK, steepness, placed)
    label_region(axes, "stuck", stuck & (U < 0), style.INK, style.STUCK, steepness, placed)
    return figure
