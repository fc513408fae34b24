#!/usr/bin/env python3
"""Runs the benchmark programs with Debian's SUNDIALS and, where they were built, with the -O3 one, and prints one table
per question. Usage: bench/run.py [folder of the programs] [--repetitions N]
"""

import argparse
import subprocess
import sys
from pathlib import Path

PROGRAMS = ["open_loop", "closed_loop"]
BUILDS = {"": "Debian's", "_o3": "-O3"}  # suffix of the program: name of the SUNDIALS it is linked with
RATIO = "cvode / by hand"  # unit of the table that compares row by row
REFEREES = ["cvode Adams", "taylor"]  # the others' times are given as multiples of theirs


def rows(program, repetitions):
    """The rows of a program as {(table, unit): {contender: [tolerance, evaluations, events, error, time]}}."""
    command = [program, "--rows", "--repetitions", str(repetitions)]
    tables = {}
    for line in subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE).stdout.splitlines():
        title, unit, contender, *cells = line.split("\t")
        name = f"{contender} {cells[0]}" if unit == RATIO else contender
        tables.setdefault((title, unit), {})[name] = cells
    return tables


def multiple(times, name, referee, suffix):
    if name not in times[suffix] or referee not in times[suffix]:
        return "-"
    return f"{times[suffix][name] / times[suffix][referee]:.2f}"


def print_table(title, unit, tables):
    """One row per contender; tables: {suffix: {contender: cells}}."""
    times = {suffix: {name: float(cells[-1]) for name, cells in table.items()} for suffix, table in tables.items()}
    first = next(iter(tables.values()))
    referees = [referee for referee in REFEREES if referee in first]
    head = ["contender", "tolerance", "evaluations", "events", "error"]
    head += [f"{BUILDS[suffix]} [{unit}]" for suffix in tables]
    head += [f"of {referee}, {BUILDS[suffix]}" for referee in referees for suffix in tables]
    print(f"\n{title}\n\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for name, cells in first.items():
        row = [name, *cells[:-1]]
        row += [f"{times[suffix][name]:.4g}" if name in times[suffix] else "-" for suffix in tables]
        row += [multiple(times, name, referee, suffix) for referee in referees for suffix in tables]
        print("| " + " | ".join(row) + " |")


def main():
    default = Path(__file__).resolve().parent.parent / "build/release/bench"
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=default)
    parser.add_argument("--repetitions", type=int, default=31)
    asked = parser.parse_args()

    models = [line.split(":")[1].strip() for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line]
    print(f"{models[0] if models else 'unknown processor'}, {len(models)} cores; CPU time, median of repeated runs")
    if not (asked.folder / f"{PROGRAMS[0]}_o3").exists():
        print("only Debian's SUNDIALS; for the second column see bench/README.md")
    for program in PROGRAMS:
        runs = {s: rows(asked.folder / (program + s), asked.repetitions) for s in BUILDS if (asked.folder / (program + s)).exists()}
        if not runs:
            sys.exit(f"no {program} in {asked.folder}: build it first")
        for title, unit in runs[""]:
            print_table(title, unit, {suffix: tables.get((title, unit), {}) for suffix, tables in runs.items()})


if __name__ == "__main__":
    main()
