#!/usr/bin/env python3
"""Draws a wormdrive result file as a PNG picture: plot.py FILE.h5 -o OUT.png"""

import argparse
import os
import sys

import h5py

import run
import statics
import steady
from result import NotAResult, attribute, text

PICTURES = {"run": run.draw, "statics": statics.draw, "steady": steady.draw}
NOT_A_RESULT, NOT_WRITTEN = 2, 4  # exit codes


def fail(code, message):
    """Ends the program with one line on stderr."""
    print("plot: " + " ".join(str(message).split()), file=sys.stderr)
    sys.exit(code)


def reason(error):
    """Returns why the system refused, in its own words where it has any."""
    return os.strerror(error.errno) if getattr(error, "errno", None) else error


def picture(path):
    """Returns the figure that shows a result file."""
    try:
        if os.path.isfile(path) and not h5py.is_hdf5(path):
            raise NotAResult("it is not an HDF5 file")
        with h5py.File(path, "r") as result:
            kind = text(attribute(result, "kind"))
            if kind not in PICTURES:
                raise NotAResult(f"there is no picture for the kind '{kind}'")
            return PICTURES[kind](result)
    except NotAResult as error:
        fail(NOT_A_RESULT, f"{path} is not a wormdrive result that can be drawn: {error}")
    except OSError as error:
        fail(NOT_A_RESULT, f"cannot read {path}: {reason(error)}")


def save(figure, path):
    """Writes the picture under a temporary name first, so that a picture is whole or absent."""
    part = path + ".part"
    if os.path.exists(path) and not os.path.isfile(path):
        fail(NOT_WRITTEN, f"cannot write {path}: it is not a plain file")
    try:
        figure.savefig(part, format="png")
        os.replace(part, path)
    except OSError as error:
        if os.path.isfile(part):
            os.remove(part)
        fail(NOT_WRITTEN, f"cannot write {path}: {reason(error)}")


def main():
    """Reads the command line and draws."""
    parser = argparse.ArgumentParser(prog="plot", description="Draws a wormdrive result file as a PNG picture.")
    parser.add_argument("file", metavar="FILE.h5", help="result of wormdrive run, statics or steady")
    parser.add_argument("-o", "--output", metavar="OUT.png", required=True, help="picture to write")
    arguments = parser.parse_args()
    for target in (arguments.output, arguments.output + ".part"):
        if os.path.exists(target) and os.path.exists(arguments.file) and os.path.samefile(target, arguments.file):
            fail(NOT_WRITTEN, f"cannot write {arguments.output}: it would overwrite {arguments.file}")
    save(picture(arguments.file), arguments.output)


if __name__ == "__main__":
    main()
