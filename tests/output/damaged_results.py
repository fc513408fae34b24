#!/usr/bin/env python3
"""Damages results in every way that HDF5 allows, one column or attribute at a time, and gives them to whoever reads
results: damaged_results.py PROGRAM PLOT.py [--all]. Each must be refused in one line with exit code 2, within the memory
that a small file may take. Without --all it takes one in 47, other ones for every column. Prints one line per fault;
exit status 1 if there is any.
"""

import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

import h5py
import numpy as np

PROGRAM, PLOT = (Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(PLOT.parent))
STRIDE = 1 if "--all" in sys.argv else 47
PICTURES = 7 if "--all" in sys.argv else 13  # of so many damages one is drawn, which takes a second
WITHOUT_ROWS = "without rows"
SCENARIOS = Path(__file__).resolve().parents[2] / "scenarios"
MEMORY, SECONDS = 3 << 30, 20  # of address space, most of it libraries; of CPU time
CHECKED = b"san.so" in PROGRAM.read_bytes()  # a memory checker reserves terabytes of address space
HUGE = 2**40
TEXT = h5py.string_dtype()

STUDY = """scenario = "{scenario}"
set = ["run.solver=taylor", "run.duration_s=0.05", "run.report_interval_s=0.05", "metrics.from_s=0.01"]
[sweep]
design = "monte_carlo"
trials = 12
seed = 3
[[parameter]]
path = "mesh.friction"
distribution = "uniform"
low = 0.2
high = 0.3
[[threshold]]
metric = "error_max"
above_rad = 0.1
"""


def limit():
    """Bounds what a child may take."""
    if not CHECKED:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(*words):
    """Runs a command; returns what came of it."""
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, errors="replace", preexec_fn=limit,
                          timeout=120, check=False)


def draw(*words):
    """Draws as PLOT.py does, in a process of its own that shares what is imported here; returns exit code and stderr."""
    import plot  # takes a second, once
    import style
    style.DPI = 15  # whether a picture is drawn does not depend on its pixels, most of its cost does
    told, tells = os.pipe()
    child = os.fork()
    if child == 0:
        limit()
        signal.alarm(120)
        os.dup2(tells, 2)
        os.close(told)
        sys.argv = [str(PLOT), *words]
        try:
            plot.main()
            code = 0
        except SystemExit as end:
            code = end.code or 0
        except BaseException:  # what would end a program of its own with a traceback
            traceback.print_exc()
            code = 1
        sys.stderr.flush()
        os._exit(code)
    os.close(tells)
    with os.fdopen(told, errors="replace") as pipe:
        stderr = pipe.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), stderr


def make(*words):
    """Runs a command that has to succeed."""
    done = run(*words)
    if done.returncode:
        sys.exit(f"{' '.join(words)}: {done.stderr}")


def replaced(path, make_dataset):
    """A damage that puts another dataset in the place of one, with its attributes."""
    def damage(file):
        attributes = {k: v for k, v in file[path].attrs.items() if k in ("units", "long_name", "flag_values")}
        del file[path]
        make_dataset(file)
        file[path].attrs.update(attributes)
    return damage


def dataset_damages(path, values):
    """Yields (what, damage) for a column."""
    number, n = values.dtype == np.float64, values.size

    def written(data):
        return replaced(path, lambda file: file.create_dataset(path, data=data))

    def stated(**how):
        return replaced(path, lambda file: file.create_dataset(path, **how))

    def linked(link):
        def damage(file):
            del file[path]
            file[path] = link(file)
        return damage

    def virtual(file):
        layout = h5py.VirtualLayout(shape=(n,), dtype=values.dtype)
        layout[:] = h5py.VirtualSource("elsewhere.h5", "x", shape=(n,), dtype=values.dtype)
        file.create_virtual_dataset(path, layout)

    yield "missing", lambda file: file.__delitem__(path)
    yield "of texts", written(np.array(["a"] * n, dtype=TEXT))
    yield "of padded texts", written(np.array([b"abc"] * n))
    yield "of another type", written(np.zeros(n, "i1" if number else "f8"))
    yield "of 32 bits", written(np.zeros(n, "f4" if number else "i4"))
    yield "of 64-bit integers", written(np.zeros(n, "i8"))
    yield "of pairs", written(np.zeros(n, [("a", "f8"), ("b", "f8")]))
    yield "of one value", written(values[0] if n else 0.0)
    yield "of two dimensions", written(np.zeros((n, 2), values.dtype))
    yield "empty", written(values[:0])
    if n > 1:
        yield "of one row", written(values[:1])
    yield "too short", written(values[:-1])
    yield "too long", written(np.append(values, values[-1:]))
    yield "much too long", written(np.resize(values, 50 * n))
    yield "huge and not there", stated(shape=(HUGE,), chunks=(4096,), dtype=values.dtype)
    yield "huge and compressed", stated(shape=(2**29,), chunks=(2**20,), dtype=values.dtype, compression="gzip")
    yield "of the right length and not there", stated(shape=(n,), chunks=(1,), dtype=values.dtype)
    yield "compressed", stated(data=values, compression="gzip")
    yield "in another file", stated(shape=(n,), dtype=values.dtype, external=[("/dev/zero", 0, 8 * n)])
    yield "virtual", replaced(path, virtual)
    yield "a link to itself", linked(lambda file: h5py.SoftLink("/" + path))
    yield "a link to another name", linked(lambda file: h5py.SoftLink("/kept/" + path))
    yield "a link to another file", linked(lambda file: h5py.ExternalLink("good.h5", path))
    yield "the file itself", linked(lambda file: file["/"])
    yield "a type", linked(lambda file: np.dtype("f8"))


