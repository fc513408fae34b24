"""Runs a command where the decimal point is a comma: decimal_comma.py COMMAND...

The locale is made here, for a fresh system has none but C. It is one for numbers alone; whoever asks for the locale of the
user, setlocale(LC_ALL, ""), gets it.
"""

import ctypes
import locale
import os
import subprocess
import sys
import tempfile
from pathlib import Path

LOCALE = """comment_char %
escape_char /
LC_NUMERIC
decimal_point ","
thousands_sep "."
grouping 3;3
END LC_NUMERIC
"""
CHARACTERS = ("<code_set_name> ASCII\n<comment_char> %\n<escape_char> /\n<mb_cur_min> 1\n<mb_cur_max> 1\nCHARMAP\n"
              + "".join(f"<U{code:04X}> /x{code:02x} CHARACTER\n" for code in range(128)) + "END CHARMAP\n")


def make_locale(folder):
    """Makes the locale `comma` in a folder, and the locale of this process and its children of it."""
    Path(folder, "source").write_text(LOCALE)
    Path(folder, "characters").write_text(CHARACTERS)
    # it complains of all that is not said, with exit code 1; whether there is a locale is seen below
    subprocess.run(["localedef", "-c", "-i", "source", "-f", "characters", "./comma"], cwd=folder, capture_output=True,
                   check=False)
    for name in [name for name in os.environ if name.startswith("LC_") or name == "LANG"]:
        del os.environ[name]
    os.environ.update(LOCPATH=folder, LC_NUMERIC="comma")
    os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0")  # the C library never frees its list of LOCPATH
    locale.setlocale(locale.LC_ALL, "")
    strtod = ctypes.CDLL(None).strtod
    strtod.restype = ctypes.c_double
    if strtod(b"1,5", None) != 1.5:
        sys.exit("decimal_comma: there is no locale with a decimal comma here")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        make_locale(scratch)
        sys.exit(subprocess.run(sys.argv[1:], check=False).returncode)
