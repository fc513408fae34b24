#!/usr/bin/env python3
"""Writes the manual of the program, a compressed page for it and for each command, from what --help prints.

Usage: man_pages.py PROGRAM FOLDER. The exit codes are those of the README.
"""

import gzip
import re
import shutil
import subprocess
import sys
from pathlib import Path

README = Path(__file__).resolve().parents[1] / "README.md"
HEADING = re.compile(r"^(\w[\w ]*):$")
ENTRY = re.compile(r"^  (\S.*?)(?:\s{2,}(\S.*))?$")  # "  -o,--output TEXT    what it is", or what it is on the next line
CONTINUED = re.compile(r"^ {20,}(\S.*)$")
EXIT_CODE = re.compile(r"^\| (\d) \| (.*) \|$", re.MULTILINE)


def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], capture_output=True, text=True, check=True).stdout


def sections(text):
    """What a help says it is for, what follows "Usage:", and its sections: name, [[term, meaning]]."""
    lines = text.splitlines()
    usage = next(line for line in lines if line.startswith("Usage: ")).removeprefix("Usage: ")
    found = []
    for line in lines[2:]:
        if heading := HEADING.match(line):
            found.append((heading[1], []))
        elif more := CONTINUED.match(line):
            found[-1][1][-1][1] = f"{found[-1][1][-1][1]} {more[1]}".strip()
        elif entry := ENTRY.match(line):
            found[-1][1].append([entry[1], entry[2] or ""])
    return lines[0], usage, found


def roff(text):
    """Text without what the formatter would take for an instruction; hyphens stay hyphens, for copying."""
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", r"\e").replace("-", r"\-"))


def term(text):
    """An option or argument: its names bold, what it takes in italics."""
    names, _, takes = text.removesuffix(" REQUIRED").partition(" ")
    names = f"\\fB{roff(names.replace(',', ', '))}\\fR"
    return f"{names} \\fI{roff(takes)}\\fR" if takes else names


def page(name, version, text, see):
    what, usage, parts = sections(text)
    what = what.partition(": ")[2] if what.startswith("wormdrive: ") else what
    words = name.split("-")
    rest = " ".join(usage.split()[len(words):])
    lines = [f'.TH {roff(name.upper())} 1 "" "{version}" "User Commands"', ".SH NAME", f"{roff(name)} \\- {roff(what)}",
             ".SH SYNOPSIS", f".B {' '.join(words)}", roff(rest)]
    for heading, entries in parts:
        lines.append(f'.SH "{heading.upper()}"')
        for entry, meaning in entries:
            lines += [".TP", term(entry), roff(meaning)]
    lines.append('.SH "EXIT STATUS"')
    for code, meaning in EXIT_CODE.findall(README.read_text(encoding="utf-8")):
        lines += [".TP", f".B {code}", roff(meaning.replace("`", ""))]
    lines += ['.SH "SEE ALSO"', ",\n".join(f".BR {roff(other)} (1)" for other in see).replace(",\n", " ,\n")]
    return "\n".join(lines) + "\n"


def main(program, folder):
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    version = " ".join(version.split()[:2])
    text = help_of(program)
    commands = [entry for heading, entries in sections(text)[2] if heading != "Options" for entry, _ in entries]
    names = [f"wormdrive-{command}" for command in commands]
    pages = {"wormdrive": page("wormdrive", version, text, names)}
    for command, name in zip(commands, names):
        pages[name] = page(name, version, help_of(program, command), ["wormdrive"])
    shutil.rmtree(folder, ignore_errors=True)  # a command that was renamed leaves no page
    Path(folder).mkdir(parents=True)
    for name, written in pages.items():
        Path(folder, f"{name}.1.gz").write_bytes(gzip.compress(written.encode(), 9, mtime=0))


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) == 3 else sys.exit(__doc__)
