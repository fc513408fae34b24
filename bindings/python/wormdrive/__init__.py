"""Worm-gear drives, simulated exactly: self-locking, stick, break-in and flank changes as events.

    import wormdrive
    result = wormdrive.run("scenarios/fig09_switching.toml", mesh={"friction": 0.2})
    result.trajectory["gear_speed"]        # a NumPy array, in SI
    result.events["time"]

A scenario is a path (.toml, or a result .h5), TOML text (with a line break in it) or a dict of tables. Overrides are
tables as keywords, mesh={"friction": 0.2}, or keys with dots, **{"mesh.friction": 0.2}. Faults come as exceptions with
the words of the command line: InputError (a ValueError), SimulationHalted (a RuntimeError), OutputError (an OSError).
"""

from __future__ import annotations

import json
import numbers
import os
import sys
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any, Optional, Union

try:
    import wormdrive._core as _core
except ImportError as error:
    python = f"python{sys.version_info.major}.{sys.version_info.minor}"
    raise ImportError(f"{os.path.dirname(__file__)} has no module that {python} can load ({error}); build it with that "
                      "Python: cmake --build --preset release --target wormdrive_python") from None
from ._core import InputError, OutputError, SimulationHalted

__all__ = ["run", "steady", "check", "sweep", "summary", "diagnose", "Scenario", "Result", "Sweep", "Diagnosis", "Table",
           "Drive", "Drives", "State", "InputError", "OutputError", "SimulationHalted"]
__version__ = _core.version().split()[1]

Source = Union[str, "os.PathLike[str]", Mapping[str, Any], "Scenario"]


class Table(Mapping[str, Any]):
    """Columns of one length by name, as NumPy arrays in SI: `table["time"]` or `table.time`.

    `units` and `long_names` describe them as in a result file; `flag_meanings` tells the word of each value of the flags
    (`kind`, `motion`, `flank`), and `words("kind")` is the column in words. The arrays are read-only, for all who hold
    the table look at the same ones: `table["time"].copy()` is one's own.
    """

    def __init__(self, columns: list[_core.Column]):
        self._arrays: dict[str, Any] = {name: array for name, _, _, _, _, array in columns}
        self.units = {name: unit for name, unit, _, _, _, _ in columns}
        self.long_names = {name: long_name for name, _, long_name, _, _, _ in columns}
        self.flag_meanings = {name: dict(zip(values, words.split())) for name, _, _, words, values, _ in columns if words}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for array in self._arrays.values():
            array.flags.writeable = False

    def words(self, name: str) -> list[str]:
        """A column of flags in words: "break_away", "forward", ..."""
        return [self.flag_meanings[name][int(value)] for value in self[name]]

    def __getitem__(self, name: str) -> Any:
        return self._arrays[name]

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._arrays:
            raise AttributeError(f"no column '{name}'; the columns are {', '.join(self.__dict__.get('_arrays', ()))}")
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        """Number of columns."""
        return len(self._arrays)

    def __repr__(self) -> str:
        rows = len(next(iter(self._arrays.values())))
        columns = (f"{name} [{unit}]" if unit not in ("", "1") else name for name, unit in self.units.items())
        return f"<wormdrive.Table of {rows} rows: {', '.join(columns)}>"

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._arrays]

    def to_xarray(self) -> Any:
        """The table as an xarray.Dataset over its first column, units as attributes; needs xarray."""
        import xarray

        def attributes(name: str) -> dict[str, Any]:
            flags = self.flag_meanings.get(name, {})
            described = {"units": self.units[name], "long_name": self.long_names[name],
                         "flag_values": list(flags), "flag_meanings": " ".join(flags.values())}
            return {key: value for key, value in described.items() if value}

        over = next(iter(self))
        data = {name: (over, array, attributes(name)) for name, array in self.items()}
        return xarray.Dataset({name: column for name, column in data.items() if name != over}, coords={over: data[over]})


