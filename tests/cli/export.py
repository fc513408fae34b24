#!/usr/bin/python3
"""Exports runs and reads them back with readers of others: export.py PROGRAM SCENARIOS

CSV is read with numpy, MAT with scipy where it is installed, and every column is compared with h5py's, bit for bit.
"""

import csv
import os
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

import h5py
import numpy as np

PROGRAM, SCENARIOS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SUFFIXES = {"s": "_s", "rad": "_rad", "rad/s": "_rad_per_s", "rad/s^2": "_rad_per_s2", "N m": "_Nm", "N": "_N"}


def wormdrive(*words, expect=0):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    assert done.returncode == expect, (words, done)
    return done.stderr.rstrip()


def check_csv(path, table):
    with open(path, encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    assert header[0] == "time_s", header
    by_name = dict(zip(header, zip(*rows)))
    assert len(by_name) == len(table), (header, list(table))
    for name, column in table.items():
        cells = by_name[name + SUFFIXES.get(column.attrs.get("units"), "")]
        if name == "kind":
            words = column.attrs["flag_meanings"].split()
            assert list(cells) == [words[k] for k in column[:]], cells
        else:
            assert np.array_equal(np.array(cells, float), column[:]), name


def check_mat(path, file):
    from scipy.io import loadmat

    found = loadmat(path, squeeze_me=True, struct_as_record=False)
    assert found["title"] == file.attrs["title"]
    for table in ("trajectory", "events", "controller"):
        assert (table in found) == (table in file), table
        for name, column in file.get(table, {}).items():
            assert np.array_equal(getattr(found[table], name), column[:]), (table, name)
            if "units" in column.attrs:
                assert getattr(getattr(found["units"], table), name) == column.attrs["units"], (table, name)
    assert "reversal" in found["meanings"].events.kind


def main():
    scipy = find_spec("scipy")
    for scenario in ("fig09_switching", "fig10_sliding_014rad_bare", "fig09_backlash"):
        wormdrive("run", SCENARIOS / f"{scenario}.toml", "-q", "--set", "run.duration_s=1.5", "-o", "run.h5", "--force")
        wormdrive("export", "run.h5", "--csv", "--force")
        wormdrive("export", "run.h5", "--mat")
        with h5py.File("run.h5") as file:
            for table in ("trajectory", "events", "controller"):
                path = "run.csv" if table == "trajectory" else f"run_{table}.csv"
                if table in file:
                    check_csv(path, file[table])
            if scipy:
                check_mat("run.mat", file)

    # what is no run, what is in the way, what is not asked for
    wormdrive("statics", SCENARIOS / "fig09_switching.toml", "-q", "-o", "statics.h5")
    assert wormdrive("export", "statics.h5", "--csv", expect=2) == (
        "statics.h5: error: is a result of 'statics'; wormdrive export takes that of a run or of a sweep")
    assert not Path("statics.csv").exists()
    Path("mine.csv").write_text("a,b\n1,2\n")
    wormdrive("export", "run.h5", "--csv", "-o", "mine.csv", expect=4)
    assert Path("mine.csv").read_text() == "a,b\n1,2\n" and not Path("mine_events.csv").exists()
    wormdrive("export", "run.h5", expect=2)
    wormdrive("export", "run.h5", "--csv", "--mat", expect=2)

    # a disk that is full leaves nothing
    done = subprocess.run(["bash", "-c", f"ulimit -f 8; exec {PROGRAM} export run.h5 --mat -o full.mat"],
                          capture_output=True, text=True)
    assert done.returncode == 4, done
    assert not list(Path().glob("full.mat*")), list(Path().glob("full.mat*"))
    print("export:", "CSV and MAT" if scipy else "CSV; without scipy no MAT", "read back")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