def text_damages(path, values):
    """Yields (what, damage) for a column of texts of 512 bytes."""
    for data in (np.zeros(values.size), np.full(values.size, "a", TEXT), values.astype("S9"), values.astype("S600"),
                 values[:-1], np.append(values, values[-1:])):
        yield (f"as {data.size} of {data.dtype}",
               replaced(path, lambda file, data=data: file.create_dataset(path, data=data)))
    yield "missing", lambda file: file.__delitem__(path)


def range_damages(path, values, rule, row):
    """Yields (what, damage) for values that a column must not have."""
    def written(row, value):
        data = values.copy()
        data[row] = value
        return lambda file: file[path].__setitem__(..., data)

    if values.dtype == np.int8:
        yield "a flag that is none", written(row, 100)
        yield "a negative flag that is none", written(row, -100)
        return
    if rule == "any":
        return
    for value in (np.nan, np.inf, -np.inf):
        yield f"{value}", written(row, value)
    if rule == "rising":
        yield "falling", written(-1, values[0] - 1.0)
    if rule == "index":
        yield "between two", written(row, values[row] + 0.5)
        yield "beyond all", written(row, 1e300)
        yield "negative", written(row, -3.0)


def attribute_damages(name, value):
    """Yields (what, damage) for an attribute of the file."""
    def written(new):
        def damage(file):
            del file.attrs[name]
            file.attrs[name] = new
        return damage

    yield "missing", lambda file: file.attrs.__delitem__(name)
    yield "a pair", written(np.array([1.0, 2.0]))
    yield "a long list", written(np.zeros(6000, "i8"))
    yield "of pairs", written(np.zeros((), [("a", "f8"), ("b", "f8")]))
    if isinstance(value, str):
        yield "a number", written(3.0)
        yield "texts", written(np.array(["a", "b"], dtype=TEXT))
        yield "padded", written(np.bytes_("run"))
        yield "no text", written("")
    else:
        yield "a text", written("3")
        yield "a fraction", written(2.0)
        yield "32 bits", written(np.int32(2))
        yield "negative", written(np.int64(-5))
        yield "huge", written(np.int64(2**62))
        yield "as large as can be", written(np.int64(2**63 - 1))
    if name in ("scenario", "study"):
        yield "no TOML", written("x = [")
        yield "nested deeply", written("x = " + "[" * 60000)
        yield "nested deeply in keys", written("x" + ".x" * 15000 + " = 1")
        yield "nested deeply in tables", written("x = " + "{x = " * 10000)


def rule(kind, path):
    """What the numbers of a column have to be, as output/schema.md states it."""
    table, name = path.rsplit("/", 1)
    if table in ("trajectory", "controller", "statics") and name in ("time", "load_torque") and kind != "diagnosis":
        return "rising" if (table, name) != ("trajectory", "load_torque") else "finite"
    if table == "trials":
        return "index" if name in ("index", "reason") else "finite" if "." in name else "any"
    if table == "referee":
        return "index" if name == "trial" else "any"
    if table == "efficiency":
        return "finite" if name in ("worm_speed", "load_torque") else "any"
    return "any" if kind == "diagnosis" or table.startswith("summary/") else "finite"


def empty(file, table):
    """Takes all rows from a table."""
    for name, column in list(file[table].items()):
        replaced(f"{table}/{name}", lambda file: file.create_dataset(f"{table}/{name}", data=column[:0]))(file)


def columns(file):
    """Returns the path and the values of every column."""
    found = []
    file.visit(found.append)
    return [(path, file[path][:]) for path in found if isinstance(file[path], h5py.Dataset) and file[path].dtype.kind in "fiS"]


