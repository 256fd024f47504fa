"""What can go wrong, as exceptions."""

import re

# Options have other names here than in C++ or on the command line.
_NAMES = {
    "metresPerUnit": "metres_per_unit",
    "lumenAtFullPower": "lumen_at_full_power",
    "verticalFovDeg": "vertical_fov",
    "localExposure": "local_exposure",
    "metres-per-pixel": "metres_per_pixel",
    "white-balance": "white_balance",
    "local-exposure": "local_exposure",
    "time-limit": "time_limit",
    "noise-level": "noise_level",
}
_NAME = re.compile(rf"\b({'|'.join(_NAMES)})\b")


class Error(Exception):
    """What the library says went wrong, in one line.

    `kind` is "bad input", "no room" (memory, or the machine, does not suffice), "interrupted" or "failed".
    """

    kind: str = "failed"


class InputError(Error, ValueError):
    """A file, a name or a value is wrong: the message says where, and what to do."""

    kind = "bad input"


class OutOfMemory(Error, MemoryError):
    """Memory, or the machine, does not suffice."""

    kind = "no room"


class Interrupted(Error):
    """A progress callback returned False, and there is no result so far."""

    kind = "interrupted"


def exception_of(kind: str, message: str) -> Error:
    """The exception for an error of the library."""
    for exception in (InputError, OutOfMemory, Interrupted):
        if exception.kind == kind:
            return exception(_NAME.sub(lambda found: _NAMES[found.group()], message))
    return Error(message)
