#!/usr/bin/env python3
"""What a whole sweep costs beside its trials, what memory it takes, and what a second thread brings.

sweep.py PROGRAM [--trials N ...] [--seconds T]: the study robustness_sliding.toml, N trials of T s.
"""
import argparse
import os
import pathlib
import re
import subprocess
import tempfile
import time

STUDIES = pathlib.Path(__file__).resolve().parent.parent / "scenarios" / "studies"


def study(trials, seconds):
    """The study with other numbers, its scenario by its full path."""
    text = (STUDIES / "robustness_sliding.toml").read_text()
    text = text.replace("../fig10", f"{STUDIES.parent}/fig10").replace("trials = 100000", f"trials = {trials}")
    changes = f'"run.duration_s={seconds}", "run.report_interval_s={seconds}"'
    return text.replace('"run.report_interval_s=3"', changes)


def sweep(program, trials, seconds, threads):
    """Runs it; returns time passed, CPU time [s], peak memory [MB] and the shares that the program prints [%]."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "study.toml").write_text(study(trials, seconds))
        begin = time.monotonic()
        words = [program, "sweep", "study.toml", "-o", "sweep.h5", "--threads", str(threads)]
        child = subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, text=True)
        said = child.stdout.read()
        _, status, used = os.wait4(child.pid, 0)
        passed = time.monotonic() - begin
    if status:
        raise SystemExit(said)
    shares = [float(share) for share in re.search(r"^ *cost .*$", said, re.M)[0].replace(",", "").split() if
              re.fullmatch(r"\d+\.\d", share)]
    return passed, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, shares[-4:]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=lambda path: str(pathlib.Path(path).resolve()))
    parser.add_argument("--trials", type=int, nargs="+", default=[10**4, 10**5, 10**6])
    parser.add_argument("--seconds", type=float, default=10.0)
    options = parser.parse_args()
    print("| trials | threads | time [s] | CPU time [us per trial] | trials [%] | file [%] | referee [%] | summary [%] "
          "| peak memory [MB] |")
    print("|---|---|---|---|---|---|---|---|---|")
    for trials in options.trials:
        for threads in (1, 2):
            passed, cpu, memory, shares = sweep(options.program, trials, options.seconds, threads)
            print(f"| {trials} | {threads} | {passed:.2f} | {1e6 * cpu / trials:.1f} | "
                  + " | ".join(f"{share:.1f}" for share in shares) + f" | {memory:.1f} |", flush=True)


main()
