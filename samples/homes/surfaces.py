"""What floors, walls and grounds look like: small pictures that tile, painted when a home is packed, with the size that one repetition covers."""
import pathlib
import sys
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "flat"))
import textures as tx
from glb import png
from materials import black_body

SIZE = 512


def grass(rng):
    field = tx.fractal((SIZE, SIZE), 40, 40, 4, rng)
    return tx.shaded((112, 124, 78), 0.16 * field + 0.08 * tx.fractal((SIZE, SIZE), 5, 5, 3, rng))


# name: (cm that one repetition covers, painter)
ALL = {
    "oak": (200, lambda rng: tx.wood((196, 164, 126), rng, SIZE * 2, boards=12, joints=True)[0]),
    "walnut": (200, lambda rng: tx.wood((128, 92, 66), rng, SIZE * 2, boards=12, joints=True)[0]),
    "pine": (180, lambda rng: tx.wood((216, 186, 142), rng, SIZE * 2, boards=10, joints=True)[0]),
    "white tiles": (100, lambda rng: tx.tiles((226, 226, 222), (176, 174, 168), rng)[0]),
    "metro tiles": (80, lambda rng: tx.tiles((232, 232, 226), (170, 168, 160), rng, columns=4, rows=8, offset=True)[0]),
    "slate tiles": (240, lambda rng: tx.tiles((112, 114, 116), (84, 84, 84), rng, variation=0.08)[0]),
    "sand tiles": (240, lambda rng: tx.tiles((202, 188, 166), (160, 148, 130), rng, variation=0.05)[0]),
    "terrazzo": (120, lambda rng: tx.stone((214, 208, 198), rng, chips=3)),
    "grey carpet": (60, lambda rng: tx.boucle((166, 162, 156), rng)[0]),
    "blue carpet": (60, lambda rng: tx.boucle((128, 142, 160), rng)[0]),
    "grass": (300, grass),
    "paving": (200, lambda rng: tx.tiles((172, 166, 156), (138, 132, 124), rng, columns=3, rows=3, variation=0.06)[0]),
}


def painted(name):
    """PNG of a surface; the same bytes every time."""
    return png(ALL[name][1](np.random.default_rng(zlib.crc32(name.encode()))))


def lamp_colour(kelvin):
    """A black body as sRGB 0xRRGGBB, its largest component 255."""
    c = black_body(kelvin)
    encoded = np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)
    r, g, b = (int(round(255 * v)) for v in encoded)
    return r << 16 | g << 8 | b
