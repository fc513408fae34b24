#!/usr/bin/python3
"""Recordings as MAT-files and HDF5 give the answer that they give as CSV: recording_files.py PROGRAM SCENARIOS

Files of version 5 are put together here byte by byte, those of 7.3 and HDF5 by h5py: no code of the program's, nor of
matio. Hostile ones are refused in one line, with exit code 2, within little memory.
"""

import json
import os
import re
import resource
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import h5py
import numpy as np

PROGRAM, SCENARIOS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
CHECKED = b"san.so" in PROGRAM.read_bytes()  # a memory checker reserves terabytes of address space
CLASSES = {"float64": (6, 9), "float32": (7, 7), "int16": (10, 3), "uint8": (9, 2)}  # of an array, of its values


def element(kind, data, order="<"):
    return struct.pack(order + "II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def matrix(name, values, order="<", *, complex_part=False, dims=None):
    """An array of numbers, characters or a struct (a dict) of version 5."""
    if isinstance(values, dict):
        names = b"".join(key.encode().ljust(32, b"\0") for key in values)
        body = (element(6, struct.pack(order + "II", 2, 0), order) + element(5, struct.pack(order + "ii", 1, 1), order)
                + element(1, name.encode(), order) + struct.pack(order + "HHi", *((5, 4) if order == "<" else (4, 5)), 32)
                + element(1, names, order) + b"".join(matrix("", part, order) for part in values.values()))
        return element(14, body, order)
    if isinstance(values, str):
        kind, type_of, array = 4, 4, np.frombuffer(values.encode("utf-16-le"), "<u2").reshape(1, -1)
    else:
        array = np.asarray(values)
        array = array.reshape(-1, 1) if array.ndim == 1 else array
        kind, type_of = CLASSES[array.dtype.name]
    flags = kind | (0x800 if complex_part else 0)
    data = array.astype(array.dtype.newbyteorder(order)).tobytes("F")
    body = (element(6, struct.pack(order + "II", flags, 0), order)
            + element(5, struct.pack(order + f"{array.ndim}i", *(dims or array.shape)), order)
            + element(1, name.encode(), order) + element(type_of, data, order))
    return element(14, body + (element(type_of, data, order) if complex_part else b""), order)


def write_mat(path, variables, order="<", packed=False):
    head = b"MATLAB 5.0 MAT-file, by hand".ljust(124) + struct.pack(order + "H", 0x0100) + (b"IM" if order == "<" else b"MI")
    parts = [value if isinstance(value, bytes) else matrix(name, value, order) for name, value in variables.items()]
    Path(path).write_bytes(head + b"".join(struct.pack("<II", 15, len(zlib.compress(p))) + zlib.compress(p) if packed else p
                                           for p in parts))


def write_h5(path, columns, units={}, attribute="UNIT", **storage):
    with h5py.File(path, "w") as file:
        for name, values in columns.items():
            column = file.create_dataset(name, data=values, **storage)
            if name in units:
                column.attrs[attribute] = units[name]
                column.attrs["COMMENT"] = "as wired"


def write_mat73(path, columns):
    """As MATLAB does: HDF5 behind a block of 512 bytes, columns lying on their side, compressed."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in columns.items():
            data = file.create_dataset(name, data=np.asarray(values).reshape(1, -1), compression="gzip", chunks=True)
            data.attrs["MATLAB_class"] = np.bytes_("double")
        file["note"] = np.frombuffer("on the bench".encode("utf-16-le"), "<u2").reshape(-1, 1)
        file["note"].attrs["MATLAB_class"] = np.bytes_("char")
    with open(path, "r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, by hand".ljust(124) + struct.pack("<H", 0x0200) + b"IM")


def limit():
    if not CHECKED:
        resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))


def wormdrive(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, preexec_fn=limit, timeout=60)


def refusal(file, scenario="bench.toml"):
    done = wormdrive("diagnose", scenario, file, "-o", "out")
    assert done.returncode == 2 and done.stderr.count("\n") == 1, (file, done)
    assert not Path("out").exists(), file
    return done.stderr.rstrip().replace(f"{file}: error: ", "", 1)


def same_answers(columns, ask, units):
    """Writes columns in every way and returns what the program says of each; `units` are those of the plain names."""
    answers = {}

    def answer(name):
        answers[name] = ask(name)

    np.savetxt("r.csv", np.column_stack(list(columns.values())), "%.17g", ",", header=",".join(columns), comments="")
    answer("r.csv")
    for name, options in {"r.mat": {}, "big.mat": {"order": ">"}, "packed.mat": {"packed": True}}.items():
        write_mat(name, columns, **options)
        answer(name)
    plain = {name.removesuffix(suffix): (name, words) for name, (suffix, words) in units.items()}
    named = {short: columns[name] for short, (name, _) in plain.items()}
    words = {short: unit for short, (_, unit) in plain.items()}
    write_mat("struct.mat", {"log": {**columns}, "note": "on the bench"})
    answer("struct.mat")
    write_mat("units.mat", {"d": named, "units": {"d": words}})
    answer("units.mat")
    write_mat73("r73.mat", columns)
    answer("r73.mat")
    write_h5("r.h5", columns)
    answer("r.h5")
    write_h5("gzip.h5", columns, compression="gzip", shuffle=True, fletcher32=True)
    answer("gzip.h5")
    write_h5("sdf.h5", named, words)
    answer("sdf.h5")
    write_h5("cf.h5", named, {key: np.bytes_(value) for key, value in words.items()}, "units")
    answer("cf.h5")
    write_h5("group.h5", {f"log/{name}": values for name, values in columns.items()})
    answer("group.h5")
    return answers


def check_kinds():
    table = np.genfromtxt(SCENARIOS / "example_bench.csv", delimiter=",", names=True)
    columns = {name: table[name] for name in ("time_s", "motor_torque_Nm", "gear_angle_rad")}
    units = {"time_s": ("_s", "s"), "motor_torque_Nm": ("_Nm", "N.m"), "gear_angle_rad": ("_rad", "rad")}
    # the load that a scenario without one lacks is worked out from every sample of every column
    told = same_answers(columns, lambda file: refusal(file, "no_load.toml").replace("torque_Nm", "torque"), units)
    assert "kg" in told["r.csv"] or "N m" in told["r.csv"], told["r.csv"]
    assert set(told.values()) == {told["r.csv"]}, told

    # other units: milliseconds, millinewton metres and degrees
    write_h5("milli.h5", {"time": 1e3 * table["time_s"], "motor_torque": 1e3 * table["motor_torque_Nm"],
                          "gear_angle": np.degrees(table["gear_angle_rad"])},
             {"time": "ms", "motor_torque": "mN m", "gear_angle": "deg"})
    assert refusal("milli.h5", "no_load.toml") == told["r.csv"]

    speeds = np.repeat([2.0, 4.0, 8.0, 16.0, -3.0, -6.0, -12.0, -24.0], 5)
    torques = np.sign(speeds) * (4e-3 + 1e-4 * np.abs(speeds)) + 1e-5 * (np.arange(40) % 5)
    records = {"record": np.repeat(np.arange(8.0), 5), "worm_speed_rad_per_s": speeds, "motor_torque_Nm": torques}

    def steady(file):
        done = wormdrive("steady", SCENARIOS / "measured_worm_drive.toml", "--data", file, "--json", "-o", "s.h5", "--force")
        assert done.returncode == 0, (file, done)
        found = json.loads(done.stdout)
        assert len(found["records"]) == 8, found
        return json.dumps([found["records"], found["rms_error_Nm"]])

    told = same_answers(records, steady, {"record": ("", "1"), "worm_speed_rad_per_s": ("_rad_per_s", "rad/s"),
                                          "motor_torque_Nm": ("_Nm", "N*m")})
    assert set(told.values()) == {told["r.csv"]}, told
    return columns


def check_run():
    """A run, its export and its controller's samples as CSV are one recording."""
    assert wormdrive("run", SCENARIOS / "excitation_rich.toml", "-q", "-o", "run.h5").returncode == 0
    for kind in ("--mat", "--csv"):
        assert wormdrive("export", "run.h5", kind).returncode == 0
    told = [refusal(file, "no_load.toml") for file in ("run.h5", "run.mat")]
    renamed = Path("no_load.toml").read_text(encoding="utf-8")
    Path("named.toml").write_text(
        renamed + '[data]\nmotor_torque_Nm = "torque_Nm"\ngear_angle_rad = "measured_angle_rad"\n', encoding="utf-8")
    told.append(refusal("run_controller.csv", "named.toml"))
    told = [text.replace("/controller/torque", "T").replace("controller.torque", "T").replace("torque_Nm", "T") for text in told]
    assert "state the [load]" in told[0] and set(told) == {told[0]}, told
    with h5py.File("run.h5") as file:
        for name, column in file["trajectory"].items():
            assert column.attrs["COMMENT"] == column.attrs["long_name"], name
            assert column.attrs.get("UNIT") == column.attrs.get("units"), name


def check_hostile(good):
    """(file's name, what it is, what is said of it)"""
    t, u, y = good.values()
    names = list(good)
    mats = {
        "complex": ({names[0]: t, names[1]: matrix(names[1], u, complex_part=True), names[2]: y},
                    "motor_torque_Nm is complex; a column is real"),
        "text": ({names[0]: t, names[1]: "off", names[2]: y}, "motor_torque_Nm is a text; a column holds numbers"),
        "empty": ({names[0]: t, names[1]: np.zeros((0, 0)), names[2]: y}, "motor_torque_Nm is empty"),
        "matrix": ({names[0]: t, names[1]: np.ones((3, 4)), names[2]: y},
                   "motor_torque_Nm has 3 x 4 values; a column has one dimension"),
        "short": ({names[0]: t, names[1]: u[:-1], names[2]: y},
                  f"motor_torque_Nm has {len(t) - 1} rows, but time_s has {len(t)}"),
        "huge": ({names[0]: t, names[1]: matrix(names[1], u, dims=(2**31 - 1, 1)), names[2]: y},
                 r"motor_torque_Nm states more values than a file of \d+ bytes can hold"),
        "huge product": ({names[0]: t, names[1]: matrix(names[1], u, dims=(2**31 - 1, 2**31 - 1)), names[2]: y},
                         r"motor_torque_Nm states more values than a file of \d+ bytes can hold"),
        "more than there": ({names[0]: t, names[1]: matrix(names[1], u, dims=(len(u) + 100, 1)), names[2]: y}, ".*"),
        "not finite": ({names[0]: t, names[1]: np.where(np.arange(len(u)) == 16, np.nan, u), names[2]: y},
                       "row 17: motor_torque_Nm = nan is not a finite number"),
        "two": ({"a": good, "b": good}, r"has two columns 'time_s', a.time_s and b.time_s; \[data\] in the scenario tells which it is"),
        "other names": ({"t": t, "theta": y}, r"the columns t, theta make neither .*"),
        "nothing": ({}, "the columns  make neither .*"),
    }
    for name, (variables, says) in mats.items():
        write_mat("hostile.mat", variables)
        told = refusal("hostile.mat")
        assert re.fullmatch(says, told), (name, told)
    write_mat("whole.mat", good)
    whole = Path("whole.mat").read_bytes()
    for size in (4, 127, 130, 500, len(whole) // 2, len(whole) - 8):
        Path("hostile.mat").write_bytes(whole[:size])
        told = refusal("hostile.mat")
        assert re.search("damaged or ends early|no MAT-file|cannot be opened|make neither", told), (size, told)
    rng = np.random.default_rng(7)
    write_mat("packed.mat", {name: values[:1500] for name, values in good.items()}, packed=True)
    write_mat("units.mat", {"d": {"time": t, "motor_torque": u, "gear_angle": y},
                            "units": {"d": {"time": "s", "motor_torque": "N m", "gear_angle": "rad"}}})
    write_mat73("r73.mat", good)
    write_h5("r.h5", good)
    for file in ("packed.mat", "units.mat", "r73.mat"):  # whatever bytes are changed, it ends in one line or with a recording
        data = np.frombuffer(Path(file).read_bytes(), np.uint8)
        for _ in range(12):
            spoilt = data.copy()
            places = rng.integers(128, min(len(data), 6000), 3)
            spoilt[places] = rng.integers(0, 256, 3)
            Path("hostile.mat").write_bytes(spoilt.tobytes())
            done = wormdrive("diagnose", "no_load.toml", "hostile.mat", "-o", "out")
            assert done.returncode == 2 and done.stderr.count("\n") == 1, (file, places, done)

    h5s = {
        "complex": (u + 0j, {}, "motor_torque_Nm is complex or has several values in a row"),
        "texts": (np.array([b"a"] * len(u)), {}, "motor_torque_Nm holds no numbers"),
        "empty": (np.zeros(0), {}, "motor_torque_Nm is empty"),
        "scalar": (1.0, {}, "motor_torque_Nm is a single value, not a column"),
        "matrix": (np.ones((3, 4)), {}, "motor_torque_Nm has 3 x 4 values; a column has one dimension"),
        "short": (u[:-1], {}, f"motor_torque_Nm has {len(u) - 1} rows, but time_s has {len(u)}"),
        "lzf": (u, {"compression": "lzf"}, "motor_torque_Nm is compressed in another way than gzip"),
    }
    for name, (values, storage, says) in h5s.items():
        with h5py.File("hostile.h5", "w") as file:
            file["time_s"], file["gear_angle_rad"] = t, y
            file.create_dataset("motor_torque_Nm", data=values, **storage)
        told = refusal("hostile.h5")
        assert re.fullmatch(says, told), (name, told)
    with h5py.File("hostile.h5", "w") as file:
        file["time_s"], file["gear_angle_rad"] = t, y
        file.create_dataset("motor_torque_Nm", shape=(2**40,), chunks=(4096,), dtype="f8", compression="gzip")
    assert refusal("hostile.h5") == f"motor_torque_Nm states {2**40} rows, but the file contains only 0 bytes of it"
    units = {"gear_angle_rad": ("deg", "gear_angle_rad is in 'deg', unlike its name"),
             "motor_torque_Nm": ("A", "motor_torque_Nm is in 'A', which is no unit of a quantity in N m")}
    for name, (unit, says) in units.items():
        write_h5("hostile.h5", good, {name: unit})
        assert refusal("hostile.h5") == says
    whole = Path("r.h5").read_bytes()
    for size in (8, 100, 3000, len(whole) - 8):
        Path("hostile.h5").write_bytes(whole[:size])
        refusal("hostile.h5")
    # a name in [data], and what a column without a unit is asked for
    write_h5("plain.h5", {"time": t, "motor_torque": u, "gear_angle": y}, {"time": "s"})
    assert refusal("plain.h5") == (
        "no column 'motor_torque_Nm'; the file has gear_angle, motor_torque, time [s] (as wired); [data] motor_torque_Nm = "
        '"motor_torque" in the scenario would say which it is')


def main():
    text = (SCENARIOS / "example_bench.toml").read_text(encoding="utf-8").split("[[motor.torque]]")[0]
    bench = text + '[motor.torque]\nkind = "constant"\ntorque_Nm = 0\n[run]\nduration_s = 1\n'
    Path("bench.toml").write_text(bench, encoding="utf-8")
    Path("no_load.toml").write_text(re.sub(r"\[load\].*?(?=\[motor)", "", bench, flags=re.S), encoding="utf-8")
    check_hostile(check_kinds())
    check_run()
    print("recording files: CSV, MAT 5, MAT 7.3 and HDF5 give the same answers; hostile ones are refused")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
