#!/usr/bin/env python3
"""Areas of rooms and volumes of walls of a Sweet Home 3D home, from Home.xml by the rules in docs/reference/sh3d.md and nothing of the importer.

    scripts/sh3d_geometry/expected.py HOME.sh3d

Prints JSON: rooms with floorM2, ceilingM2 and undersideM2, walls with volumeM3 (its body without what openings take, and its baseboards), both in the
file's order, without those on levels that are not viewable."""
import cmath
import json
import math
import sys
import xml.etree.ElementTree
import zipfile

from plane import area, centroid, polygon_area, svg_path

PIECES = ("pieceOfFurniture", "doorOrWindow", "light", "shelfUnit")
REACH, THROUGH, DEGREE = 1.0, 400.0, math.radians(1)  # cm: openings that end this close to a side cut it; those of both sides go this far


class Home:
    def __init__(self, path):
        with zipfile.ZipFile(path) as archive:
            self.root = xml.etree.ElementTree.fromstring(archive.read("Home.xml"))
        self.levels = {e.get("id"): e for e in self.root.findall("level")}
        self.wall_height = number(self.root, "wallHeight", 250)
        self.walls = self.root.findall("wall")
        self.pieces = []
        self.unfold(self.root, None, True)

    def unfold(self, parent, level, shown):
        for e in parent:
            here = e.get("level", level)
            visible = shown and e.get("visible", "true") == "true" and self.shown(here)
            if e.tag == "furnitureGroup":
                self.unfold(e, here, visible)
            elif e.tag in PIECES:
                self.pieces.append((e, here, visible))

    def shown(self, level):
        return level is None or self.levels[level].get("viewable", "true") == "true"

    def elevation(self, level):
        return 0.0 if level is None else number(self.levels[level], "elevation")

    def slab(self, level):
        """Levels but the lowest stand on the slab of their floor."""
        lower = level is not None and any(number(l, "elevation") < self.elevation(level) for l in self.levels.values())
        return number(self.levels[level], "floorThickness") if lower else 0.0


def number(e, key, default=0.0):
    return float(e.get(key, default))


def plan(e, x="x", y="y"):
    return complex(number(e, x), number(e, y))


def board_thickness(wall, side):
    return sum(number(b, "thickness") for b in wall.findall(f"baseboard[@attribute='{side}SideBaseboard']"))


def has_length(wall):
    return abs(plan(wall, "xEnd", "yEnd") - plan(wall, "xStart", "yStart")) >= 1e-3


def sides(wall, with_boards):
    """The bare sides as polylines from start to end: left, right. y points down on the plan, so left is a turn by -90 degrees."""
    start, end, extent = plan(wall, "xStart", "yStart"), plan(wall, "xEnd", "yEnd"), number(wall, "arcExtent")
    left, right = (number(wall, "thickness") / 2 + (board_thickness(wall, side) if with_boards else 0) for side in ("left", "right"))
    along = (end - start) / abs(end - start)
    if abs(extent) < 1e-3:
        return [start - 1j * along * left, end - 1j * along * left], [start + 1j * along * right, end + 1j * along * right]
    # An inscribed angle of extent / 2 sees the chord: its radius, and a turn about the centre that takes start to end.
    centre = (end - start * cmath.rect(1, extent)) / (1 - cmath.rect(1, extent))
    spoke, sign = start - centre, math.copysign(1, extent)
    chords = max(2, math.ceil(abs(extent) / 0.01))
    turn = [cmath.rect(1, extent * i / chords) for i in range(chords + 1)]
    ring = lambda by: [centre + spoke / abs(spoke) * max(0.0, abs(spoke) + by) * t for t in turn]
    return ring(sign * left), ring(-sign * right)


def meeting(a, b, limit):
    """Where the lines through the last two points of two sides meet, if that is not too far from the first one's end."""
    (p, p1), (q, q1) = a[-1:-3:-1], b[-1:-3:-1]
    u, v = p1 - p, q1 - q
    cross = (u.conjugate() * v).imag
    if abs(cross) <= 1e-5 * abs(u) * abs(v):
        return p
    at = p + u * ((q - p).conjugate() * v).imag / cross
    return at if abs(at - p) <= limit else p


def outlines(home, with_boards=False):
    number_of = {w.get("id"): i for i, w in enumerate(home.walls)}
    bare = [sides(w, with_boards) if has_length(w) else None for w in home.walls]
    joined = [[list(side) for side in pair or ()] for pair in bare]
    for i, wall in enumerate(home.walls):
        for key, at in (("wallAtStart", 0), ("wallAtEnd", -1)):
            j = number_of.get(wall.get(key))
            if j is None or j == i or not bare[i] or not bare[j] or home.walls[j].get("level") != wall.get("level"):
                continue
            other = home.walls[j]
            starts, ends = other.get("wallAtStart") == wall.get("id"), other.get("wallAtEnd") == wall.get("id")
            here = plan(wall, "xStart", "yStart") if at == 0 else plan(wall, "xEnd", "yEnd")
            if starts and ends:
                starts = abs(plan(other, "xStart", "yStart") - here) <= abs(plan(other, "xEnd", "yEnd") - here)
            elif not (starts or ends):
                continue
            towards = lambda side, first: side[::-1] if first else side  # so that the joint comes last
            crossed = (at == 0) == starts
            for k in (0, 1):
                mine, theirs = towards(bare[i][k], at == 0), towards(bare[j][1 - k if crossed else k], starts)
                joined[i][k][at] = meeting(mine, theirs, 2 * number(wall, "thickness"))
    return joined