class Case:
    """A result, and the commands that read it; the word DAMAGED stands for its damaged copy."""

    def __init__(self, name, *commands):
        self.name, self.commands = name, commands

    def damages(self):
        """Yields (what, damage) for everything in it."""
        with h5py.File(self.name) as file:
            kind, found = file.attrs["kind"], columns(file)
            of_sweeps = ("study", "build", "first_trial", "end_trial", "command_line")
            attributes = [(n, file.attrs[n]) for n in ("kind", "title", "scenario", *(of_sweeps if kind == "sweep" else ()))]
        for path, values in found:
            row = 0 if path.startswith("referee/") else values.size // 2  # of the referee only what is used counts
            for what, damage in (text_damages(path, values) if values.dtype.kind == "S" else
                                 (*dataset_damages(path, values), *range_damages(path, values, rule(kind, path), row))):
                yield f"{path} {what}", damage
        for name, value in attributes:
            for what, damage in attribute_damages(name, value):
                if name not in ("title", "command_line") or what != "no text":  # these may be empty
                    yield f"attribute {name} {what}", damage
        for table in sorted({path.rpartition("/")[0] for path, _ in found} - {"", "records", "controller"}):
            yield f"{table} missing", lambda file, table=table: file.__delitem__(table)
            yield f"{table} with a group", lambda file, table=table: file[table].create_group("more")
            yield f"{table} in a circle", lambda file, table=table: file[table].__setitem__("more", file[table])
            if table in ("trajectory", "efficiency", "statics"):
                yield f"{table} {WITHOUT_ROWS}", lambda file, table=table: empty(file, table)


def faults():
    """Yields what went wrong."""
    make("run", str(SCENARIOS / "fig09_switching.toml"), "-q", "--set", "run.report_interval_s=0.01", "-o", "run.h5")
    make("run", str(SCENARIOS / "fig10_sliding_014rad_bare.toml"), "-q", "--set", "run.duration_s=0.1", "--set",
         "metrics.from_s=0", "-o", "controlled.h5")
    make("run", str(SCENARIOS / "fig09_backlash.toml"), "-q", "--set", "run.duration_s=0.1", "-o", "elastic.h5")
    make("statics", str(SCENARIOS / "fig07_break_in_07cm_forward.toml"), "-q", "-o", "statics.h5")
    make("efficiency", str(SCENARIOS / "measured_worm_drive.toml"), "-q", "--points", "4", "-o", "efficiency.h5")
    Path("study.toml").write_text(STUDY.format(scenario=SCENARIOS / "fig10_sliding_014rad_bare.toml"), encoding="utf-8")
    make("sweep", "study.toml", "-q", "-o", "sweep.h5")
    cases = [Case(name, ("diff", name, "DAMAGED"), ("report", "DAMAGED", "-o", "x.html"))
             for name in ("run.h5", "controlled.h5", "elastic.h5", "statics.h5", "efficiency.h5")]
    cases.append(Case("sweep.h5", ("summary", "DAMAGED"), ("merge", "DAMAGED", "-o", "x.h5"),
                      ("report", "DAMAGED", "-o", "x.html")))
    for case in cases:
        for number, (what, damage) in enumerate(case.damages()):
            # columns have 30 kinds of damage or so, which 47 does not divide
            if number % STRIDE and not what.endswith(WITHOUT_ROWS):
                continue
            shutil.copy(case.name, "good.h5")
            shutil.copy(case.name, "damaged.h5")
            with h5py.File("damaged.h5", "r+") as file:
                damage(file)
            # one command sees each damage, each of them every kind of damage
            command = case.commands[-1 if "scenario" in what else number // STRIDE % len(case.commands)]
            done = run(*(word if word != "DAMAGED" else "damaged.h5" for word in command))
            lines = done.stderr.splitlines()  # a scenario may have several faults
            one_line = lines and all(line.startswith("damaged.h5") and ": error: " in line for line in lines)
            if done.returncode != 2 or not one_line or any(map(os.path.exists, ("x.html", "x.h5", "x.h5.part"))):
                yield f"{case.name}, {what}: {command[0]} ends with {done.returncode}: {(done.stderr or done.stdout)[:300]!r}"
            for left in ("x.html", "x.h5", "x.h5.part"):
                Path(left).unlink(missing_ok=True)
            if number % (PICTURES * STRIDE) == 0:
                code, stderr = draw("damaged.h5", "-o", "x.png")
                if code not in (0, 2) or "Traceback" in stderr or stderr.count("\n") > 1:
                    yield f"{case.name}, {what}: the picture ends with {code}: {stderr[-300:]!r}"


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    count = 0
    for fault in faults():
        print(fault, flush=True)
        count += 1
    sys.exit(count > 0)
