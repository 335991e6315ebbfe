"""The program `dam`: that of the Rust crate, within this package."""

from __future__ import annotations

import os
import signal
import sys
from typing import NoReturn

from dam import _dam

__all__ = ["main"]


def main() -> NoReturn:
    """Runs the program with the arguments of the process, and ends the process."""
    # The program hears signals itself; Python's handlers would keep them to themselves.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os._exit(_dam.program(["dam", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
