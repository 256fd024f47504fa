"""Homes: opened from files, or made of arrays."""

import json
import os
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _roomlight
from ._common import Path, Place, Vec3, file_name, filled, rows
from ._errors import InputError

Lighting = Union[Path, Mapping[str, Any]]


class CameraInfo(NamedTuple):
    """A camera of a scene."""

    name: str
    eye: Vec3  # m
    forward: Vec3  # unit
    is_proposed: bool  # by roomlight; else the file's


class RoomInfo(NamedTuple):
    """A room of a scene."""

    name: str
    use: str  # "living", "kitchen", ...; empty: not known
    floor: List[Tuple[float, float]]  # corners (x, z), m
    elevation: float  # m
    height: float  # m


class LampInfo(NamedTuple):
    """A lamp of a scene."""

    name: str
    position: Vec3  # m
    flux: float  # lm
    room: str  # empty: in none


@dataclass
class Mesh:
    """Triangles of one material.

    vertices: (n, 3), m. faces: (m, 3), numbers of vertices, counter-clockwise seen from the front. normals: (n, 3),
    unit; None: flat shading. uv: (n, 2), where (0, 0) is the texture's upper left corner. material: its number in
    `materials`.
    """

    vertices: npt.ArrayLike
    faces: npt.ArrayLike
    normals: Optional[npt.ArrayLike] = None
    uv: Optional[npt.ArrayLike] = None
    material: int = 0
    name: str = ""


@dataclass
class Material:
    """A metallic-roughness material as in glTF 2.0.

    colour: reflectance in linear Rec.709, 0 to 1. texture: number of a texture that multiplies it. transmission: of
    thin glass, 0 to 1. specular: of what smooth surfaces mirror, the share that this one does; 0: a Lambertian surface.
    emission: luminance in cd/m² per channel, or one number for white light. double_sided: whether
    both sides shine; every surface blocks light from both.
    """

    colour: Place = (0.8, 0.8, 0.8)
    texture: Optional[int] = None
    alpha: float = 1
    metallic: float = 0
    roughness: float = 1
    transmission: float = 0
    index_of_refraction: float = 1.5
    specular: float = 1
    emission: Union[float, Place] = (0, 0, 0)
    double_sided: bool = True
    name: str = ""


@dataclass
class Camera:
    """A camera at `eye` that looks at `target` (m). vertical_fov: full vertical angle in degrees."""

    eye: Place
    target: Place
    vertical_fov: float = 50
    name: str = ""


class Scene:
    """A home with its light. `roomlight.open` and `Scene.from_arrays` make scenes; they never change.

    Axes are glTF's: x to the right, y up, z towards the viewer. Lengths are in metres.
    """

    def __init__(self, home: _roomlight.Home) -> None:
        self._home = home

    @classmethod
    def from_arrays(
        cls,
        meshes: Sequence[object],
        *,
        materials: Sequence[Material] = (),
        textures: Sequence[npt.ArrayLike] = (),
        cameras: Sequence[Camera] = (),
        lighting: Optional[Lighting] = None,
        light: str = "auto",
        metres_per_unit: float = 1,
    ) -> "Scene":
        """Makes a scene of arrays, which are copied once.

        meshes: `Mesh` objects, dicts with the same keys, or meshes of trimesh (`vertices`, `faces`) or Open3D
        (`vertices`, `triangles`). Float32 vertices and uint32 faces in C order are read where they lie; arrays of
        other types are converted first. materials: empty: all is grey, with a reflectance of 0.8. textures: uint8
        arrays (h, w, 3) or (h, w, 4), sRGB, rows from the top. cameras: empty: views are proposed. lighting, light: as
        of `roomlight.open`. metres_per_unit: of vertices and cameras.
        """
        arrays = filled(
            _roomlight.HomeArrays(),
            meshes=[_mesh(m, i) for i, m in enumerate(meshes)],
            materials=[_material(m) for m in materials],
            textures=[_texture(t, i) for i, t in enumerate(textures)],
            cameras=[_camera(c, i) for i, c in enumerate(cameras)],
        )
        options = filled(
            _roomlight.OpenOptions(), lighting=_lighting(lighting), light=light, metres_per_unit=metres_per_unit
        )
        return cls(_roomlight.Home.from_arrays(arrays, options))

    @property
    def cameras(self) -> List[CameraInfo]:
        """Cameras of the file, then proposed ones."""
        return [CameraInfo(*c) for c in self._home.cameras()]

    @property
    def default_camera(self) -> str:
        """Name of the camera that `render` takes where none is named."""
        return self._home.default_camera()

    @property
    def rooms(self) -> List[RoomInfo]:
        """Rooms that the file names."""
        return [RoomInfo(*r) for r in self._home.rooms()]

    @property
    def lamps(self) -> List[LampInfo]:
        """Lamps, with their luminous flux in lm. The sun and the sky are none."""
        return [LampInfo(*l) for l in self._home.lamps()]

    @property
    def triangle_count(self) -> int:
        """Triangles, those of every copy counted."""
        return self._home.triangle_count()

    @property
    def bounds(self) -> Tuple[Vec3, Vec3]:
        """Least and greatest corner, m."""
        return self._home.bounds()

    @property
    def metres_per_unit(self) -> float:
        """Length of the file's unit in metres, as taken."""
        return self._home.metres_per_unit()

    @property
    def warnings(self) -> List[str]:
        """What is wrong with the files, a line each."""
        return self._home.warnings()

    @property
    def notes(self) -> List[str]:
        """What was guessed or added, a line each."""
        return self._home.notes()

    @property
    def added_lighting(self) -> Optional[Dict[str, Any]]:
        """The light that was added, as a lighting file (docs/reference/lighting.md); None: the scene had its own."""
        text = self._home.added_lighting()
        return json.loads(text) if text else None

    def __repr__(self) -> str:
        return f"<roomlight.Scene: {self.triangle_count} triangles, {len(self.lamps)} lamps>"


