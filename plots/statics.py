"""The picture of the statics: which motor torque turns the gear at a load, and which leaves it stuck."""

import numpy as np
from matplotlib.transforms import ScaledTranslation

import style
from result import attribute, columns, group, text, units

GRID = np.linspace(-1.0, 1.0, 201)  # of places for a label, as part of half the axes
LABEL = 0.18, 0.04  # half width and half height of a label on it
ASPECT = 0.7  # height of the axes over their width, about


def height(C1, C2, H):
    """Returns the slope of the picture's diagonal, in which all regions can be seen."""
    small, large = sorted((abs(C1), abs(C2)))
    return 1.35 * large if large <= abs(H) else 1.2 * np.sqrt(small * large)


def room_for_label(slopes):
    """Returns for every place of the grid how far a label there is from the edges and from lines v = slope u."""
    (u, v), (w, h) = np.meshgrid(GRID, GRID), LABEL
    room = np.minimum(1.0 - np.abs(u) - w, 1.0 - np.abs(v) - h)
    for slope in slopes:
        room = np.minimum(room, (np.abs(v - slope * u) - h - abs(slope) * w) / np.hypot(1.0, slope))
    return room


def inside(region):
    """Returns the places of the grid at which a label has its corners in the region."""
    w, h = (int(np.ceil(half / (GRID[1] - GRID[0]))) for half in LABEL)
    return region & np.all([np.roll(region, (y, x), axis=(0, 1)) for y in (-h, h) for x in (-w, w)], axis=0)


def label_region(axes, region, words, colour, fill, room):
    """Writes into a region where most room is, or beside it with a line to it; returns the room that is left."""
    if not region.any():
        return room
    u, v = np.meshgrid(GRID, GRID)
    look = {"color": colour, "size": 15, "weight": "bold", "ha": "center", "va": "center", "zorder": 5}
    choice = np.where(inside(region), room, -1.0)
    if choice.max() > 0.0:
        place = np.unravel_index(np.argmax(choice), room.shape)
        axes.text(u[place], v[place], words, **look, bbox={"facecolor": fill, "edgecolor": "none", "pad": 2})
    else:
        target = np.unravel_index(np.argmin(np.where(region, np.abs(np.abs(u) - 0.5), 9.0)), room.shape)
        distance = np.hypot(u - u[target], (v - v[target]) / ASPECT)
        place = np.unravel_index(np.argmin(np.where(room > 0.03, distance, 9.0)), room.shape)
        axes.annotate(words, (u[target], v[target]), (u[place], v[place]), **look,
                      arrowprops={"arrowstyle": "-", "color": colour, "shrinkA": 0, "shrinkB": 0})
    taken = np.maximum(np.abs(u - u[place]) - 2 * LABEL[0], np.abs(v - v[place]) - 2 * LABEL[1])
    return np.minimum(room, taken)
