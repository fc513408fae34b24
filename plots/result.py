"""Reading wormdrive result files."""

import h5py
import numpy as np


class NotAResult(Exception):
    """The file lacks what a wormdrive result has; the text says what."""


def text(value):
    """Returns an HDF5 string, stored as bytes or text, as text."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def attribute(node, name):
    """Returns an attribute that has to be there."""
    if name not in node.attrs:
        raise NotAResult(f"it has no attribute '{name}'")
    return node.attrs[name]


def number(node, name):
    """Returns an attribute that has to be one number."""
    value = attribute(node, name)
    if np.ndim(value) or not np.issubdtype(np.asarray(value).dtype, np.number):
        raise NotAResult(f"its attribute '{name}' is not a number")
    return float(value)


def group(file, name):
    """Returns a group that has to be there."""
    found = member(file, name, h5py.Group)
    if found is None:
        raise NotAResult(f"it has no group '{name}'")
    return found


def member(table, name, kind):
    """Returns a member of a group, which lies in the file itself: links lead to other files, or in circles."""
    found = isinstance(table.get(name, getlink=True), h5py.HardLink) and table.get(name)
    return found if isinstance(found, kind) else None


def dataset(table, name):
    """Returns a one-dimensional dataset that has to be there, and for which the file is large enough: of a result every
    row is written, and none is compressed."""
    column = member(table, name, h5py.Dataset)
    if column is None or column.ndim != 1:
        raise NotAResult(f"it has no column '{table.name}/{name}'")
    if column.is_virtual or column.external or column.id.get_create_plist().get_nfilters():
        raise NotAResult(f"column '{column.name}' is compressed or outside the file")
    if column.size * column.id.get_type().get_size() > column.id.get_storage_size():
        raise NotAResult(f"column '{column.name}' states more rows than the file contains")
    return column


def column(table, name):
    """Returns the values of a numeric column."""
    values = dataset(table, name)
    if values.dtype.kind not in "iuf":
        raise NotAResult(f"column '{values.name}' contains no numbers")
    return values[:]


def columns(table, *names, may_be_empty=False):
    """Returns several numeric columns, which must be equally long and mostly not empty."""
    values = [column(table, name) for name in names]
    if len({v.size for v in values}) > 1:
        raise NotAResult(f"the columns of '{table.name}' differ in length")
    if values[0].size == 0 and not may_be_empty:
        raise NotAResult(f"'{table.name}' has no rows")
    return values


def units(table, name):
    """Returns the units of a column."""
    return text(attribute(dataset(table, name), "units"))


def flags(table, name):
    """Returns what the values of a flag column mean, as {value: meaning}."""
    column = dataset(table, name)
    meanings = text(attribute(column, "flag_meanings")).split()
    return dict(zip(np.atleast_1d(attribute(column, "flag_values")).tolist(), meanings))
