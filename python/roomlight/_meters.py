"""Light meters, and lighting proposals."""

import contextlib
import json
import os
import tempfile
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _roomlight
from ._common import Floats, Path, Progress, file_name, filled, rows
from ._errors import InputError
from ._scene import Scene


class Readings(NamedTuple):
    """What incident light meters read."""

    lux: Floats  # (n,)
    standard_error: Floats  # (n,), lx


class MeterReport:
    """What `measure` found out."""

    def __init__(self, report: _roomlight.MeterReport) -> None:
        self._report = report

    def table(self) -> str:
        """A table for a terminal."""
        return self._report.table()

    def json(self) -> Dict[str, Any]:
        """Every reading, as `roomlight measure --json` writes it."""
        report: Dict[str, Any] = json.loads(self._report.json())
        return report

    def csv(self) -> str:
        """One line a reading."""
        return self._report.csv()

    def html(self) -> str:
        """A page for printing."""
        return self._report.html()

    @property
    def warnings(self) -> List[str]:
        """What the numbers leave out, a line each."""
        return self._report.warnings()

    def __str__(self) -> str:
        return self.table()


class Meters:
    """A scene lit for meters: light is found once, for any number of readings. Arguments: as of `measure`."""

    def __init__(
        self,
        scene: Scene,
        *,
        technique: str = "hybrid",
        quality: str = "good",
        tolerance: float = 0.02,
        seed: int = 0,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> None:
        options = _options(technique=technique, quality=quality, tolerance=tolerance, seed=seed, threads=threads)
        self._meters = _roomlight.Meters.of(scene._home, options, progress)

    def read(
        self, positions: npt.ArrayLike, normals: npt.ArrayLike = (0, 1, 0), progress: Optional[Progress] = None
    ) -> Readings:
        """Illuminance at places, with the standard error of each.

        positions: (n, 3), m; or (3,), one meter. normals: (n, 3), or (3,) of all: where the meters face; need not be
        unit; upwards if not given.
        """
        places = rows(np.atleast_2d(np.asarray(positions)), 3, "positions")
        facing = rows(np.atleast_2d(np.asarray(normals)), 3, "normals")
        if len(facing) == 1:
            facing = np.ascontiguousarray(np.broadcast_to(facing, places.shape))
        if len(facing) != len(places):
            raise InputError(f"normals: there are {len(facing)}, and {len(places)} positions")
        readings = self._meters.illuminance(places, facing, progress)
        return Readings(readings[:, 0], readings[:, 1])

    def illuminance(
        self, positions: npt.ArrayLike, normals: npt.ArrayLike = (0, 1, 0), progress: Optional[Progress] = None
    ) -> Floats:
        """Illuminance at places, (n,) float32 in lx. Arguments: as of `read`."""
        return self.read(positions, normals, progress).lux


def measure(
    scene: Scene,
    meters: Union[Path, Mapping[str, Any], None] = None,
    *,
    technique: str = "hybrid",
    quality: str = "good",
    tolerance: float = 0.02,
    seed: int = 0,
    threads: int = 0,
    daylight_factor: bool = False,
    progress: Optional[Progress] = None,
) -> MeterReport:
    """Holds light meters into a scene.

    meters: a meter file, or what one holds as a dict (docs/reference/meters.md); None: every room on its work plane.
    quality: "draft", "good" or "best". tolerance: relative standard error at which a meter is read, such as 0.02.
    threads: 0: all cores. daylight_factor: measure a second time, under a CIE overcast sky alone. progress: as of
    `render`; where it returns False, `Interrupted` is raised.
    """
    with _file_of(meters) as name:
        options = _options(
            technique=technique, quality=quality, tolerance=tolerance, seed=seed, threads=threads, meters=name
        )
        options.daylight_factor = daylight_factor
        return MeterReport(_roomlight.measure(scene._home, options, progress))


def illuminance(
    scene: Scene,
    positions: npt.ArrayLike,
    normals: npt.ArrayLike = (0, 1, 0),
    *,
    technique: str = "hybrid",
    quality: str = "good",
    tolerance: float = 0.02,
    seed: int = 0,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Floats:
    """Illuminance at places in a scene, (n,) float32 in lx.

    positions: (n, 3), m. normals: (n, 3), or (3,) of all: where the meters face. Other arguments: as of `measure`. For
    more readings in the same light `Meters` keeps it.
    """
    kept = Meters(
        scene,
        technique=technique,
        quality=quality,
        tolerance=tolerance,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    return kept.illuminance(positions, normals, progress)


class Design(NamedTuple):
    """A lighting design on the best trade-offs between objectives."""

    name: str  # "design 1"
    objectives: Dict[str, float]  # by name: "targetMiss", ...
    fittings: int
    installed_power: float  # W
    lighting_files: List[str]  # one a condition
    largest_difference: Optional[float]  # from the full solution, per cent; None: not solved in full


def optimise(
    home: Path,
    study: Path,
    folder: Path,
    *,
    method: str = "hybrid",
    quality: str = "good",
    evaluations: Optional[int] = None,
    certified: Optional[int] = None,
    seed: Optional[int] = None,
    metres_per_unit: Optional[float] = None,
    seconds: float = 0,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> List[Design]:
    """Proposes lighting for the goals of a study.

    home, study: files (docs/reference/optimise.md). folder: for index.html, front.csv and lighting files; what it holds
    of the same inputs is not found again, so work that was interrupted goes on. method: "hybrid", "nsga2", "pagmo",
    "weighted" or "random". evaluations, certified (designs that are solved in full), seed: instead of the study's.
    seconds: of the search at most; 0: no limit. progress: as of `render`; where it returns False, `Interrupted` is
    raised.
    """
    options = filled(
        _roomlight.OptimiseOptions(),
        method=method,
        quality=quality,
        evaluations=evaluations,
        certified=certified,
        seed=seed,
        metres_per_unit=metres_per_unit,
        seconds=seconds,
        threads=threads,
    )
    found = _roomlight.optimise(file_name(home), file_name(study), file_name(folder), options, progress)
    return [Design(*d) for d in found]


def _options(**values: object) -> _roomlight.MeterOptions:
    return filled(_roomlight.MeterOptions(), **values)


@contextlib.contextmanager
def _file_of(meters: Union[Path, Mapping[str, Any], None]) -> Iterator[Optional[bytes]]:
    if meters is None or not isinstance(meters, Mapping):
        yield None if meters is None else file_name(meters)
        return
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "meters.json")
        with open(name, "w", encoding="utf-8") as file:
            json.dump(meters, file)
        yield file_name(name)