class _KeptRun:
    """What a pickled run says of itself beside its tables."""

    def __init__(self, run: Union[_core.Run, _KeptRun]):
        self.title, self.toml, self.halted = run.title, run.toml, run.halted
        self._metrics, self._statistics = run.metrics(), run.statistics()

    def metrics(self) -> dict[str, float]:
        return self._metrics

    def statistics(self) -> dict[str, int]:
        return self._statistics

    def write(self, path: str, command_line: str, force: bool) -> None:
        """Runs again, to the same bits."""
        _core.Scenario.parse(self.toml, "scenario", [], False).run().write(path, command_line, force)


class Result:
    """A run: `trajectory` (one row per time), `events` (one per change of mode), `controller` (one per sample, or None).

    `metrics` of a controlled run and `statistics` of the solver are dicts by the names of output/schema.md; `toml` is
    the resolved scenario. The tables are made when they are first asked for. It can be pickled, with all its tables.
    """

    def __init__(self, run: _core.Run):
        self._run: Union[_core.Run, _KeptRun] = run
        self._tables: dict[str, Table] = {}

    def __getstate__(self) -> dict[str, Any]:
        if isinstance(self._run, _core.Run):
            for name in self._run.tables():
                self._table(name)
        return {"_tables": self._tables, "_run": _KeptRun(self._run)}

    def _table(self, name: str) -> Optional[Table]:
        if name not in self._tables and isinstance(self._run, _core.Run) and name in self._run.tables():
            self._tables[name] = Table(self._run.table(name))
        return self._tables.get(name)

    @property
    def trajectory(self) -> Table:
        return self._table("trajectory")  # type: ignore[return-value]

    @property
    def events(self) -> Table:
        return self._table("events")  # type: ignore[return-value]

    @property
    def controller(self) -> Optional[Table]:
        return self._table("controller")

    @property
    def metrics(self) -> dict[str, float]:
        return self._run.metrics()

    @property
    def statistics(self) -> dict[str, int]:
        return self._run.statistics()

    @property
    def title(self) -> str:
        return self._run.title

    @property
    def toml(self) -> str:
        return self._run.toml

    def to_xarray(self) -> Any:
        """The trajectory as an xarray.Dataset; `events.to_xarray()` gives the events."""
        dataset = self.trajectory.to_xarray()
        dataset.attrs.update(title=self.title, scenario=self.toml)
        return dataset

    def write(self, path: Union[str, "os.PathLike[str]"], *, force: bool = False) -> None:
        """Writes the HDF5 file that `wormdrive run` writes; raises OutputError, also where something else than an older run
        is in the way, unless it is forced."""
        self._run.write(os.fspath(path), _command_line(), force)

    def __repr__(self) -> str:
        return f"<wormdrive.Result '{self.title}': {len(self.trajectory.time)} rows, {len(self.events.time)} events>"


class Sweep:
    """The trials of a study: `trials` has one row per trial, by the names of output/schema.md; `trials.reason` k > 0 stands
    for `reasons[k - 1]`."""

    def __init__(self, sweep: _core.Sweep):
        self._sweep = sweep
        self.title = sweep.title
        self.trials = Table(sweep.trials())
        self.reasons = sweep.reasons()

    def __reduce__(self) -> tuple[type[Sweep], tuple[_core.Sweep]]:
        return Sweep, (self._sweep,)

    def to_xarray(self) -> Any:
        """The trials as an xarray.Dataset over their index."""
        return self.trials.to_xarray()

    def write(self, path: Union[str, "os.PathLike[str]"], *, referee: int = 8, force: bool = False) -> None:
        """Writes the HDF5 file that `wormdrive sweep` writes; raises OutputError, also where something is in the way, unless
        it is forced. referee: so many trials are made again by CVODE, and how far it is from them stands in the file."""
        self._sweep.write(os.fspath(path), _command_line(), referee, force)

    def summary(self, *, metric: str = "", worst: int = 5, done_only: bool = False) -> dict[str, Any]:
        """What the trials come to, as summary() tells it of a file."""
        with tempfile.TemporaryDirectory() as scratch:
            path = os.path.join(scratch, "sweep.h5")
            self.write(path, referee=0)
            return summary(path, metric=metric, worst=worst, done_only=done_only)

    def __repr__(self) -> str:
        return f"<wormdrive.Sweep '{self.title}': {len(self.trials.index)} trials>"


