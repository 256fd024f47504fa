"""Pictures as arrays, without libraries of pictures."""
import zlib

import numpy


def read_png(file):
    """8-bit RGB or RGBA without interlacing, as the program writes it; height x width x 3."""
    data, at, packed = file.read_bytes(), 8, b""
    while at < len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, channels = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big"), {2: 3, 6: 4}[body[9]]
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    raw = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).reshape(height, 1 + width * channels)
    out, above = numpy.zeros((height, width, channels), numpy.uint8), numpy.zeros((width, channels), numpy.uint8)
    for y in range(height):
        kind, line = raw[y, 0], raw[y, 1:].reshape(width, channels)
        if kind == 0:
            row = line.copy()
        elif kind == 1:
            row = numpy.cumsum(line, axis=0, dtype=numpy.uint64).astype(numpy.uint8)
        elif kind == 2:
            row = line + above
        else:  # average and Paeth look at the pixel to the left, decoded
            row, left, corner = numpy.zeros_like(line), numpy.zeros(channels, numpy.int32), numpy.zeros(channels, numpy.int32)
            for x in range(width):
                up = above[x].astype(numpy.int32)
                if kind == 3:
                    guess = (left + up) // 2
                else:
                    p = left + up - corner
                    a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                    guess = numpy.where((a <= b) & (a <= c), left, numpy.where(b <= c, up, corner))
                left, corner = (line[x] + guess) & 255, up
                row[x] = left
        out[y] = above = row
    return out[:, :, :3]


def write_png(file, pixels):
    height, width = pixels.shape[:2]
    raw = numpy.concatenate([numpy.zeros((height, 1), numpy.uint8), pixels.reshape(height, -1)], axis=1).tobytes()
    chunk = lambda kind, body: len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")
    header = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 2, 0, 0, 0])
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 6)) + chunk(b"IEND", b""))
