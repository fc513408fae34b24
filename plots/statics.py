"""The picture of the statics: which motor torque turns the gear at a load, and which leaves it stuck."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.transforms import Affine2D, ScaledTranslation

import style
from result import NotAResult, attribute, columns, group, number, text, units

U, V = np.meshgrid(*2 * [np.linspace(-1.0, 1.0, 201)])  # places for a label: the axes from -1 to 1
STEP = U[0, 1] - U[0, 0]
LETTER, LINE = 0.0125, 0.04  # half the width of a letter and half the height of a label there
ASPECT = 0.7  # height of the axes over their width, about
BEYOND = 0.12  # how far the axes reach to the side on which no run broke away, as part of the other side


def diagonal(C1, C2, H):
    """Returns the slope of the picture's diagonal, chosen so that all regions can be seen."""
    small, large = sorted((abs(C1), abs(C2)))
    return 1.35 * large if large <= abs(H) else 1.2 * np.sqrt(small * large)


def room_for_label(wide, slopes, shift, placed):
    """Returns how far a label at each place is from the edges, the lines through the origin and other labels."""
    room = np.minimum(1.0 - np.abs(U) - wide, 1.0 - np.abs(V) - LINE)
    for slope in slopes:
        room = np.minimum(room, (np.abs(V - slope * (U + shift)) - LINE - abs(slope) * wide) / np.hypot(1.0, slope))
    for u, v, other in placed:
        room = np.minimum(room, np.maximum(np.abs(U - u) - wide - other, np.abs(V - v) - 2 * LINE))
    return room


def holds_label(region, wide):
    """Returns the places at which all corners of a label lie in the region."""
    x, y = int(np.ceil(wide / STEP)), int(np.ceil(LINE / STEP))
    corners = [np.roll(region, (dy, dx), axis=(0, 1)) for dy in (-y, y) for dx in (-x, x)]
    return region & np.logical_and.reduce(corners)


def label_region(axes, words, region, colour, fill, slopes, shift, placed):
    """Writes into a region where most room is, or beside it with a line to it where it is too narrow."""
    wide = LETTER * len(words)
    room = room_for_label(wide, slopes, shift, placed)
    frame = Affine2D().translate(1.0, 1.0).scale(0.5) + axes.transAxes
    look = {"color": colour, "size": 15, "weight": "bold", "ha": "center", "va": "center", "zorder": 5}
    choice = np.where(holds_label(region, wide), room, -1.0)
    middle = region & (np.abs(np.abs(U + shift) - 0.5 * (1.0 + abs(shift))) < 0.5 * STEP)  # of the region, half way out
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


def widest_gap(loads, end):
    """Returns the middle of the widest gap between loads, zero and the end, of equal gaps the outermost."""
    edges = np.sort(np.append(loads[loads < end], (0.0, end)))
    k = np.argmax(np.diff(edges**2))
    return 0.5 * (edges[k] + edges[k + 1])