class Diagnosis:
    """What a scenario lacks to explain data: `verdict`, `sentence`, `findings` (all of docs/diagnosis_json.md).

    `extended` is the scenario with the causes as TOML text; `experiment`, if a class of causes remains, one that would
    split it. `residual` is the torque that the model lacks, sample by sample, before and after.
    """

    def __init__(self, found: dict[str, Any]):
        self.findings: dict[str, Any] = json.loads(found["findings"])
        self.verdict: str = self.findings["verdict"]
        self.sentence: str = self.findings["sentence"]
        self.extended: str = found["extended"]
        self.experiment: Optional[str] = found["experiment"]
        self.residual = Table(found["residual"])

    def to_xarray(self) -> Any:
        """The residual torque as an xarray.Dataset over time."""
        return self.residual.to_xarray()

    def __repr__(self) -> str:
        return f"<wormdrive.Diagnosis {self.verdict}: {self.sentence}>"


class Scenario:
    """A scenario that is read and checked, ready to run as often as wanted. Raises InputError with all faults at once."""

    _scenario: _core.Scenario

    def __init__(self, source: Source, /, *, _look: bool = False, **overrides: Any):
        assignments = list(_assignments(overrides))
        if isinstance(source, Scenario):
            self._scenario = _core.Scenario.parse(source.toml, "scenario", assignments, _look) if assignments else source._scenario
        elif (stated := _text_of(source)) is not None:
            self._scenario = _core.Scenario.parse(*stated, assignments, _look)
        else:
            self._scenario = _core.Scenario.load(os.fspath(source), assignments, _look)  # type: ignore[arg-type]

    @property
    def title(self) -> str:
        return self._scenario.title

    @property
    def toml(self) -> str:
        """The resolved scenario: every value that holds, defaults included."""
        return self._scenario.toml

    def run(self) -> Result:
        """Simulates; other threads run meanwhile, and Ctrl-C ends it. Raises SimulationHalted, whose `result` is the
        run up to there."""
        core = self._scenario.run()
        result = Result(core)
        if core.halted is not None:
            halt = SimulationHalted(core.halted)
            halt.result = result  # type: ignore[attr-defined]
            raise halt
        return result

    def __repr__(self) -> str:
        return f"<wormdrive.Scenario '{self.title}'>"


def run(scenario: Source, /, **overrides: Any) -> Result:
    """Simulates a scenario: Scenario(scenario, **overrides).run()."""
    return Scenario(scenario, **overrides).run()


def steady(scenario: Source, worm_speed: Any, /, **overrides: Any) -> Any:
    """Motor torque [N m] that keeps the drive at worm speeds [rad/s], other than 0: an array of their shape. At rest
    friction holds a range of torques: 0 raises InputError, which tells it."""
    return Scenario(scenario, _look=True, **overrides)._scenario.steady(worm_speed)


def check(scenario: Source, /, **overrides: Any) -> dict[str, Any]:
    """What `wormdrive check --json` tells: title, parameters and what follows from them (value, unit, meaning),
    warnings, the resolved scenario."""
    core = Scenario(scenario, _look=True, **overrides)._scenario
    return {"title": core.title, "parameters": core.parameters(), "derived": core.derived(),
            "warnings": core.warnings(), "scenario": core.toml}


def sweep(study: Union[str, "os.PathLike[str]", Mapping[str, Any]], /, *, threads: int = 0) -> Sweep:
    """Makes the trials of a study: a path (.toml), TOML text or a dict; of the latter two the scenario is looked for in the
    working directory. threads=0: as many as the machine has; the rows do not depend on it. All rows stay in memory: what must
    survive an interruption is for `wormdrive sweep`, which --resume takes up again."""
    if (stated := _text_of(study)) is not None:
        return Sweep(_core.sweep_text(*stated, threads))
    return Sweep(_core.sweep_file(os.fspath(study), threads))  # type: ignore[arg-type]


