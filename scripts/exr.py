"""Reads the pictures that `roomlight render` writes as .exr."""
import re
import struct
import zlib

import numpy


def read_exr(file):
    """Channels of scan lines of ZIP-compressed 32-bit floats, and the string attributes."""
    data, at, header = file.read_bytes(), 8, {}
    while data[at]:
        end = data.index(0, at)
        kind = data.index(0, end + 1)
        size = struct.unpack_from("<i", data, kind + 1)[0]
        header[data[at:end].decode()] = data[kind + 5:kind + 5 + size]
        at = kind + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    names = [m.group(1).decode() for m in re.finditer(rb"([^\0]+)\0\x02\0\0\0.{12}", header["channels"], re.S)]
    width, height = x1 - x0 + 1, y1 - y0 + 1
    out = numpy.zeros((height, len(names), width), numpy.float32)
    blocks = (height + 15) // 16
    for offset in struct.unpack_from(f"<{blocks}Q", data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = min(16, height - (y - y0))
        raw, whole = data[offset + 8:offset + 8 + size], rows * len(names) * width * 4
        if size < whole:
            steps = numpy.frombuffer(zlib.decompress(raw), numpy.uint8).astype(numpy.int64)
            steps[1:] -= 128
            planes, half = numpy.cumsum(steps).astype(numpy.uint8), (whole + 1) // 2
            mixed = numpy.empty(whole, numpy.uint8)
            mixed[0::2], mixed[1::2] = planes[:half], planes[half:]
            raw = mixed.tobytes()
        out[y - y0:y - y0 + rows] = numpy.frombuffer(raw, "<f4").reshape(rows, len(names), width)
    return {name: out[:, i, :] for i, name in enumerate(names)}, header
