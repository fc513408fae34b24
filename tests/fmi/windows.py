#!/usr/bin/env python3
"""An FMU on Windows has the digits that it has on Linux: windows.py PROGRAM STEPS STEPS.exe SCENARIO...

STEPS is the importer steps.c, for both. Needs wine, and a build that made the library for Windows; says so without.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

SKIPPED = 77  # what ctest takes as a test that could not run
WINE = ["wine64", "wine", "/usr/lib/wine/wine64"]


def digits(command, library, folder):
    """What the importer prints for the FMU in a folder, and nothing if it fails."""
    xml = (folder / "modelDescription.xml").read_text(encoding="utf-8")
    guid = re.search('guid="([^"]*)"', xml).group(1)
    end = float(re.search('stopTime="([^"]*)"', xml).group(1))
    environment = {**os.environ, "WINEPREFIX": str(folder.parent / "wine"), "WINEDEBUG": "-all"}
    done = subprocess.run([*command, library, guid, "resources", str(min(end, 1.0)), "0.01"], cwd=folder, env=environment,
                          capture_output=True, text=True, check=False)
    print(f"{command[-1]}: {done.stdout.splitlines()[-1] if done.stdout else done.stderr}")
    return done.stdout.split() if done.returncode == 0 else None


def main(program, native, foreign, *scenarios):
    wine = next((found for found in map(shutil.which, WINE) if found), None)
    if not wine or not Path(foreign).exists():
        print("skipped: wine is not installed" if not wine else "skipped: no cross compiler for Windows was there")
        return SKIPPED
    faults = 0
    with tempfile.TemporaryDirectory() as temporary:
        for k, scenario in enumerate(scenarios):
            folder = Path(temporary, str(k))
            subprocess.run([program, "fmu", scenario, "--kind", "loop", "-o", f"{folder}.fmu"], check=True,
                           stdout=subprocess.DEVNULL)
            zipfile.ZipFile(f"{folder}.fmu").extractall(folder)
            here = digits([native], "binaries/linux64/wormdrive_fmu.so", folder)
            there = digits([wine, foreign], "binaries/win64/wormdrive_fmu.dll", folder)
            if here is None or here != there:
                print(f"{Path(scenario).name}: the digits differ")
                faults += 1
        subprocess.run([shutil.which("wineserver") or "/usr/lib/wine/wineserver64", "-k"], check=False,
                       env={**os.environ, "WINEPREFIX": str(Path(temporary, "wine"))}, capture_output=True)
    print(f"windows: {len(scenarios)} FMUs, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) > 4 else __doc__)
