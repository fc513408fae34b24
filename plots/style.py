"""The common look of all pictures."""

import os
import textwrap

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

SIZE, DPI = (10.8, 8.1), 150  # [in], [1/in]

INK, GREY, EVENT = "#1c2733", "#6b7782", "#8d99a5"
BLUE, VERMILLION, GREEN, PURPLE = "#0072b2", "#d55e00", "#00795c", "#a3478a"  # after Okabe and Ito
PALE_BLUE, MID_BLUE = "#dcebf7", "#a9cfec"
PALE_ORANGE, MID_ORANGE = "#fdeccf", "#f8c987"
STUCK, DARK_STUCK = "#d9dcdf", "#b9bfc5"

matplotlib.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 12, "legend.fontsize": 11,
    "axes.edgecolor": GREY, "axes.labelcolor": INK, "axes.linewidth": 0.8, "text.color": INK,
    "axes.spines.top": False, "axes.spines.right": False,
    "xtick.color": GREY, "ytick.color": GREY, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "axes.grid": True, "grid.color": "#d4d9de", "grid.linewidth": 0.6, "axes.axisbelow": True,
    "axes.formatter.useoffset": False, "axes.formatter.limits": (-4, 5),
    "lines.linewidth": 1.8, "legend.frameon": False, "legend.borderaxespad": 0.0, "legend.handletextpad": 0.5,
})


def new_figure(title):
    """Returns an empty figure with its title."""
    figure = Figure(figsize=SIZE, dpi=DPI, layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.08, hspace=0.02)
    figure.suptitle(textwrap.fill(title, 84), x=0.012, ha="left", size=15, weight="bold", parse_math=False)
    return figure


def split_titles(titles):
    """Returns what differing titles have in common, at least two words up to a comma, and what is left of each."""
    words = [title.split() for title in titles]
    common = os.path.commonprefix(words)
    commas = [k + 1 for k, word in enumerate(common) if word.endswith((",", ";"))]
    common = common[:commas[-1]] if commas else common
    common = common if len(common) > 1 and common not in words else []
    return " ".join(common).rstrip(" ,;:"), [" ".join(own[len(common):]) for own in words]


def scale(unit, *values):
    """Returns a factor and a unit with prefix in which the values have readable sizes."""
    peak = max(np.max(np.abs(v), initial=0.0, where=np.isfinite(v)) for v in values)
    for factor, prefix in ((1.0, ""), (1e3, "m"), (1e6, "µ")):
        if peak * factor >= 0.3:
            return factor, prefix + unit
    return 1.0, unit


def number(value):
    """Returns a number as a label shows it: four digits, a true minus sign, no rounding noise."""
    return f"{value if abs(value) > 1e-12 else 0.0:.4g}".replace("-", "−")


def few_ticks(axis, most=5):
    """Asks for about so many ticks, never fewer than three."""
    axis.set_major_locator(MaxNLocator(nbins=most, steps=[1, 2, 2.5, 5, 10], min_n_ticks=3))


def limits(values, margin=0.07):
    """Returns axis limits around the values, of sensible width where they are constant."""
    values = values[np.isfinite(values)]
    low, high = np.min(values, initial=np.inf), np.max(values, initial=-np.inf)
    if low > high:
        return -1.0, 1.0
    width = high - low
    if width <= 1e-9 * max(abs(low), abs(high)) or width == 0.0:
        width = 2.0 * max(abs(low), abs(high)) or 1.0
    return low - margin * width, high + margin * width


def header(axes, handles, **options):
    """Puts a legend above the axes."""
    options = {"ncol": 6, "columnspacing": 1.1, "handlelength": 1.2} | options
    return axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.015), **options)


def decimate(x, y, pixels=2000):
    """Leaves out what no eye can see: keeps first, lowest, highest and last point of every pixel column."""
    if x.size <= 4 * pixels:
        return x, y
    pixel = ((x - x[0]) * (pixels / (x[-1] - x[0]))).astype(int)
    order = np.lexsort((y, pixel))  # pixel by pixel, in each from low to high
    first = np.flatnonzero(np.diff(pixel, prepend=-1))
    last = np.append(first[1:], x.size) - 1
    keep = np.unique(np.concatenate([first, last, order[first], order[last]]))
    return x[keep], y[keep]
