"""Pieces of our own drawing that the catalogues lack: framed pictures and rugs, as OBJ with MTL and PNG."""
import functools
import zlib

import numpy as np

import surfaces  # noqa: F401  (puts samples/flat on the path)
import paintings
import textures as tx
from catalogue import Piece
from glb import png

RUGS = {
    "lattice": lambda rng: tx.rug(rng)[0],
    "wool": lambda rng: tx.boucle((206, 198, 184), rng)[0],
    "terracotta": lambda rng: tx.knit((176, 106, 78), rng)[0],
    "indigo": lambda rng: tx.knit((72, 84, 108), rng)[0],
}


class _Obj:
    def __init__(self, name):
        self.lines, self.points = [f"mtllib {name}.mtl"], 0

    def quad(self, material, corners, uv=((0, 0), (1, 0), (1, 1), (0, 1))):
        """Counter-clockwise as seen from its front."""
        self.lines.append(f"usemtl {material}")
        for (x, y, z), (u, v) in zip(corners, uv):
            self.lines += [f"v {x:.3f} {y:.3f} {z:.3f}", f"vt {u:.4f} {v:.4f}"]
        self.lines.append("f " + " ".join(f"{self.points + k}/{self.points + k}" for k in (1, 2, 3, 4)))
        self.points += 4

    def front(self, material, x, y, z):
        """A rectangle of half sizes x, y around the middle that looks to +z."""
        self.quad(material, ((-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)))

    def box(self, material, low, high, top=None):
        (x0, y0, z0), (x1, y1, z1) = low, high
        self.quad(material, ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)))
        self.quad(material, ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)))
        self.quad(material, ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)))
        self.quad(material, ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)))
        self.quad(material, ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)))
        self.quad(top or material, ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)))


def _piece(key, name, size, obj, colours, pixels):
    file = key.split(":")[1].replace(" ", "_")
    materials = "".join(f"newmtl {m}\nKd {r} {g} {b}\n" for m, (r, g, b) in colours.items())
    materials += f"newmtl painted\nKd 1 1 1\nmap_Kd {file}.png\n"
    picture = functools.cache(lambda: png(pixels()))
    files = lambda: {f"{file}.obj": ("\n".join(obj.lines) + "\n").encode(), f"{file}.mtl": materials.encode(), f"{file}.png": picture()}
    return Piece(key, "roomlight#" + file, name, "roomlight", "as roomlight", f"{file}.obj", *size, files=files, icon=picture)


def _picture(key, name, paint, width=50, height=70):
    x, y = width / 2, height / 2
    obj = _Obj(key.split(":")[1].replace(" ", "_"))
    obj.box("frame", (-x, -y, -1.2), (x, y, 1.2))
    obj.front("mount", x - 1.6, y - 1.6, 1.3)
    inner = min(x, y) - 6
    obj.front("painted", inner, inner, 1.4)
    return _piece(key, name, (width, 2.6, height), obj, {"frame": (0.16, 0.13, 0.11), "mount": (0.84, 0.83, 0.80)}, paint)


def _rug(key, paint):
    obj = _Obj(key.split(":")[1].replace(" ", "_"))
    obj.box("edge", (-100, 0, -70), (100, 1.2, 70), top="painted")
    return _piece(key, "Rug", (200, 140, 1.2), obj, {"edge": (0.5, 0.47, 0.42)}, paint)


def read():
    """All of them by name: own:picture hills, own:rug lattice..."""
    pieces = {}
    seeded = lambda paint, key: (lambda: paint(np.random.default_rng(zlib.crc32(key.encode()))))
    for name, paint in paintings.ALL.items():
        pieces[f"own:{name}"] = _picture(f"own:{name}", "Picture", seeded(paint, name))
    for name, paint in RUGS.items():
        pieces[f"own:rug {name}"] = _rug(f"own:rug {name}", seeded(paint, name))
    return pieces
