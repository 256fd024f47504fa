"""Reads pictures as `roomlight render` writes them in .exr, and writes plain ones."""
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


def write_exr(file, pixels):
    """height x width x 3, linear Rec.709, as 32-bit floats without compression."""
    height, width = pixels.shape[:2]
    attribute = lambda name, kind, body: name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(body)) + body
    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = 8 + 12 * width
    first = len(header) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + line * y for y in range(height)))
    rows = [struct.pack("<ii", y, 12 * width) + pixels[y, :, ::-1].T.astype("<f4").tobytes() for y in range(height)]
    file.write_bytes(header + offsets + b"".join(rows))
