#!/usr/bin/env python3
"""What a run costs from Python beside the run itself: PYTHONPATH=build/release/python bench/python_overhead.py SCENARIO...

CPU time of this process, medians; bench/prepared_run.cpp prints the same from C++. The smallest run is a motor that never
starts, one row, taylor.
"""

import sys
import time

import wormdrive

REST = """
[mesh]
kind = "none"
inertia_kgm2 = 1
[effect.gear_coulomb]
torque_Nm = 1
[run]
duration_s = 1
report_interval_s = 1
solver = "taylor"
"""


def cpu_time(call, repetitions):
    """Median over five rounds [s]."""
    rounds = []
    for _ in range(5):
        begin = time.process_time()
        for _ in range(repetitions):
            call()
        rounds.append((time.process_time() - begin) / repetitions)
    return sorted(rounds)[2]


def main():
    rest = wormdrive.Scenario(REST)
    print(f"a run of nothing, all of it overhead: {1e6 * cpu_time(rest.run, 2000):.1f} us")
    print(f"the same with its columns:            {1e6 * cpu_time(lambda: rest.run().trajectory.time, 2000):.1f} us")
    for name in sys.argv[1:]:
        scenario = wormdrive.Scenario(name)
        print(f"{name}: {1e3 * cpu_time(scenario.run, 3):.2f} ms, "
              f"with all columns {1e3 * cpu_time(lambda: (r := scenario.run()).trajectory.time is r.events.time, 3):.2f} ms")


if __name__ == "__main__":
    main()
