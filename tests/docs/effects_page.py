#!/usr/bin/python3
"""Checks that docs/effects.md has the catalogue of the program: effects_page.py PROGRAM [--write]

Between the sections that `PROGRAM list effects.md` prints the page has an introduction and, under each effect, worked
values; tests/docs/effects_values.cpp checks these. --write brings the page up to date and keeps both.
"""

import re
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/effects.md"
WORKED = "| with | at | gives |"


def sections(text):
    """{effect: its section}, and what stands before the first."""
    before, *rest = re.split(r"^(?=## `)", text, flags=re.MULTILINE)
    return before, {re.match(r"## `(\w+)`", section)[1]: section for section in rest}


def worked_values(section):
    return section[section.index(WORKED):].strip() + "\n\n" if WORKED in section else ""


def main():
    program, write = sys.argv[1], "--write" in sys.argv
    page = PAGE.read_text(encoding="utf-8")
    introduction, written = sections(page)
    printed = subprocess.run([program, "list", "effects.md"], check=True, text=True, stdout=subprocess.PIPE).stdout
    wanted = introduction
    for effect, section in sections(printed)[1].items():
        wanted += section + worked_values(written.get(effect, ""))
    wanted = wanted.rstrip() + "\n"
    if write:
        PAGE.write_text(wanted, encoding="utf-8")
    elif wanted != page:
        sys.exit(f"docs/effects.md is not what the catalogue says; {sys.argv[0]} {program} --write mends it")


if __name__ == "__main__":
    main()