def summary(path: Union[str, "os.PathLike[str]"], /, *, metric: str = "", worst: int = 5,
            done_only: bool = False) -> dict[str, Any]:
    """What `wormdrive summary --json` tells of the file of a sweep: how its metrics are distributed, how often thresholds are
    missed, which parameters matter, the worst trials. Of a sweep that is still running or was interrupted it tells the
    trials that there are: `trials` of `of`, and whether it is `running`. metric: by which trials are ranked. A value that is
    not finite is None."""
    return json.loads(_core.summary(os.fspath(path), metric, worst, done_only))  # type: ignore[no-any-return]


def diagnose(scenario: Source, data: Any, /, *, since: Any = None, seed: int = 1, draws: int = 0, threads: int = 0,
             output: Optional[Union[str, "os.PathLike[str]"]] = None, **overrides: Any) -> Diagnosis:
    """What a scenario lacks to explain data: a CSV file or a result of a run, a list of these, or a dict of columns with the
    names of a CSV file, {"time_s": array, ...}. since: data of the same drive from before, likewise; then what has changed.
    draws: how often the recording is fitted anew, with its blocks weighted at random, for draws.csv of output.
    output: a folder for the files of `wormdrive diagnose`, pictures apart; `wormdrive report` makes a page of it."""
    core = Scenario(scenario, _look=True, **overrides)._scenario
    folder = None if output is None else os.fspath(output)
    scenario_file = "" if isinstance(scenario, Scenario) or _text_of(scenario) is not None else os.fspath(scenario)  # type: ignore[arg-type]

    with tempfile.TemporaryDirectory() as scratch:
        return Diagnosis(_core.diagnose(core, _files_of(data, scratch, "data.csv"),
                                        [] if since is None else _files_of(since, scratch, "since.csv"), seed, draws, threads,
                                        folder, scenario_file, _command_line()))


def _files_of(data: Any, scratch: str, name: str) -> list[str]:
    """Paths of data; columns are written to a file of this name."""
    if isinstance(data, Mapping):
        rows = {column: len(values) for column, values in data.items()}
        if len(set(rows.values())) > 1:
            raise InputError("data: error: its columns differ in length: "
                             + ", ".join(f"'{column}' has {count} values" for column, count in rows.items()))
        for column, values in data.items():
            if getattr(getattr(values, "dtype", None), "kind", "") == "c":
                raise InputError(f"data: error: '{column}' holds complex numbers")
        path = os.path.join(scratch, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(",".join(data) + "\n")
            file.writelines(",".join(map(repr, map(float, row))) + "\n" for row in zip(*data.values()))
        return [path]
    files = [os.fspath(file) for file in ([data] if isinstance(data, (str, os.PathLike)) else data)]
    if not files:
        raise InputError("data: error: no file is given")
    return files


def _command_line() -> str:
    return f"python {sys.argv[0] if sys.argv else ''}".strip()


def _text_of(source: Any) -> Optional[tuple[str, str]]:
    """The TOML text of a dict or a text, and its name in messages; None of what must be a path."""
    if isinstance(source, Mapping):
        return _document(source), "dict"
    return (source, "text") if isinstance(source, str) and "\n" in source else None


def _document(tables: Mapping[str, Any]) -> str:
    return "".join(f"{_key(key)} = {_toml(value)}\n" for key, value in tables.items())


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else json.dumps(key, ensure_ascii=False)


def _toml(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {_toml(v)}" for k, v in value.items()) + "}"
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()  # of NumPy: np.bool_, np.float32, an array without axes
    if isinstance(value, (bool, str)):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if hasattr(value, "__iter__"):
        return "[" + ", ".join(_toml(v) for v in value) + "]"
    raise TypeError(f"{value!r} is neither a number, a text, True or False, a table nor a list of them")


def _assignments(tables: Mapping[str, Any], path: str = "") -> Iterator[str]:
    for key, value in tables.items():
        if isinstance(value, Mapping):
            yield from _assignments(value, f"{path}{key}.")
        else:
            yield f"{path}{key}={_toml(value)}"


from .stepping import Drive, Drives, State  # noqa: E402  (they take scenarios as this module reads them)
