"""The commands of the program `roomlight`."""

import os
import sys
from typing import NoReturn, Optional, Sequence

from . import _roomlight

# Where a wheel has the program, which can also start itself for `batch run`.
_PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "_prefix", "bin", "roomlight")


def main(words: Optional[Sequence[str]] = None) -> int:
    """Runs a command of the program `roomlight` in this process and returns its exit status: 0 where all went well.

    words: those of the command line, without the program's name; None: those of this process. `roomlight.main(["info",
    "home.sh3d"])` says what a home holds.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    given = sys.argv[1:] if words is None else list(words)
    return _roomlight.run_program([os.fsencode(w) for w in ["roomlight", *given]])


def run() -> NoReturn:
    """What `python3 -m roomlight` and the command `roomlight` of a wheel do."""
    if os.access(_PROGRAM, os.X_OK):
        os.execv(_PROGRAM, ["roomlight", *sys.argv[1:]])
    sys.exit(main())
