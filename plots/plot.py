#!/usr/bin/env python3
"""Draws wormdrive result files as a PNG picture: plot.py FILE.h5 [MORE.h5 ...] -o OUT.png [--over X] [--part PART]"""

import argparse
import os
import sys

import h5py

import diagnosis
import efficiency
import over
import rare
import run
import statics
import steady
import sweep
from result import NotAResult, attribute, text

PICTURES = {"run": run.draw, "statics": statics.draw, "steady": steady.draw, "efficiency": efficiency.draw,
            "sweep": sweep.draw, "rare": rare.draw, "diagnosis": diagnosis.draw}
NOT_A_RESULT, NOT_WRITTEN = 2, 4  # exit codes
SOFTWARE = "wormdrive plot"  # as the pictures say
MARK = b"Software\0" + SOFTWARE.encode()  # where a PNG file says so


def fail(code, message):
    """Ends the program with one line on stderr."""
    print("plot: " + " ".join(str(message).split()), file=sys.stderr)
    sys.exit(code)


def reason(error):
    """Returns why the system refused, in its own words where it has any."""
    return os.strerror(error.errno) if getattr(error, "errno", None) else error


def read(path, reader):
    """Returns what a reader makes of a result file."""
    try:
        if os.path.isfile(path) and not h5py.is_hdf5(path):
            raise NotAResult("it is not an HDF5 file")
        with h5py.File(path, "r") as result:
            return reader(result)
    except NotAResult as error:
        fail(NOT_A_RESULT, f"{path} is not a wormdrive result that can be drawn: {error}")
    except OSError as error:
        fail(NOT_A_RESULT, f"cannot read {path}: {reason(error)}")
    except (ArithmeticError, LookupError, MemoryError, RuntimeError, TypeError, ValueError) as error:
        fail(NOT_A_RESULT, f"{path} is not a wormdrive result that can be drawn: {error or type(error).__name__}")


def kind(result):
    """Returns which picture shows a result."""
    name = text(attribute(result, "kind"))
    if name not in PICTURES:
        raise NotAResult(f"there is no picture for the kind '{name}'")
    return name


def read_runs(paths, reader):
    """Returns what a reader makes of run files, whose units must agree."""
    for path in paths:
        if (name := read(path, kind)) != "run":
            fail(NOT_A_RESULT, f"{path} holds a result of the kind '{name}' where a run is needed")
    runs = [read(path, reader) for path in paths]
    for path, other in zip(paths, runs):
        if other.units != runs[0].units:
            fail(NOT_A_RESULT, f"{path} is in other units than {paths[0]}")
    return runs


def picture(paths, over_torque, part):
    """Returns the figure that shows the result files."""
    first, *others = paths
    name = read(first, kind)
    if part:
        if name != "diagnosis" or others:
            fail(NOT_A_RESULT, "--part needs one result of a diagnosis")
        return read(first, lambda result: diagnosis.draw(result, part))
    if over_torque:
        names = [os.path.splitext(os.path.basename(path))[0] for path in paths]
        return over.draw(read_runs(paths, over.read), names)
    if not others:
        return read(first, PICTURES[name])
    if name == "sweep":
        return sweep.draw_overlay(read_runs(others, sweep.read_course))
    if name != "statics":
        fail(NOT_A_RESULT, "several runs need --over motor_torque, or a statics or sweep file first")
    runs = read_runs(others, run.break_aways)
    if runs[0].units[:2] != read(first, statics.torque_units):
        fail(NOT_A_RESULT, f"{others[0]} is in other units than {first}")
    return read(first, lambda result: statics.draw(result, runs))


def is_picture(path):
    """Returns whether a file is a picture that this program drew; an empty one is nobody's."""
    with open(path, "rb") as file:
        start = file.read(4096)
    return not start or MARK in start


def reject_replacing(path, force):
    """Ends the program if a picture may not take the place of what is there: only of an older picture, unless forced."""
    for there in (path, path + ".part"):
        if os.path.lexists(there) and not os.path.isfile(there):
            fail(NOT_WRITTEN, f"cannot write {there}: it is not a plain file")
        if not force and os.path.exists(there) and not is_picture(there):
            fail(NOT_WRITTEN, f"cannot write {there}: it exists and is no picture of wormdrive; choose another name, or "
                              "replace it with --force")
    if os.path.islink(path + ".part"):
        fail(NOT_WRITTEN, f"cannot write {path}.part: it is a symbolic link")


def save(figure, path, force):
    """Writes the picture under a temporary name first, so that a picture is whole or absent; a link stays one."""
    path = os.path.realpath(path)
    part = path + ".part"
    try:
        reject_replacing(path, force)
        figure.savefig(part, format="png", metadata={"Software": SOFTWARE})
        os.replace(part, path)
    except OSError as error:
        if os.path.isfile(part) and not os.path.islink(part):
            os.remove(part)
        fail(NOT_WRITTEN, f"cannot write {path}: {reason(error)}")


def save_all(path, folder, at_a_time, force):
    """Draws every picture of a diagnosis into a folder, some at a time; returns the worst exit code."""
    parts = list(diagnosis.PARTS)
    children = []
    for first in range(min(at_a_time, len(parts))):
        child = os.fork()  # what is imported is shared
        if child == 0:
            for part in parts[first::at_a_time]:
                save(picture([path], None, part), os.path.join(folder, part + ".png"), force)
            sys.exit(0)
        children.append(child)
    # of a child that was killed it is negative
    return max(abs(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])) for child in children)


def main():
    """Reads the command line and draws."""
    parser = argparse.ArgumentParser(prog="plot", description="Draws wormdrive result files as a PNG picture.")
    parser.add_argument("files", metavar="FILE.h5", nargs="+",
                        help="result of wormdrive run, statics, steady, efficiency, sweep or diagnose; a statics file and "
                             "runs; a sweep and runs of its trials; or, with --over, several runs")
    parser.add_argument("-o", "--output", metavar="OUT.png", required=True, help="picture to write")
    parser.add_argument("--over", choices=["motor_torque"], help="draw the gear angle of runs over the motor torque")
    parser.add_argument("--part", choices=[*diagnosis.PARTS, "all"],
                        help="which picture of a diagnosis; all: every one, OUT.png is a folder then")
    parser.add_argument("--at-a-time", metavar="N", type=int, default=1, help="how many of all to draw at a time")
    parser.add_argument("--force", action="store_true", help="replace what is there, even if it is no older picture")
    arguments = parser.parse_args()
    if arguments.part == "all":
        sys.exit(save_all(arguments.files[0], arguments.output, arguments.at_a_time, arguments.force))
    for target in (arguments.output, arguments.output + ".part"):
        for file in arguments.files:
            if os.path.exists(target) and os.path.exists(file) and os.path.samefile(target, file):
                fail(NOT_WRITTEN, f"cannot write {arguments.output}: it would overwrite {file}")
    save(picture(arguments.files, arguments.over, arguments.part), arguments.output, arguments.force)


if __name__ == "__main__":
    main()
