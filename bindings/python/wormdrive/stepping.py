"""Drives inside a loop of one's own: a notebook, a robot simulator, reinforcement learning (docs/howto/stepping.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple, Optional

import numpy as np
import numpy.typing as npt

from . import InputError, Scenario, Source, _core


class State(NamedTuple):
    """What a drive shows at one time, in SI; the columns of a run's trajectory, and the worm."""

    time: float  #: [s]
    gear_angle: float  #: [rad]
    gear_speed: float  #: [rad/s]
    gear_acceleration: float  #: [rad/s^2]
    motor_torque: float  #: that the worm sees, behind limit, delay and lag [N m]
    load_torque: float  #: on the gear [N m]
    normal_force: float  #: between the teeth [N]
    motion: int  #: -1 backward, 0 stuck, 1 forward
    flank: int  #: that carries the load: -1 right, 0 none, 1 left
    worm_angle: float  #: [rad]
    worm_speed: float  #: [rad/s]


class Drive:
    """A drive that is stepped: drive.step(torque, dt) goes on by dt [s] under a motor torque [N m], exact through all events.

    The steps have the bits of a run whose motor torque is a table of the same steps. The scenario's own motor torque and
    controller are not used: `set_aside` says what else is not. Before the first step the torque is 0. A drive can be
    pickled and copied. Raises InputError for a scenario that cannot run.
    """

    def __init__(self, scenario: Source, /, **overrides: Any):
        self._scenario = Scenario(scenario, _look=True, **overrides)._scenario
        self._core = _core.Drive(self._scenario)

    def step(self, torque: float, dt: float) -> State:
        """Goes on by dt [s] under a motor torque [N m] held meanwhile. Raises SimulationHalted where the drive cannot go on:
        it stands where it halted until reset() or restore(); InputError for a torque or dt that is none."""
        return State._make(self._core.step(torque, dt))

    @property
    def state(self) -> State:
        return State._make(self._core.state())

    @property
    def columns(self) -> dict[str, float]:
        """Every column that a trajectory of this drive has, as it is now: those of `state`, of elastic teeth, of the winding
        of its motor, and of states of effects, such as {"motor_current": 1.2, "load_coupling_twist": 0.01, ...}"""
        return self._core.columns()

    @property
    def time(self) -> float:
        """[s]"""
        return self._core.state()[0]

    @property
    def events(self) -> dict[str, int]:
        """How many events there were since the start, by the names of a run's events: {"break_away": 2, ...}"""
        return self._core.events()

    @property
    def set_aside(self) -> list[str]:
        """What the scenario states and stepping has no use for, a sentence each."""
        return self._scenario.set_aside()

    def reset(self) -> State:
        """Starts again, as the scenario states."""
        self._core.reset()
        return self.state

    def snapshot(self) -> bytes:
        """All that changes in the drive; the same steps from it on have the same bits, in any process of this machine."""
        return self._core.snapshot()

    def restore(self, snapshot: bytes) -> State:
        """Goes back to a snapshot of this drive or of one with the same scenario; any other raises InputError."""
        self._core.restore(snapshot)
        return self.state

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuilt, (self._scenario, self.snapshot())

    def __repr__(self) -> str:
        aside = "".join(f"; {sentence}" for sentence in self.set_aside)
        return f"<wormdrive.Drive '{self._scenario.title}' at {self.time:g} s{aside}>"


