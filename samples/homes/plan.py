"""Rooms drawn along the middles of their walls become walls with thickness, joined at their ends, and the floors between them.
Plan coordinates are centimetres, x to the right and y down, as in Sweet Home 3D."""
from dataclasses import dataclass, field

OUTER, INNER = 30.0, 12.0


@dataclass
class Wall:
    start: tuple
    end: tuple
    thickness: float
    sides: list = field(default_factory=lambda: [None, None])  # room on the left and on the right, walking from start to end as seen on the plan
    doors: list = field(default_factory=list)                  # (middle along the wall from its start, width)
    at_start: int = -1
    at_end: int = -1

    @property
    def length(self):
        return abs(self.end[0] - self.start[0]) + abs(self.end[1] - self.start[1])

    @property
    def along(self):
        return ((self.end[0] - self.start[0]) / self.length, (self.end[1] - self.start[1]) / self.length)


def _edges(polygon):
    return list(zip(polygon, polygon[1:] + polygon[:1]))


def _between(p, a, b):
    """Whether p lies on the axis-parallel edge a-b, ends left out."""
    if a[0] == b[0]:
        return p[0] == a[0] and min(a[1], b[1]) < p[1] < max(a[1], b[1])
    return p[1] == a[1] and min(a[0], b[0]) < p[0] < max(a[0], b[0])


def _split(a, b, nodes):
    cuts = sorted((n for n in nodes if _between(n, a, b)), key=lambda n: abs(n[0] - a[0]) + abs(n[1] - a[1]))
    points = [a, *cuts, b]
    return list(zip(points, points[1:]))


def _is_left_turning(polygon):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in _edges(polygon)) < 0


def walls_of(rooms, openings):
    """Walls between rooms {name: polygon}; none along `openings`, pairs of points where one room flows into the next."""
    nodes = {p for polygon in rooms.values() for p in polygon} | {p for pair in openings for p in pair}
    found = {}
    for name, polygon in rooms.items():
        # Clockwise on the plan (y down), a room lies to the right of its edges.
        for a, b in _edges(polygon if not _is_left_turning(polygon) else polygon[::-1]):
            for piece in _split(a, b, nodes):
                key = tuple(sorted(piece))
                wall = found.setdefault(key, Wall(*key, INNER))
                wall.sides[1 if piece == key else 0] = name
    bare = {tuple(sorted(piece)) for a, b in openings for piece in _split(a, b, nodes)}
    walls = [w for key, w in found.items() if key not in bare]
    for w in walls:
        if None in w.sides:
            w.thickness = OUTER
    _join(walls)
    return walls


def _join(walls):
    """Of the ends that meet at a point those that go straight on are joined, else the two thickest; the others end inside these."""
    at = {}
    for i, w in enumerate(walls):
        at.setdefault(w.start, []).append((i, "at_start"))
        at.setdefault(w.end, []).append((i, "at_end"))
    kind = lambda end: (walls[end[0]].thickness, walls[end[0]].along[1] == 0)
    for ends in at.values():
        ends.sort(key=lambda end: -walls[end[0]].thickness)
        pairs = [(a, b) for k, a in enumerate(ends) for b in ends[k + 1:] if kind(a) == kind(b)] or ([tuple(ends[:2])] if len(ends) > 1 else [])
        for (i, end), (j, other) in pairs:
            setattr(walls[i], end, j)
            setattr(walls[j], other, i)


def floor_of(name, polygon, walls, openings):
    """The room's floor: up to the faces of its walls, and under its doors to their middle; where there is no wall, to the edge."""
    nodes = {p for w in walls for p in (w.start, w.end)} | {p for pair in openings for p in pair}
    by_key = {(w.start, w.end): w for w in walls}
    polygon = polygon if not _is_left_turning(polygon) else polygon[::-1]
    lines = []  # (start, direction, offset to the right, edge's wall) of every piece of the outline
    for a, b in _edges(polygon):
        for start, end in _split(a, b, nodes):
            wall = by_key.get(tuple(sorted((start, end))))
            size = abs(end[0] - start[0]) + abs(end[1] - start[1])
            lines.append((start, ((end[0] - start[0]) / size, (end[1] - start[1]) / size), wall.thickness / 2 if wall else 0.0, wall))
    points = []
    for (_, before, inset, _), (start, d, offset, wall) in zip(lines[-1:] + lines[:-1], lines):
        # Inwards is to the right of the way: (-dy, dx) with y down.
        corner = lambda o, dd: (-dd[1] * o, dd[0] * o)
        if before == d:
            points += [tuple(s + c for s, c in zip(start, corner(inset, d))), tuple(s + c for s, c in zip(start, corner(offset, d)))]
        else:
            u, v = corner(inset, before), corner(offset, d)
            points.append((start[0] + u[0] + v[0], start[1] + u[1] + v[1]))
        points += _notches(wall, d, offset)
    cleaned = [p for i, p in enumerate(points) if p != points[i - 1]]
    return cleaned


def _notches(wall, d, offset):
    if not wall:
        return []
    forward = wall.along == d
    out = []
    for middle, width in sorted(wall.doors, reverse=not forward):
        deep = offset if None in wall.sides else 0.0
        for along, inset in ((-width / 2, offset), (-width / 2, -deep), (width / 2, -deep), (width / 2, offset)):
            s = middle + (along if forward else -along)
            out.append((wall.start[0] + wall.along[0] * s - d[1] * inset, wall.start[1] + wall.along[1] * s + d[0] * inset))
    return out
