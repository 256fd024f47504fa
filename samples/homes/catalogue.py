"""Furniture of Debian's package sweethome3d-furniture: what its catalogues (.sh3f, zip files with PluginFurnitureCatalog.properties) say of
each piece, and the files of its model. Lengths are centimetres; those of doors, sashes and light sources become shares of the piece, as homes
hold them. Pieces are named library:model, as in "scopia:ficus"."""
import math
import pathlib
import posixpath
import re
import zipfile
from dataclasses import dataclass, field

FOLDER = pathlib.Path("/usr/share/sweethome3d/furniture")
LIBRARIES = {"scopia": "Scopia", "cc0": "BlendSwap-CC-0", "ccby": "BlendSwap-CC-BY", "kator": "KatorLegaz"}
# As the package's copyright file has them.
LICENCES = {"scopia": "CC-BY-3.0", "cc0": "CC0", "ccby": "CC-BY-3.0", "kator": "CC-BY-3.0-US"}


@dataclass
class Piece:
    key: str
    catalogue_id: str
    name: str
    creator: str
    licence: str
    model: str                 # file name of the .obj
    width: float
    depth: float
    height: float
    elevation: float = 0
    drop_on_top: float = -1    # of the height: where things stand on it; below 0: nowhere
    rotation: str = ""
    stairs: str = ""           # SVG path of the hole that stairs need
    door: dict | None = None
    lights: list = field(default_factory=list)
    files: object = dict       # function that returns the model's files, {name: bytes}
    icon: object = bytes       # function that returns a PNG


def _numbers(text):
    return [float(word) for word in text.split()]


def _door(p, width, depth):
    if p.get("doorOrWindow") != "true":
        return None
    columns = [_numbers(p.get("doorOrWindowSash" + key, "")) for key in ("XAxis", "YAxis", "Width", "StartAngle", "EndAngle")]
    sashes = [(x / width, y / depth, w / width, math.radians(a), math.radians(b)) for x, y, w, a, b in zip(*columns)]
    return {"shape": p.get("doorOrWindowCutOutShape", ""), "sashes": sashes,
            "thickness": float(p.get("doorOrWindowWallThickness", depth)) / depth, "distance": float(p.get("doorOrWindowWallDistance", 0)) / depth}


def _lights(p, width, depth, height):
    columns = [_numbers(p.get("lightSource" + key, "")) for key in ("X", "Y", "Z")]
    diameters = _numbers(p.get("lightSourceDiameter", "")) or [0.0] * len(columns[0])
    return [(x / width, y / depth, z / height, d / width) for x, y, z, d in zip(*columns, diameters)]


def _piece(library, p, archive, names):
    width, depth, height = (float(p[key]) for key in ("width", "depth", "height"))
    model = p["model"].lstrip("/")
    folder = posixpath.dirname(model) + "/"
    piece = Piece(f"{library}:{p['id'].split('#')[1]}", p["id"], p["name"], p.get("creator", "unknown"), LICENCES[library],
                  posixpath.basename(model), width, depth, height, float(p.get("elevation", 0)))
    top = float(p.get("dropOnTopElevation", height))
    piece.drop_on_top = top / height if top >= 0 else -1
    piece.rotation, piece.stairs = p.get("modelRotation", ""), p.get("staircaseCutOutShape", "")
    piece.door, piece.lights = _door(p, width, depth), _lights(p, width, depth, height)
    piece.files = lambda: {name[len(folder):]: archive.read(name) for name in names if name.startswith(folder) and not name.endswith("/")}
    piece.icon = lambda: archive.read(p["icon"].lstrip("/"))
    return piece


def read(folder=FOLDER):
    """All pieces by name. FileNotFoundError where the package is not installed."""
    pieces = {}
    for library, file in LIBRARIES.items():
        archive = zipfile.ZipFile(folder / f"{file}.sh3f")
        names = archive.namelist()
        text = re.sub(r"\\\r?\n\s*", "", archive.read("PluginFurnitureCatalog.properties").decode("latin-1"))
        found = {}
        for key, number, value in re.findall(r"^([A-Za-z]+)#(\d+)\s*=(.*)$", text, re.M):
            found.setdefault(int(number), {})[key] = value.strip()
        for number in sorted(found):
            piece = _piece(library, found[number], archive, names)
            pieces[piece.key] = piece
    return pieces