class Drives:
    """Drives that are stepped together: drives.step(torques, dt), a torque [N m] for each.

    An override that is a NumPy array of one axis has a value for each drive: mesh={"friction": np.linspace(0.1, 0.2, n)}.
    `time`, `gear_angle`, `gear_speed`, `motion`, `flank` and `halted` are arrays that show the present without a copy: they
    change with every step, so copy() what has to stay. drives[k] is the State of one.

    With run.solver = "taylor" drives that differ in numbers alone share the registers of the processor (`in_lanes`), if
    nothing but motor, bearings and an arm under gravity moves them. Other threads run while they are stepped.
    """

    def __init__(self, scenario: Source, count: int, /, **overrides: Any):
        if count < 1:
            raise InputError(f"drives: error: count = {count} must be at least 1")
        if _varies(overrides):
            of_each = [Scenario(scenario, _look=True, **_of(overrides, k, count))._scenario for k in range(count)]
        else:
            of_each = [Scenario(scenario, _look=True, **overrides)._scenario] * count
        self._take(of_each)

    def _take(self, scenarios: list[_core.Scenario]) -> None:
        self._scenarios = scenarios
        self._core = core = _core.Drives(scenarios)
        self.time, self.gear_angle, self.gear_speed = core.time(), core.gear_angle(), core.gear_speed()  #: [s, rad, rad/s]
        self.motion, self.flank, self.halted = core.motion(), core.flank(), core.halted().view(np.bool_)
        self.in_lanes = core.in_lanes

    def step(self, torques: Any, dt: float) -> None:
        """All go on by dt [s], each under its torque [N m]. One that cannot go on stays where it halted until it is reset
        and holds back no other; when all have made their step, SimulationHalted tells of it, once."""
        self._core.step(torques, dt)

    def column(self, name: str) -> npt.NDArray[np.float64]:
        """What a column of a trajectory shows of each now, as Drive.columns has it. Raises InputError for one that there
        is not."""
        return self._core.column(name)

    def events(self, k: int) -> dict[str, int]:
        """How many events drive k had since its start, by the names of a run's events."""
        return self._core.events(k)

    @property
    def set_aside(self) -> list[str]:
        """What the scenarios state and stepping has no use for, a sentence each."""
        return list(dict.fromkeys(sentence for scenario in self._scenarios for sentence in scenario.set_aside()))

    def reset(self, which: Optional[Any] = None) -> None:
        """Starts all again, or those of a list of numbers or of an array of bool; each at time 0."""
        if which is None:
            return self._core.reset(None)
        chosen = np.asarray(which)
        if chosen.dtype == np.bool_ and chosen.shape != (len(self),):
            raise InputError(f"drives: error: {chosen.size} truth values for {len(self)} drives")
        numbers = np.flatnonzero(chosen) if chosen.dtype == np.bool_ else np.atleast_1d(chosen)
        return self._core.reset([int(k) for k in numbers])

    def snapshot(self) -> bytes:
        """All that changes in the drives."""
        return self._core.snapshot()

    def restore(self, snapshot: bytes) -> None:
        """Goes back to a snapshot of drives with the same scenarios, or takes all to that of one Drive; any other raises
        InputError."""
        self._core.restore(snapshot)

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, k: int) -> State:
        return State._make(self._core.state(k))

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuilt_together, (self._scenarios, self.snapshot())

    def __repr__(self) -> str:
        return f"<wormdrive.Drives: {len(self)} of '{self._scenarios[0].title}', {'in lanes' if self.in_lanes else 'one by one'}>"


def _rebuilt(scenario: _core.Scenario, snapshot: bytes) -> Drive:
    drive = Drive.__new__(Drive)
    drive._scenario, drive._core = scenario, _core.Drive(scenario)
    drive.restore(snapshot)
    return drive


def _rebuilt_together(scenarios: list[_core.Scenario], snapshot: bytes) -> Drives:
    drives = Drives.__new__(Drives)
    drives._take(scenarios)
    drives.restore(snapshot)
    return drives


def _varies(value: Any) -> bool:
    return any(map(_varies, value.values())) if isinstance(value, Mapping) else isinstance(value, np.ndarray) and value.ndim == 1


def _of(tables: Mapping[str, Any], k: int, count: int, path: str = "") -> dict[str, Any]:
    """The overrides of one drive."""
    def one(key: str, value: Any) -> Any:
        if isinstance(value, Mapping):
            return _of(value, k, count, f"{path}{key}.")
        if not _varies(value):
            return value
        if len(value) != count:
            raise InputError(f"drives: error: {path}{key} has {len(value)} values for {count} drives")
        return value[k]

    return {key: one(key, value) for key, value in tables.items()}
