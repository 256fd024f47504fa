"""How light really falls in a home.

    import roomlight

    scene = roomlight.open("flat.sh3d")
    roomlight.render(scene).save("flat.png")

Units are metres, lux, and cd/m² for pixels in linear Rec.709. Axes are glTF's: x to the right, y up, z towards the
viewer. docs/use/python.md shows more.
"""

from . import _roomlight
from ._common import Progress
from ._errors import Error, InputError, Interrupted, OutOfMemory
from ._meters import Design, MeterReport, Meters, Readings, illuminance, measure, optimise
from ._pictures import (
    LayerInfo,
    Layers,
    Look,
    Picture,
    Renderer,
    View,
    open_layers,
    qualities,
    render,
    techniques,
    write,
)
from ._program import main
from ._scene import Camera, CameraInfo, LampInfo, Material, Mesh, RoomInfo, Scene, open, supported_files

__version__: str = _roomlight.version()


def build_id() -> str:
    """Which build of the library runs: hexadecimal digits. Builds differ in the last bits of a picture."""
    return _roomlight.build_id()


__all__ = [
    "Camera",
    "CameraInfo",
    "Design",
    "Error",
    "InputError",
    "Interrupted",
    "LampInfo",
    "LayerInfo",
    "Layers",
    "Look",
    "Material",
    "Mesh",
    "MeterReport",
    "Meters",
    "OutOfMemory",
    "Picture",
    "Progress",
    "Readings",
    "Renderer",
    "RoomInfo",
    "Scene",
    "View",
    "__version__",
    "build_id",
    "illuminance",
    "main",
    "measure",
    "open",
    "open_layers",
    "optimise",
    "qualities",
    "render",
    "supported_files",
    "techniques",
    "write",
]
