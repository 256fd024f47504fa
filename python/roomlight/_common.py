"""What the files of the package share."""

import os
from typing import Any, Callable, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np
import numpy.typing as npt

from ._errors import InputError

Path = Union[str, "os.PathLike[str]"]
Place = Union[Sequence[float], npt.NDArray[Any]]  # three numbers
Vec3 = Tuple[float, float, float]
Floats = npt.NDArray[np.float32]
Bytes = npt.NDArray[np.uint8]
# Called as progress(stage, fraction), fraction from 0 to 1; False, but not None, ends the work.
Progress = Callable[[str, float], Optional[bool]]

_Struct = TypeVar("_Struct")


def file_name(path: Path) -> bytes:
    """A file's name as the system has it, whatever it is encoded in."""
    return os.fsencode(path)


def filled(struct: _Struct, **values: object) -> _Struct:
    """Sets members of a struct of the library; None: as they are."""
    for name, value in values.items():
        if value is None:
            continue
        try:
            setattr(struct, name, value)
        except TypeError:
            raise TypeError(f"{name}: {value!r} is of a type that does not fit") from None
    return struct


def rows(values: object, width: int, name: str) -> Floats:
    """Float32 rows of so many numbers: the array itself where it is that already, else a converted copy."""
    try:
        array = np.ascontiguousarray(values, dtype=np.float32)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: must be an array of numbers ({error})") from None
    if array.size == 0:
        return array.reshape(0, width)
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(f"{name}: must have the shape (n, {width}), and has {array.shape}")
    return array
