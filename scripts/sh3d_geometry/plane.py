"""Polygons of a plane, points as complex numbers: areas of what is inside some of them, by strips that no edge crosses within."""
import cmath
import math
import re


def polygon_area(ring):
    return sum((ring[i - 1].conjugate() * ring[i]).imag for i in range(len(ring))) / 2


def centroid(ring):
    total = sum((p := ring[i - 1], q := ring[i], (p.conjugate() * q).imag * (p + q))[2] for i in range(len(ring)))
    return total / (6 * polygon_area(ring))


def edges(shape):
    return [(ring[i - 1], ring[i]) for ring in shape for i in range(len(ring)) if ring[i - 1].real != ring[i].real]


def crossing(e, f):
    """x at which two edges cross, or None."""
    (a, b), (c, d) = e, f
    if max(a.real, b.real) < min(c.real, d.real) or max(c.real, d.real) < min(a.real, b.real):
        return None
    turn = ((b - a).conjugate() * (d - c)).imag
    if abs(turn) < 1e-12 * abs(b - a) * abs(d - c):
        return None
    t = ((c - a).conjugate() * (d - c)).imag / turn
    return (a + (b - a) * t).real if 0 <= t <= 1 else None


def area(shapes, inside):
    """Area where inside([bool, ...]) holds, one flag a shape: a shape is a list of rings by the even-odd rule. Exact but for rounding."""
    listed = [(e, k) for k, shape in enumerate(shapes) for e in edges(shape)]
    cuts = {p.real for e, _ in listed for p in e}
    for i, (e, _) in enumerate(listed):
        cuts.update(x for f, _ in listed[:i] if (x := crossing(e, f)) is not None)
    cuts, total = sorted(cuts), 0.0
    for low, high in zip(cuts, cuts[1:]):
        x = (low + high) / 2
        hits = sorted((a.imag + (b.imag - a.imag) * (x - a.real) / (b.real - a.real), k) for (a, b), k in listed if min(a.real, b.real) < x < max(a.real, b.real))
        flags = [False] * len(shapes)
        for (y, k), after in zip(hits, hits[1:] + [(0, 0)]):
            flags[k] = not flags[k]
            if inside(flags):
                total += (high - low) * (after[0] - y)
    return total


def arc(start, rx, ry, turn, large, sweep, end, steps=64):
    """SVG 2, appendix B.2.4: from end points to centre."""
    if not (rx and ry) or start == end:
        return [end]
    rotate = cmath.rect(1, turn)
    squash = lambda p: complex((p / rotate).real / rx, (p / rotate).imag / ry)  # to a plane where the ellipse is a unit circle
    a, b = squash(start), squash(end)
    half, middle = abs(b - a) / 2, (a + b) / 2
    scale = max(half, 1)
    height = math.sqrt(max(0.0, scale * scale - half * half))
    centre = middle + (1j if large != sweep else -1j) * (b - a) / abs(b - a) * height
    first, span = cmath.phase(a - centre), cmath.phase((b - centre) / (a - centre))
    if sweep and span < 0:
        span += 2 * math.pi
    if not sweep and span > 0:
        span -= 2 * math.pi
    out = []
    for i in range(1, steps + 1):
        p = centre + cmath.rect(scale, first + span * i / steps)
        out.append(complex(p.real * rx, p.imag * ry) * rotate)
    return out


def bezier(points, steps=32):
    out = []
    for i in range(1, steps + 1):
        left = points
        while len(left) > 1:
            left = [a + (b - a) * i / steps for a, b in zip(left, left[1:])]
        out.append(left[0])
    return out


def svg_path(text):
    """Rings of an SVG path, curves as chords."""
    rings, at, control, kind = [], 0j, None, "M"
    tokens = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", text)
    take = lambda: float(tokens.pop(0))
    while tokens:
        if tokens[0].isalpha():
            kind = tokens.pop(0)
        base = at if kind.islower() else 0j
        point = lambda: base + complex(take(), take())
        k, before, control = kind.upper(), control, None
        if k == "M":
            at = point()
            rings.append([at])
            kind = "l" if kind == "m" else "L"
            continue
        if k == "Z":
            at = rings[-1][0]
            continue
        if k == "L":
            new = [point()]
        elif k == "H":
            new = [complex(base.real + take(), at.imag)]
        elif k == "V":
            new = [complex(at.real, base.imag + take())]
        elif k in "CS":
            first = (2 * at - before if before is not None else at) if k == "S" else point()
            control, end = point(), point()
            new = bezier([at, first, control, end])
        elif k in "QT":
            control = (2 * at - before if before is not None else at) if k == "T" else point()
            new = bezier([at, control, point()])
        elif k == "A":
            rx, ry, turn, large, sweep = (take() for _ in range(5))
            new = arc(at, rx, ry, math.radians(turn), large, sweep, point())
        else:
            raise ValueError(f"path command {kind}")
        rings[-1] += new
        at = new[-1]
    return rings
