#!/usr/bin/python3
"""Checks that the documentation is true: run_howto.py PROGRAM [PICTURES]

  commands  code blocks marked `sh test` or `python test` run, page by page, in a folder with a copy of scenarios/
  output    a block marked `text test` is what they print, numbers aside, `...` is what was left out; `$ COMMAND` runs it
  pictures  each picture on a page in docs/ is made by commands of that page
  code      what stands between // [howto] and // [/howto] in tests/docs/NAME.cpp or NAME.c stands in docs/howto/NAME.md
  links     every link between pages leads to a file, and to a heading in it

One line per fault, exit status 1 if there is any. With PICTURES, a folder, blocks marked `sh pictures`, which take longer,
run too, and the pictures on the pages are written there.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "output/schema.md", *sorted(ROOT.glob("docs/**/*.md"))]
BLOCK = re.compile(r"^```(?P<language>\w*)(?P<mark> test| pictures)?\n(?P<code>.*?)^```$", re.MULTILINE | re.DOTALL)
MARKED = re.compile(r"^// \[howto\]\n(.*?)^// \[/howto\]$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\]\((?:\.\./)?(?:docs/)?pictures/([^)]*)\)")
MADE = re.compile(r"([\w./]+)\.(?:h5|png)\b")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]*)#?([^)\s]*)\)")
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")  # differs from one processor and library to the next
PRELUDE = "set -euo pipefail\ntrap 'status=$?; ((status == 0)) || echo \"$block: exit status $status\" >&2' EXIT\n"


def name(page):
    return os.path.relpath(page, ROOT)


def picture_faults(page, text):
    """Yields the pictures of a page that none of its commands draws."""
    made = {Path(name).name for block in BLOCK.finditer(text) if block["mark"] for name in MADE.findall(block["code"])}
    for picture in PICTURE.findall(text):
        if Path(picture).stem not in made and page.name != "README.md":
            yield f"{name(page)}: no command draws pictures/{picture}"


def shape(line):
    """A printed line without its numbers and blanks."""
    return " ".join(NUMBER.sub("#", line).split())


def output_faults(page, text, printed):
    """Yields the lines that a page shows as printed and that nothing has printed."""
    known = set(map(shape, printed.splitlines()))
    for block in BLOCK.finditer(text):
        if (block["language"], block["mark"]) == ("text", " test"):
            for line in block["code"].splitlines():
                if not line.startswith("$ ") and line.strip() != "..." and shape(line) not in known:
                    yield f"{name(page)}: no command prints '{line.strip()}'"


def command_faults(page, text, program, pictures):
    """Runs the marked blocks of a page in one bash, keeps the pictures it shows, and returns what went wrong."""
    script, marks = PRELUDE, {" test", " pictures"} if pictures else {" test"}
    for block in filter(lambda found: found["mark"] in marks, BLOCK.finditer(text)):
        code, line = block["code"], text.count("\n", 0, block.start()) + 1
        if block["language"] == "python":
            code = f"/usr/bin/python3 - <<'END_OF_BLOCK'\n{code}END_OF_BLOCK\n"
        elif block["language"] == "text":
            code = f"{code[2:].splitlines()[0]} || true\n" if code.startswith("$ ") else ""
        script += f"block={name(page)}:{line}\n{code}"
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(ROOT / "scenarios", Path(folder, "scenarios"))
        for beside in ("docs", "plots"):
            Path(folder, beside).symlink_to(ROOT / beside)
        environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}",
                       "PYTHONPATH": str(program.parent / "python")}
        run = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, capture_output=True, text=True)
        for picture in PICTURE.findall(text) if pictures else []:
            for made in [Path(folder, picture), *Path(folder).glob(f"*/{picture}")]:
                if made.is_file():
                    shutil.copy(made, pictures)
    return [run.stderr.rstrip()] if run.returncode else [*output_faults(page, text, run.stdout + run.stderr)]


def anchors(text):
    """The anchors that GitHub gives to the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def link_faults(page, text):
    """Yields the links that lead nowhere."""
    for target, anchor in LINK.findall(BLOCK.sub("", text)):
        file = (page.parent / target).resolve() if target else page
        if not file.exists():
            yield f"{name(page)}: there is no {target}"
        elif anchor and anchor not in anchors(BLOCK.sub("", file.read_text(encoding="utf-8"))):
            yield f"{name(page)}: {name(file)} has no heading #{anchor}"


def code_faults():
    """Yields the marked code that its page does not show."""
    for source in sorted((ROOT / "tests/docs").glob("*.c*")):
        page = (ROOT / "docs/howto" / source.stem).with_suffix(".md")
        for code in MARKED.findall(source.read_text(encoding="utf-8")):
            if code not in page.read_text(encoding="utf-8"):
                yield f"{name(page)}: differs from {name(source)}, from '{code.splitlines()[0]}' on"


if __name__ == "__main__":
    faults = list(code_faults()) if len(sys.argv) in (2, 3) else sys.exit(__doc__)
    kept = Path(sys.argv[2]) if len(sys.argv) == 3 else None
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        faults += [*link_faults(page, text), *picture_faults(page, text),
                   *command_faults(page, text, Path(sys.argv[1]).resolve(), kept)]
    print(*faults, f"docs: {len(PAGES)} pages, {len(faults)} faults", sep="\n")
    sys.exit(1 if faults else 0)
