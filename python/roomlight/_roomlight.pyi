"""include/roomlight as Python objects. Private: the package's own files say what users see of it."""

from typing import Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._common import Bytes, Floats, Place, Progress, Vec3

_Text = Union[str, bytes]

class OpenOptions:
    lighting: _Text
    light: str
    cameras: List[str]
    metres_per_unit: Optional[float]
    up: str
    lumen_at_full_power: float

class MaterialValues:
    name: str
    colour: Place
    texture: int
    alpha: float
    metallic: float
    roughness: float
    transmission: float
    index_of_refraction: float
    specular: float
    emission: Place
    double_sided: bool

class CameraValues:
    name: str
    eye: Place
    target: Place
    vertical_fov: float

class MeshArrays:
    name: str
    vertices: Floats
    faces: npt.NDArray[np.uint32]
    normals: Floats
    uv: Floats
    material: int

class HomeArrays:
    meshes: List[MeshArrays]
    materials: List[MaterialValues]
    textures: List[Bytes]
    cameras: List[CameraValues]

class Home:
    @staticmethod
    def open(file: _Text, options: OpenOptions) -> Home: ...
    @staticmethod
    def from_arrays(arrays: HomeArrays, options: OpenOptions) -> Home: ...
    def cameras(self) -> List[Tuple[str, Vec3, Vec3, bool]]: ...
    def default_camera(self) -> str: ...
    def rooms(self) -> List[Tuple[str, str, List[Tuple[float, float]], float, float]]: ...
    def lamps(self) -> List[Tuple[str, Vec3, float, str]]: ...
    def triangle_count(self) -> int: ...
    def bounds(self) -> Tuple[Vec3, Vec3]: ...
    def metres_per_unit(self) -> float: ...
    def warnings(self) -> List[str]: ...
    def notes(self) -> List[str]: ...
    def added_lighting(self) -> str: ...

class Settings:
    technique: str
    quality: str
    width: int
    height: int
    samples: int
    seed: int
    threads: int
    time_limit: float
    noise_level: float
    layers: bool
    layers_by_room: bool
    settings: str

class View:
    camera: str
    kind: str
    level: str
    room: str
    eye: Optional[Place]
    target: Optional[Place]
    vertical_fov: Optional[float]
    cut: Optional[float]
    metres_per_pixel: Optional[float]
    backdrop: str

class DisplayOptions:
    look: str
    exposure: str
    white_balance: str
    tone: str
    contrast: Optional[float]
    saturation: Optional[float]
    local_exposure: Optional[float]
    glare: Optional[float]
    vignette: Optional[float]

class Picture:
    def pixels(self) -> Floats: ...
    def complete(self) -> bool: ...
    def camera(self) -> str: ...
    def stats(self) -> str: ...
    def display(self, options: DisplayOptions) -> Bytes: ...
    def write(self, file: _Text, options: DisplayOptions) -> None: ...
    def layers(self) -> Layers: ...

class Renderer:
    @staticmethod
    def of(home: Home, settings: Settings, views: Sequence[View]) -> Renderer: ...
    def view_count(self) -> int: ...
    def picture(self, view: int, progress: Optional[Progress]) -> Picture: ...

class Dials:
    lamps: List[Tuple[str, str]]
    kelvin: Optional[float]
    sun: str
    sky: str

class Layers:
    @staticmethod
    def open(file: _Text) -> Layers: ...
    def width(self) -> int: ...
    def height(self) -> int: ...
    def infos(self) -> List[Tuple[str, str, Vec3, Optional[float], Optional[float], str]]: ...
    def gains(self, dials: Dials) -> Floats: ...
    def image(self, layer: int) -> Floats: ...
    def mix(self, dials: Dials) -> Floats: ...
    def display(self, dials: Dials, options: DisplayOptions) -> Bytes: ...
    def write_linear(self, dials: Dials, file: _Text) -> None: ...

class MeterOptions:
    technique: str
    quality: str
    tolerance: float
    seed: int
    threads: int
    meters: _Text
    daylight_factor: bool

class MeterReport:
    def table(self) -> str: ...
    def json(self) -> str: ...
    def csv(self) -> str: ...
    def html(self) -> str: ...
    def warnings(self) -> List[str]: ...

class Meters:
    @staticmethod
    def of(home: Home, options: MeterOptions, progress: Optional[Progress]) -> Meters: ...
    def illuminance(self, positions: Floats, normals: Floats, progress: Optional[Progress]) -> Floats: ...

class OptimiseOptions:
    method: str
    quality: str
    evaluations: Optional[int]
    certified: Optional[int]
    seed: Optional[int]
    metres_per_unit: Optional[float]
    seconds: float
    threads: int

def render(home: Home, view: View, settings: Settings, progress: Optional[Progress]) -> Picture: ...
def measure(home: Home, options: MeterOptions, progress: Optional[Progress]) -> MeterReport: ...
def optimise(
    home: _Text, study: _Text, folder: _Text, options: OptimiseOptions, progress: Optional[Progress]
) -> List[Tuple[str, Dict[str, float], int, float, List[str], Optional[float]]]: ...
def write(image: Bytes, file: _Text) -> None: ...
def run_program(words: Sequence[_Text]) -> int: ...
def supported_files() -> str: ...
def techniques() -> List[Tuple[str, str]]: ...
def qualities() -> List[Tuple[str, str]]: ...
def version() -> str: ...
def build_id() -> str: ...
def instruction_set() -> str: ...
