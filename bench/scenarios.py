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


def angles(run):
    """The gear's angle at the reports [rad], by time."""
    trajectory = run.run().trajectory
    return dict(zip(trajectory.time, trajectory.gear_angle))


def apart(ours, theirs):
    """Largest difference at the reports of both [rad]."""
    return max(abs(ours[t] - theirs[t]) for t in ours.keys() & theirs.keys())


def main():
    print("| scenario | taylor [ms] | adams [ms] | bdf [ms] | taylor / the faster of CVODE | error of taylor | adams | bdf |")
    print("|---|---|---|---|---|---|---|---|")
    for path in [Path(word) for word in sys.argv[1:]] or sorted(SCENARIOS.glob("*.toml")):
        try:
            drive = wormdrive.Scenario(path)
            runs = {solver: wormdrive.Scenario(drive, run=how) for solver, how in SOLVERS.items()}
        except wormdrive.InputError as fault:
            print(f"{path.name}: {fault}", file=sys.stderr)
            continue
        least = measure(runs)
        found = {solver: angles(run) for solver, run in runs.items()}
        judges = {solver: angles(wormdrive.Scenario(runs[solver], run={"relative_tolerance": 1e-12}))
                  for solver in ("taylor", "bdf")}
        errors = [apart(found[solver], judges["bdf" if solver == "taylor" else "taylor"]) for solver in SOLVERS]
        cells = [f"{1e3 * least[solver]:.3g}" for solver in SOLVERS]
        cells.append(f"{least['taylor'] / min(least['adams'], least['bdf']):.2g}")
        print(f"| {path.name} | " + " | ".join(cells + [f"{size:.1e}" for size in errors]) + " |", flush=True)


if __name__ == "__main__":
    main()
