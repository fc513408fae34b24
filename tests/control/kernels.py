#!/usr/bin/env python3
"""Checks what the lane kernels leave in the library: code for a newer processor must stay in its own functions.

The linker keeps one of several copies of an inline function, for the whole program. A kernel for newer processors
therefore may export its entries and nothing else, run nothing at the start, and no kernel may fuse a multiplication with
an addition: it would round differently. Usage: kernels.py LIBRARY
"""

import re
import subprocess
import sys


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


library = sys.argv[1]
faults, kernels = [], 0
member = None
for line in output("nm", "--demangle", library).splitlines():
    if line.endswith(".o:"):
        member = line
    elif member and member.startswith("kernel_"):
        if not (symbol := re.match(r"\S*\s+(\S) (.*)", line)):
            continue
        kind, name = symbol.groups()
        entry = name.startswith(("wormdrive::take_samples_", "wormdrive::take_step_"))
        kernels += entry
        if name.startswith("DW.ref."):  # where a function stands: data, and the same in every copy
            continue
        if kind not in "UtrbdT" or (kind == "T" and not entry) or "_GLOBAL__" in name:
            if "plain" not in member:
                faults.append(f"{member} {kind} {name}")
for line in output("objdump", "--disassemble", "--no-show-raw-insn", library).splitlines():
    if line.startswith("kernel_") or ":     file format" in line:
        member = line
    elif member.startswith("kernel_") and re.search(r"\tvfn?m(add|sub)", line):
        faults.append(f"{member} {line.strip()}")
if kernels != 6:
    faults.append(f"{kernels} kernels found, not 6")
for fault in faults[:20]:
    print(fault)
sys.exit(bool(faults))
