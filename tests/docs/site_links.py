#!/usr/bin/env python3
"""Checks that every link on the pages of the documentation's site leads somewhere: site_links.py SITE

One line per fault, exit status 1 if there is any. Links to other hosts are not followed.
"""

import re
import sys
from functools import cache
from pathlib import Path
from urllib.parse import unquote

LINK = re.compile(r'(?:href|src)="(?!\w+:)([^"#]*)#?([^"]*)"')


@cache
def places(page):
    """What a link to a page can lead to."""
    return set(re.findall(r'(?:id|name)="([^"]+)"', page.read_text(encoding="utf-8", errors="replace")))


def faults(page):
    """Yields the links of a page that lead nowhere."""
    for file, place in sorted(set(LINK.findall(page.read_text(encoding="utf-8")))):
        to = page.parent / unquote(file) if file else page
        if not to.exists():
            yield f"{page.name}: there is no {file}"
        elif place and to.suffix == ".html" and place not in places(to):
            yield f"{page.name}: {to.name} has no #{place}"


if __name__ == "__main__":
    site = Path(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
    pages = [site / "index.html", *sorted(site.glob("md_*.html"))]
    found = [fault for page in pages for fault in faults(page)]
    print(*found, f"site: {len(pages)} pages, {len(found)} faults", sep="\n")
    sys.exit(1 if found else 0)