def open(
    file: Path,
    lighting: Optional[Lighting] = None,
    *,
    light: str = "auto",
    cameras: Sequence[Union[str, int]] = (),
    metres_per_unit: Optional[float] = None,
    up: Optional[str] = None,
    lumen_at_full_power: float = 1600,
) -> Scene:
    """Opens a home, a room or an object: .glb, .gltf, .obj, .sh3d and more (`roomlight.supported_files()`).

    lighting: a lighting file, or what one holds as a dict (docs/reference/lighting.md). light: of a home that
    `lighting` does not light: "auto" (the file's; where it has none, daylight and lamps are added), "day", "evening",
    "night", "none" or "file". cameras: names or numbers of those that pictures will be taken of, where light is added
    for them; ["all"]: views are proposed for every room. metres_per_unit, up ("y" or "z"): as the file says or as
    guessed, if not given. lumen_at_full_power: of lights of power 1 in Sweet Home 3D's files.
    """
    options = filled(
        _roomlight.OpenOptions(),
        lighting=_lighting(lighting),
        light=light,
        cameras=[str(c) for c in cameras],
        metres_per_unit=metres_per_unit,
        up=up,
        lumen_at_full_power=lumen_at_full_power,
    )
    return Scene(_roomlight.Home.open(file_name(file), options))


def supported_files() -> str:
    """File names that `open` knows, for people: ".glb, .gltf, ..."."""
    return _roomlight.supported_files()


def _lighting(lighting: Optional[Lighting]) -> Optional[bytes]:
    if lighting is None:
        return None
    if isinstance(lighting, Mapping):
        return json.dumps(lighting).encode()
    name = file_name(lighting)
    # A name that begins with a brace would be taken for the text of a lighting file.
    return os.path.join(b".", name) if name.startswith(b"{") else name


def _mesh(mesh: object, index: int) -> _roomlight.MeshArrays:
    if isinstance(mesh, Mapping):
        try:
            mesh = Mesh(**mesh)
        except TypeError as error:
            raise InputError(f"mesh {index}: {str(error).replace('Mesh.__init__() ', '')}") from None
    vertices = getattr(mesh, "vertices", None)
    faces = getattr(mesh, "faces", None)
    if faces is None:
        faces = getattr(mesh, "triangles", None)  # of Open3D
    if vertices is None or faces is None:
        raise InputError(f"mesh {index}: has no vertices and faces; give a roomlight.Mesh, or one of trimesh or Open3D")
    values = mesh if isinstance(mesh, Mesh) else Mesh(vertices, faces)
    name = values.name or f"mesh {index}"
    positions = rows(np.asarray(vertices), 3, f"{name}: vertices")
    return filled(
        _roomlight.MeshArrays(),
        name=name,
        vertices=positions,
        faces=_faces(np.asarray(faces), len(positions), name),
        normals=None if values.normals is None else rows(values.normals, 3, f"{name}: normals"),
        uv=None if values.uv is None else rows(values.uv, 2, f"{name}: uv"),
        material=values.material,
    )


def _faces(faces: npt.NDArray[Any], vertices: int, name: str) -> npt.NDArray[np.uint32]:
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise InputError(f"{name}: faces must have the shape (m, 3), and have {faces.shape}: three vertices a face")
    if not np.issubdtype(faces.dtype, np.integer):
        raise InputError(f"{name}: faces must be whole numbers, and are {faces.dtype}")
    if faces.size and (faces.min() < 0 or faces.max() >= vertices):
        wrong = int(faces.min()) if faces.min() < 0 else int(faces.max())
        raise InputError(f"{name}: faces name vertex {wrong}, and there are {vertices}, numbered from 0")
    return np.ascontiguousarray(faces, dtype=np.uint32)


def _material(m: Material) -> _roomlight.MaterialValues:
    emission = (float(m.emission),) * 3 if np.ndim(m.emission) == 0 else m.emission  # type: ignore[arg-type]
    return filled(
        _roomlight.MaterialValues(),
        name=m.name,
        colour=m.colour,
        texture=m.texture,
        alpha=m.alpha,
        metallic=m.metallic,
        roughness=m.roughness,
        transmission=m.transmission,
        index_of_refraction=m.index_of_refraction,
        specular=m.specular,
        emission=emission,
        double_sided=m.double_sided,
    )


def _camera(c: Camera, index: int) -> _roomlight.CameraValues:
    return filled(
        _roomlight.CameraValues(),
        name=c.name or f"camera {index}",
        eye=c.eye,
        target=c.target,
        vertical_fov=c.vertical_fov,
    )


def _texture(texture: npt.ArrayLike, index: int) -> npt.NDArray[np.uint8]:
    array = np.asarray(texture)
    if array.dtype != np.uint8 or array.ndim != 3 or array.shape[2] not in (3, 4):
        raise InputError(
            f"texture {index}: must be uint8 of the shape (h, w, 3) or (h, w, 4), and is {array.dtype} of {array.shape}"
        )
    if array.shape[2] == 3:
        opaque = np.full(array.shape[:2] + (1,), 255, np.uint8)
        array = np.concatenate([array, opaque], axis=2)
    return np.ascontiguousarray(array)
