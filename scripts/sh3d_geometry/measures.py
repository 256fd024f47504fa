"""What things of an OBJ file measure: the same as roomlight info --objects says of a home."""
import math
import re


def read_obj(path):
    """Triangles of each group "wall_3", "room_0", "piece_12": centimetres become metres."""
    corners, groups, current = [], {}, None
    with open(path) as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                corners.append(tuple(float(x) / 100 for x in words[1:4]))
            elif words[0] == "g":
                current = groups.setdefault(re.match(r"[a-z]+_\d+", words[1]).group(), [])
            elif words[0] == "f":
                at = [corners[int(w.split("/")[0]) - 1] for w in words[1:]]
                current += [(at[0], b, c) for b, c in zip(at[1:], at[2:])]
    return groups


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plane(normal, at):
    """A bin for a plane and the side that the normal looks to; as src/scene/object_measures.cpp has it."""
    x, y, z = normal
    sign = 1 if x > 1e-4 or (x > -1e-4 and (y > 1e-4 or (y > -1e-4 and z > 0))) else -1
    return tuple(math.floor(sign * v * 500 + 0.7371) for v in (x, y, z, dot(at, normal))), sign


def measure(triangles):
    origin, planes, total = triangles[0][0], {}, (0, 0, 0)
    out = {"areaM2": 0.0, "areaUpM2": 0.0, "areaDownM2": 0.0, "volumeM3": 0.0}
    for a, b, c in triangles:
        n = cross(minus(b, a), minus(c, a))
        twice = math.sqrt(dot(n, n))
        if twice == 0:
            continue
        out["areaM2"] += twice / 2
        if abs(n[1]) > 0.01 * twice:
            out["areaUpM2" if n[1] > 0 else "areaDownM2"] += twice / 2
        out["volumeM3"] += dot(minus(a, origin), n) / 6
        key, sign = plane(tuple(x / twice for x in n), minus(a, origin))
        planes[key] = planes.get(key, 0.0) + sign * twice / 2
        total = tuple(s + x / 2 for s, x in zip(total, n))
    out["netAreaM2"] = sum(map(abs, planes.values()))
    out["openM2"] = math.sqrt(dot(total, total))  # of a closed body none
    points = [p for t in triangles for p in t]
    out["boundsM"] = {"low": [min(p[i] for p in points) for i in range(3)], "high": [max(p[i] for p in points) for i in range(3)]}
    return out