def label_line(axes, words, slope, steepness, x, align, above, colour):
    """Writes along a line through the origin; steepness 1: the diagonal."""
    angle = np.arctan(steepness * ASPECT)
    gap = (4.0 if above else -4.0) / 72 * np.array([-np.sin(angle), np.cos(angle)])
    axes.text(x, slope * x, words, color=colour, zorder=5, ha=align,
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


def draw_lines(axes, load, C1, C2, slopes, steepness, points, amid):
    """Draws the break-in torques as lines, named at one end away from the points, or amid the points."""
    (left, right), (_, y_end) = axes.get_xlim(), axes.get_ylim()
    if amid:
        side = 1 if right >= -left else -1
    else:
        side = -1 if np.sum(np.sign(points)) > 0 else 1
    ends, x_end = np.array([load.min(), load.max()]), max(-left, right)
    for k, C, colour in ((0, C1, style.GREEN), (1, C2, style.PURPLE)):
        axes.plot(ends, slopes[k] * ends, color=colour, zorder=3)
        x, align = x_end / max(1.0, abs(slopes[k]) * x_end / y_end), "center"
        if amid:
            x = widest_gap(side * points, min(x, (side * ends).max()))
        else:
            x, align = 0.97 * x, "right" if side > 0 else "left"
        label_line(axes, rf"$-C_{k + 1}\,\tau_l$, slope {style.number(-C)}", slopes[k], steepness[k], side * x, align,
                   side * slopes[k] >= side * slopes[1 - k], colour)


def draw_points(axes, words, load, motor, direction, filled):
    """Draws break-in torques by direction and returns their legend."""
    handles = []
    for sign, way, marker, colour in ((1, "forward", "^", style.BLUE), (-1, "backward", "v", style.VERMILLION)):
        look = {"color": colour, "markeredgecolor": style.INK} if filled else \
            {"color": "white", "markeredgecolor": colour, "markeredgewidth": 2.0}
        rows = np.sign(direction) == sign
        if rows.any():
            handles += axes.plot(load[rows], motor[rows], marker, label=f"{words}, {way}", markersize=9, zorder=6,
                                 **look)
    return handles


def all_break_aways(runs):
    """Returns load torque, motor torque and direction of the break-aways of all runs, or nothing."""
    parts = zip(*((run.load, run.motor, 2 * run.forward - 1) for run in runs))
    values = [np.concatenate(part) for part in parts]
    return values if values and values[0].size else None


def torque_units(result):
    """Returns the units of load and motor torque."""
    table = group(result, "statics")
    return units(table, "load_torque"), units(table, "stick_low")


def draw(result, runs=()):
    """Returns the figure of the statics, with the break-aways of runs where there are any."""
    table = group(result, "statics")
    load, low, high, surface = columns(table, "load_torque", "stick_low", "stick_high", "static_surface")
    measured = columns(group(result, "measured"), "load_torque", "motor_torque", "direction") \
        if "measured" in result else None
    C1, C2, H, mu, mu_w, mu_g = (number(result, name) for name in ("C1", "C2", "H", "mu", "mu_w", "mu_g"))
    outside = number(result, "stuck_outside") != 0.0

    broken = all_break_aways(runs)
    far = np.abs(broken[0]).max() if broken else 0.0

    x_end = np.abs(load).max()
    x_end = np.clip(x_end, 1.04 * far, 1.15 * far) if far else x_end
    y_end = diagonal(C1, C2, H) * x_end
    if not outside:
        y_end = max(y_end, 4.0 * np.interp(0.0, load, high))  # bearings hold without a load
    if measured:
        x_end, y_end = max(x_end, 1.1 * np.abs(measured[0]).max()), max(y_end, 1.2 * np.abs(measured[1]).max())
    if broken:
        y_end = max(y_end, 1.1 * np.abs(broken[1]).max())
    if not (0.0 < x_end < np.inf and 0.0 < y_end < np.inf):
        raise NotAResult("its torques are all zero or not finite")
    x_factor, x_unit = style.scale(units(table, "load_torque"), x_end)
    y_factor, y_unit = style.scale(units(table, "stick_low"), y_end)
    x_end, y_end = x_factor * x_end, y_factor * y_end
    load, low, high, surface = x_factor * load, y_factor * low, y_factor * high, y_factor * surface

    title = text(attribute(result, "title"))
    common, _ = style.split_titles([title] + [run.title for run in runs])
    figure = style.new_figure(common if runs and common else title)
    axes = figure.subplots()
    points = x_factor * np.concatenate([[], *(found[0] for found in (broken, measured) if found)])
    one_sided = far and not outside
    left = -BEYOND * x_end if one_sided and points.min() >= 0.0 else -x_end
    right = BEYOND * x_end if one_sided and points.max() <= 0.0 else x_end
    half, shift = 0.5 * (right - left), (right + left) / (right - left)
    axes.set(xlim=(left, right), ylim=(-y_end, y_end), xlabel=f"load torque on the gear [{x_unit}]",
             ylabel=f"motor torque [{y_unit}]")
    axes.set_title(f"{text(attribute(result, 'regime'))}:  $\\mu$ = {mu:.4g},  $\\mu_w$ = {mu_w:.4g},  "
                   f"$\\mu_g$ = {mu_g:.4g}", loc="left", size=13, pad=54 if broken and measured else 34)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    axes.axvline(0.0, color=style.GREY, linewidth=0.8, zorder=1)
    fill_regions(axes, load, low, high, outside)

    slopes = np.array([-C1, -C2, H]) * y_factor / x_factor
    steepness = slopes * half / y_end
    draw_lines(axes, load, C1, C2, slopes, steepness, points, amid=far > 0.0)
    handles = axes.plot(load, surface, color=style.INK, linestyle=(0, (5, 3)), linewidth=1.4, zorder=2,
                        label=rf"static surface $\tau_m = H\,\tau_l$, slope {style.number(H)}")
    for words, found in (("measured", measured), ("break-away in a run", broken)):
        if found:
            handles += draw_points(axes, words, x_factor * found[0], y_factor * found[1], found[2], found is measured)
    if runs and not broken:
        handles.append(Line2D([], [], linestyle="none", label="no break-away in the runs"))
    style.header(axes, handles, handlelength=2.6, ncol=3 if broken else 6)

    X, Y = half * (U + shift), V * y_end
    over, under = Y > np.interp(X, load, high), Y < np.interp(X, load, low)
    known = (X >= load.min()) & (X <= load.max())
    over, under, within, placed = over & known, under & known, ~over & ~under & known, []
    forward, backward, stuck = (within & (X > 0), within & (X < 0), over | under) if outside else (over, under, within)
    for words, region, colour, fill in (("turns forward", forward, style.BLUE, style.PALE_BLUE),
                                        ("turns backward", backward, style.VERMILLION, style.PALE_ORANGE),
                                        ("stuck", stuck & (X > 0), style.INK, style.STUCK),
                                        ("stuck", stuck & (X < 0), style.INK, style.STUCK)):
        label_region(axes, words, region, colour, fill, steepness, shift, placed)
    return figure
