#!/usr/bin/env python3
"""How long will a sweep of a billion trials take on a cluster whose nodes fail? The job, simulated many times over.

plan_sweep.py [--trials 1e9] [--cpu-us 131] ... : every number of the plan is an option; --help lists them.

All ranks share the trials. When a node fails, mpirun ends the job; it is submitted again, waits in the queue and goes on
without the rows of the last second. The same happens at the limit of a job's time. With --shards every node runs shards
of its own, and only these have to be submitted again. At the end the parts are merged.
"""

import argparse
import random

SECONDS_LOST = 1.0  # a row is in its file so long after its trial has ended


def asked():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default, what in [
        ("trials", 1e9, "number of trials"),
        ("cpu-us", 131.0, "CPU time of a trial [us]: that in the line `cost` of a small sweep over its trials"),
        ("row-bytes", 297.0, "bytes of a row: size of the file of a small sweep over its trials"),
        ("nodes", 16, "number of nodes"),
        ("cores", 64, "cores of a node"),
        ("mtbf-days", 300.0, "mean time between failures of a node"),
        ("limit-hours", 24.0, "limit of the time of a job"),
        ("queue-minutes", 30.0, "time in the queue before a job begins"),
        ("merge-rows", 6e5, "rows per second that are merged, with their summary"),
        ("jobs", 1000, "number of simulated jobs"),
    ]:
        parser.add_argument(f"--{name}", type=float, default=default, help=f"{what} ({default:g})")
    parser.add_argument("--shards", action="store_true", help="an array of shards instead of one job of all nodes")
    return parser.parse_args()


def run(plan, nodes, trials, chance):
    """Time until so many nodes that stop together have made their trials [s], and how often they were interrupted."""
    rate = nodes * plan.cores / (1e-6 * plan.cpu_us)  # trials per second
    time, done, stops = 0.0, 0.0, 0
    while True:
        time += 60.0 * plan.queue_minutes
        needs = (trials - done) / rate
        lasts = min(chance.expovariate(nodes / (86400.0 * plan.mtbf_days)), 3600.0 * plan.limit_hours)
        if needs <= lasts:
            return time + needs, stops
        time += lasts
        done += rate * max(0.0, lasts - SECONDS_LOST)
        stops += 1


def job(plan, chance):
    """Time of the whole job [s], and its interruptions."""
    if not plan.shards:
        time, stops = run(plan, plan.nodes, plan.trials, chance)
    else:
        parts = [run(plan, 1, plan.trials / plan.nodes, chance) for _ in range(int(plan.nodes))]
        time, stops = max(time for time, _ in parts), sum(stops for _, stops in parts)
    return time + plan.trials / plan.merge_rows, stops


def main():
    plan = asked()
    chance = random.Random(1)
    jobs = [job(plan, chance) for _ in range(int(plan.jobs))]
    hours = sorted(time / 3600.0 for time, _ in jobs)
    computing = plan.trials * 1e-6 * plan.cpu_us / 3600.0
    print(f"ranks          {plan.nodes * plan.cores:.0f}")
    print(f"core hours     {computing:.1f}, at best {computing / (plan.nodes * plan.cores):.2f} h by the clock")
    print(f"file           {plan.trials * plan.row_bytes / 1e9:.0f} GB, and as much again while parts are merged")
    print(f"until merged   {hours[len(hours) // 2]:.2f} h in the median, {hours[len(hours) * 9 // 10]:.2f} h in one of ten")
    print(f"interruptions  {sum(stops for _, stops in jobs) / len(jobs):.2f} on average")


if __name__ == "__main__":
    main()
