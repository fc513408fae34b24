"""The picture of a rare miss: the probability with which a drive comes near the limit, level by level."""

import numpy as np

import style
from result import NotAResult, attribute, column, columns, group, number, text, units

QUANTILE = 1.959963984540054  # of a 95 % interval


def draw(result):
    """Returns the figure of an estimate that is complete."""
    if "estimates" not in result:
        raise NotAResult("its estimate is not complete; go on with wormdrive rare --resume")
    levels, estimates = group(result, "levels"), group(result, "estimates")
    distance, share, variation = columns(levels, "distance", "share", "variation")
    probability, deviation = np.cumprod(share), np.sqrt(np.cumsum(variation**2))
    low, high = probability * np.exp(-QUANTILE * deviation), probability * np.exp(QUANTILE * deviation)
    factor, unit = style.scale(units(levels, "distance"), distance)
    figure = style.new_figure(text(attribute(result, "title")))
    panel = figure.subplots()
    panel.set_yscale("log")
    x = factor * distance
    panel.fill_between(x, low, high, color=style.PALE_BLUE, linewidth=0, zorder=1)
    handles = [panel.plot(x, probability, color=style.BLUE, marker="o", zorder=3,
                          label="subset simulation, with its 95 % interval")[0]]
    if "design_point" in result and number(group(result, "design_point"), "converged"):
        around = column(estimates, "probability")[1:]
        ends = [column(estimates, name)[1] for name in ("low", "high")]
        spread = np.abs(np.subtract(ends, around[0]))[:, np.newaxis]
        handles.append(panel.errorbar(0.0, around[0], yerr=spread, color=style.VERMILLION, marker="D", capsize=4,
                                      linestyle="none", zorder=4, label="samples around the design point"))
    metric = text(attribute(estimates, "metric")).replace("_", " ")
    panel.set(xlabel=f"distance of the {metric} from its limit [{unit}]", ylabel="probability to come as near")
    style.header(panel, handles)
    return figure
