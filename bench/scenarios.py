#!/usr/bin/env python3
"""Is `taylor` ever slower than CVODE? Every shipped scenario by every solver; the studies vary those of fig. 10.

PYTHONPATH=build/release/python bench/scenarios.py [SCENARIO...]

CPU time of one run, the least of several taken in turns. The error is the largest difference of the gear's angle at the
reports from a run of the other kind, `taylor` against BDF and BDF and Adams against `taylor`, at a relative tolerance of
1e-12; a closed loop may amplify it.
"""

import sys
import time
from pathlib import Path

import wormdrive

SCENARIOS = Path(__file__).resolve().parent.parent / "scenarios"
SOLVERS = {"taylor": {"solver": "taylor"}, "adams": {"solver": "cvode", "method": "adams"},
           "bdf": {"solver": "cvode", "method": "bdf"}}
ROUNDS, LEAST = 3, 0.05  # at least so many runs of each, and until they have taken so long [s]


def drives(paths):
    """Every drive that can be run, by name."""
    for path in paths:
        try:
            yield path.name, wormdrive.Scenario(path)
        except wormdrive.InputError as fault:
            print(f"{path.name}: {str(fault).splitlines()[0]}", file=sys.stderr)


def measure(runs):
    """The least CPU time of a run [s], by solver."""
    least, spent, rounds = {name: float("inf") for name in runs}, 0.0, 0
    while rounds < ROUNDS or spent < LEAST:
        for name, run in runs.items():
            begin = time.process_time()
            run.run()
            passed = time.process_time() - begin
            least[name], spent = min(least[name], passed), spent + passed
        rounds += 1
    return least


def error(scenario, judge):
    """Largest difference of the gear's angle at the reports of both [rad]."""
    ours, theirs = (dict(zip(at.time, at.gear_angle)) for at in (scenario.run().trajectory, judge.run().trajectory))
    return max(abs(ours[t] - theirs[t]) for t in ours.keys() & theirs.keys())


def main():
    shipped = sorted(SCENARIOS.glob("*.toml"))
    print("| scenario | taylor [ms] | adams [ms] | bdf [ms] | taylor / the faster of CVODE | error of taylor | adams | bdf |")
    print("|---|---|---|---|---|---|---|---|")
    for name, drive in drives([Path(word) for word in sys.argv[1:]] or shipped):
        try:
            runs = {solver: wormdrive.Scenario(drive, run=how) for solver, how in SOLVERS.items()}
        except wormdrive.InputError as fault:
            print(f"{name}: {fault}", file=sys.stderr)
            continue
        tight = {solver: wormdrive.Scenario(drive, run={**how, "relative_tolerance": 1e-12})
                 for solver, how in SOLVERS.items()}
        least = measure(runs)
        errors = [error(run, tight["bdf" if solver == "taylor" else "taylor"]) for solver, run in runs.items()]
        cells = [f"{1e3 * least[solver]:.3g}" for solver in SOLVERS]
        cells.append(f"{least['taylor'] / min(least['adams'], least['bdf']):.2g}")
        print(f"| {name} | " + " | ".join(cells + [f"{size:.1e}" for size in errors]) + " |", flush=True)


if __name__ == "__main__":
    main()
