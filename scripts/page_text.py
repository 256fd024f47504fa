"""The home in a page by `roomlight bake` (docs/reference/baked.md)."""
import re
import zlib

import numpy

CHARACTERS = [c for c in range(1, 128) if c not in (ord("\r"), ord("<"))]


def bytes_of(text):
    """Bytes of text in base 125."""
    values = numpy.zeros(128, numpy.int64)
    values[CHARACTERS] = numpy.arange(125)
    digits = values[numpy.frombuffer(text.encode("ascii"), numpy.uint8)]
    whole = len(digits) // 7 * 7
    groups = digits[:whole].reshape(-1, 7) @ (125 ** numpy.arange(6, -1, -1))
    rows = (groups[:, None] >> numpy.arange(40, -1, -8)) & 255
    left = 0
    for digit in digits[whole:]:
        left = left * 125 + int(digit)
    return rows.astype(numpy.uint8).tobytes() + left.to_bytes(max(0, len(digits) - whole - 1), "big")


def glb_of(page):
    """The binary glTF file in a page, a path."""
    packed = re.search(rb'id="roomlight-home" data-bytes="\d+">([^<]*)<', page.read_bytes())[1]
    return zlib.decompress(bytes_of(packed.decode("ascii")))