def openings(home):
    """Of doors and windows: direction of their width, range of depth, shape of (along, height), whether it is a box."""
    out = []
    for e, level, visible in home.pieces:
        if not visible or not (e.tag == "doorOrWindow" or e.get("doorOrWindow") == "true"):
            continue
        width, height, depth = number(e, "width"), number(e, "height"), number(e, "depth")
        along, at = cmath.rect(1, number(e, "angle")), plan(e)
        u, v = (at * along.conjugate()).real, (at * along.conjugate()).imag
        bottom = home.elevation(level) + number(e, "elevation")
        rings = svg_path(e.get("cutOutShape") or "M0,0 v1 h1 v-1 z")
        flip = e.get("modelMirrored") == "true"
        shape = [[complex(u + ((1 - p.real if flip else p.real) - 0.5) * width, bottom + (1 - p.imag) * height) for p in ring] for ring in rings]
        spans = [max(f(p) for r in shape for p in r) - min(f(p) for r in shape for p in r) for f in (lambda p: p.real, lambda p: p.imag)]
        box = abs(area([shape], any) - spans[0] * spans[1]) < 1e-6 * spans[0] * spans[1]
        out.append((along, v - depth / 2, v + depth / 2, shape, e.get("wallCutOutOnBothSides") == "true", box))
    return out


def across(shape, height):
    """Ranges of the shape at one height."""
    hits = []
    for ring in shape:
        for p, q in zip(ring, ring[1:] + ring[:1]):
            if (p.imag > height) != (q.imag > height):
                hits.append(p.real + (q.real - p.real) * (height - p.imag) / (q.imag - p.imag))
    return list(zip(sorted(hits)[::2], sorted(hits)[1::2]))


def plane_top(wall, floor, home):
    """Height of the wall's top at its start, and how it rises by length along its chord."""
    first = number(wall, "height", home.wall_height)
    last = number(wall, "heightAtEnd", first)
    return floor + first, (last - first) / abs(plan(wall, "xEnd", "yEnd") - plan(wall, "xStart", "yStart"))


def cuts_in(wall, ring, cuts, highest):
    """Those that take something from the wall: (direction, range of depth, shape)."""
    along = plan(wall, "xEnd", "yEnd") - plan(wall, "xStart", "yStart")
    along, straight, taken = along / abs(along), abs(number(wall, "arcExtent")) < 1e-3, []
    for direction, low, high, shape, both, box in cuts:
        stands_across, sine = straight and abs((along / direction).real) < 0.5, abs((along / direction).imag)
        if stands_across and not box:
            continue
        reach = 0.0 if stands_across else THROUGH if both and (not straight or sine < math.sin(DEGREE)) else REACH
        widths, depths = [(p / direction).real for p in ring], [(p / direction).imag for p in ring]
        ours = [p.real for r in shape for p in r]
        if low >= max(depths) - 1e-3 or high <= min(depths) + 1e-3 or min(ours) >= max(widths) - 1e-3 or max(ours) <= min(widths) + 1e-3:
            continue
        if min(p.imag for r in shape for p in r) < highest:
            # What ends farther inside stays a niche.
            taken.append((direction, low - reach if low - reach <= min(depths) else low, high + reach if high + reach >= max(depths) else high, shape))
    return taken


def body_volume(ring, base, first, slope, start, along, taken):
    """Of an upright body under a plane, in cm3: height `first` above `start`, rising by `slope` along `along`."""
    top = lambda p: first + slope * ((p - start) * along.conjugate()).real  # its mean is that of the centroid
    volume = abs(polygon_area(ring)) * (top(centroid(ring)) - base)
    if not taken:
        return volume
    tops, far = [top(p) for p in ring], 1e5
    stops = sorted({base, *tops, *(p.imag for cut in taken for r in cut[3] for p in r if base < p.imag < max(tops))})

    def slice_area(height):
        shapes = [[ring]]
        for direction, low, high, shape in taken:
            shapes.append([[direction * p for p in (complex(a, low), complex(b, low), complex(b, high), complex(a, high))] for a, b in across(shape, height)])
        below = [[complex(-far, -far), complex(far, -far), complex(far, far), complex(-far, far)]]
        if abs(slope) > 1e-9:  # where the top is higher than this
            edge, out = start + along * (height - first) / slope, along * math.copysign(far, slope)
            below = [[edge - 1j * out, edge + 1j * out, edge + 1j * out + out, edge - 1j * out + out]]
        return area([*shapes, below], lambda inside: inside[0] and inside[-1] and any(inside[1:-1]))

    for low, high in zip(stops, stops[1:]):
        if high - low > 1e-6:  # Simpson's rule: exact for the second powers of height that come about
            step = (high - low) * 1e-9
            volume -= (high - low) / 6 * (slice_area(low + step) + 4 * slice_area((low + high) / 2) + slice_area(high - step))
    return volume


