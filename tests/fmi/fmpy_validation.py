#!/usr/bin/env python3
"""FMPy's opinion on FMUs, where it is installed (it is not in Debian): fmpy_validation.py PROGRAM SCENARIO...

Its validation finds nothing, and its own integrator with the event indicators runs each FMU to the end. One line per fault.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77  # what ctest takes as a test that could not run

def faults(program, scenario, folder):
    """Yields what FMPy finds wrong with the FMU of a scenario."""
    from fmpy import simulate_fmu
    from fmpy.validation import validate_fmu

    fmu = Path(folder, scenario.stem).with_suffix(".fmu")
    subprocess.run([program, "fmu", scenario, "-o", fmu], check=True, stdout=subprocess.DEVNULL)
    yield from validate_fmu(str(fmu))
    end = 0.5
    result = simulate_fmu(str(fmu), fmi_type="ModelExchange", stop_time=end, output=["gear_angle"])
    if abs(result["time"][-1] - end) > 1e-9:
        yield f"ends at {result['time'][-1]} s"


def main(program, *scenarios):
    try:
        import fmpy  # noqa: F401
    except ImportError:
        print("skipped: FMPy is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        found = [f"{Path(s).name}: {fault}" for s in scenarios for fault in faults(program, Path(s), folder)]
    print(*found, f"fmpy: {len(scenarios)} FMUs, {len(found)} faults", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) > 2 else __doc__)