def wall_volume(home, wall, outline, boards, cuts):
    """Of the wall and its baseboards, m3."""
    ring = outline[0] + outline[1][::-1]
    floor = home.elevation(wall.get("level"))
    start, end = plan(wall, "xStart", "yStart"), plan(wall, "xEnd", "yEnd")
    along, (first, slope) = (end - start) / abs(end - start), plane_top(wall, floor, home)
    taken = cuts_in(wall, ring, cuts, max(first, first + slope * abs(end - start)))
    volume = body_volume(ring, floor - home.slab(wall.get("level")), first, slope, start, along, taken)
    for k, name in enumerate(("leftSideBaseboard", "rightSideBaseboard")):
        for board in wall.findall(f"baseboard[@attribute='{name}']"):
            deeper = 2 * number(board, "thickness")
            # Between each two corners it is as high as the wall allows there.
            for i in range(len(outline[k]) - 1):
                strip = [outline[k][i], outline[k][i + 1], boards[k][i + 1], boards[k][i]]
                wall_tops = [first + slope * ((p - start) * along.conjugate()).real for p in strip[:2]]
                height = min(floor + number(board, "height"), *wall_tops)
                volume += body_volume(strip, floor, height, 0.0, start, along, [(d, low - deeper, high + deeper, shape) for d, low, high, shape in taken])
    return volume / 1e6


def ring_of(room):
    return [plan(p) for p in room.findall("point")]


def stairwell(piece):
    e = piece[0]
    turn = cmath.rect(1, number(e, "angle"))
    flip = e.get("modelMirrored") == "true"
    return [[plan(e) + turn * complex(((1 - p.real if flip else p.real) - 0.5) * number(e, "width"), (p.imag - 0.5) * number(e, "depth")) for p in ring]
            for ring in svg_path(e.get("staircaseCutOutShape"))]


def top_of(home, room):
    """Of a level ceiling."""
    level = room.get("level")
    return home.elevation(level) + number(home.levels[level], "height") if level is not None else home.wall_height


def level_walls(home, level):
    """Whether all walls of a level are as high."""
    tops = {h for w in home.walls if w.get("level") == level for h in (number(w, "height", home.wall_height), number(w, "heightAtEnd", number(w, "height", home.wall_height)))}
    return len(tops) < 2


def rooms(home):
    """Floors and ceilings; ceilings as seen from above, as those under a slope are larger than that."""
    listed = [r for r in home.root.findall("room") if home.shown(r.get("level")) and abs(polygon_area(ring_of(r))) >= 1]
    stairs = [p for p in home.pieces if p[2] and p[0].get("staircaseCutOutShape")]
    out = []
    for i, room in enumerate(listed):
        level = room.get("level")
        floor = home.elevation(level)
        ceiling = top_of(home, room)
        # Under a slope a ceiling is larger than its plan: those of the highest level, unless they are flat.
        highest = all(home.elevation(l) <= floor + 1e-3 for l in home.levels if home.shown(l))
        entry = {"name": room.get("name") or "room", "flat": room.get("ceilingFlat") == "true" or not highest or level_walls(home, level)}
        for key, height in (("floor", floor), ("ceiling", ceiling)):
            shapes = [[ring_of(room)]]
            for other in listed[i + 1:]:
                if other.get("level") == level and other.get(key + "Visible", "true") == "true":
                    shapes.append([ring_of(other)])
            for piece in stairs:
                bottom = home.elevation(piece[1]) + number(piece[0], "elevation")
                if bottom < height - 1e-3 <= bottom + number(piece[0], "height"):
                    shapes.append(stairwell(piece))
            shown = room.get(key + "Visible", "true") == "true"
            entry[key + "M2"] = area(shapes, lambda inside: inside[0] and not any(inside[1:])) / 1e4 if shown else 0.0
            if key == "floor":  # of its slab what no ceiling of a lower room hides
                bottom = floor - home.slab(level)
                low = [[ring_of(r)] for r in listed if r.get("ceilingVisible", "true") == "true" and abs(top_of(home, r) - bottom) < 1e-3]
                seen = shown and home.slab(level) > 0
                entry["undersideM2"] = area(shapes + low, lambda inside: inside[0] and not any(inside[1:])) / 1e4 if seen else 0.0
        out.append(entry)
    return out


def expected(path):
    home = Home(path)
    cuts = openings(home)
    walls = [{"name": w.get("id"), "volumeM3": wall_volume(home, w, o, b, cuts) if o else 0.0} for w, o, b in zip(home.walls, outlines(home), outlines(home, True)) if home.shown(w.get("level"))]
    return {"rooms": rooms(home), "walls": walls}


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    json.dump(expected(sys.argv[1]), sys.stdout, indent=1)
    print()
