"""A home as its drawing says it: rooms, openings, furniture, lamps and views, level by level. Lengths are centimetres on the plan (x right,
y down), heights above the level's floor; light is in lumen and kelvin. `facing` is where a thing's front looks on the plan: N, E, S, W or degrees
clockwise from S, as Sweet Home 3D counts them."""
import calendar
import math
from dataclasses import dataclass, field

import plan

FACING = {"S": 0.0, "W": 90.0, "N": 180.0, "E": 270.0}
WALL_HEIGHT = 260.0


@dataclass
class Level:
    name: str
    elevation: float
    height: float
    slab: float
    rooms: dict = field(default_factory=dict)     # name: polygon
    looks: dict = field(default_factory=dict)     # name: {"floor", "walls", "ceiling"}: names of surfaces or colours
    openings: list = field(default_factory=list)
    walls: list = field(default_factory=list)


@dataclass
class Placed:
    piece: object
    name: str
    level: int
    x: float
    y: float
    elevation: float
    angle: float            # degrees
    width: float
    depth: float
    height: float
    colour: int | None = None
    materials: dict = field(default_factory=dict)
    mirrored: bool = False
    flux: float = 0         # lm, of a lamp
    kelvin: float = 2700

    def local(self, right, front):
        """Plan point that lies so far to the right of the middle, seen by who stands before the piece, and towards its front."""
        a = math.radians(self.angle)
        return (self.x + right * math.cos(a) - front * math.sin(a), self.y + right * math.sin(a) + front * math.cos(a))

    @property
    def top(self):
        return self.elevation + self.height * (self.piece.drop_on_top if self.piece.drop_on_top > 0 else 1)


@dataclass
class View:
    name: str
    x: float
    y: float
    z: float
    yaw: float
    pitch: float
    fov: float


class Home:
    """One home; `north` is the compass bearing of the plan's upper side in degrees, `day` the clock of its day light."""

    def __init__(self, name, title, pieces, north=0, latitude=48.14, longitude=11.58, zone="Europe/Berlin",
                 day=(2026, 5, 20, 15, 30), offset="+02:00"):
        self.name, self.title, self.pieces, self.north = name, title, pieces, north
        self.latitude, self.longitude, self.zone, self.day, self.offset = latitude, longitude, zone, day, offset
        self.facade, self.ground, self.wall_height = 0xE9E4DA, "grass", WALL_HEIGHT
        self.levels, self.placed, self.views = [Level("Ground floor", 0, WALL_HEIGHT, 0)], [], []

    def upstairs(self, name, elevation, slab=30):
        """Everything that follows stands on a new level."""
        self.levels.append(Level(name, elevation, self.wall_height, slab))

    @property
    def level(self):
        return self.levels[-1]

    # Rooms and walls

    def room(self, name, *corners, floor, walls=0xF4F1EA, ceiling=0xFAFAF8):
        """Two corners make a rectangle, more a polygon; along the middles of the walls."""
        if len(corners) == 2:
            (x0, y0), (x1, y1) = corners
            corners = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
        self.level.rooms[name] = [tuple(map(float, c)) for c in corners]
        self.level.looks[name] = {"floor": floor, "walls": walls, "ceiling": ceiling}

    def flows(self, a, b):
        """No wall between two rooms from a to b."""
        self.level.openings.append((tuple(map(float, a)), tuple(map(float, b))))

    def build(self):
        """Makes the level's walls; rooms come before, doors and windows after."""
        self.level.walls = plan.walls_of(self.level.rooms, self.level.openings)

    def _wall_at(self, x, y):
        def away(w):
            (x0, y0), (x1, y1) = sorted((w.start, w.end))
            return math.hypot(x - min(max(x, x0), x1), y - min(max(y, y0), y1))
        return min(self.level.walls, key=away)

    def opening(self, key, x, y, into, name=None, is_door=False, mirrored=False, width=None, height=None, elevation=None, colour=None):
        """A door or window in the nearest wall, its front towards room `into`; as deep as the wall needs."""
        piece = self.pieces[key]
        wall = self._wall_at(x, y)
        dx, dy = wall.along
        s = (x - wall.start[0]) * dx + (y - wall.start[1]) * dy
        right = wall.sides[1] == into
        front = (-dy, dx) if right else (dy, -dx)
        depth = wall.thickness / piece.door["thickness"]
        shift = (0.5 - piece.door["distance"] - piece.door["thickness"] / 2) * depth
        width = width or piece.width
        at = [wall.start[i] + (dx, dy)[i] * s + front[i] * shift for i in (0, 1)]
        angle = math.degrees(math.atan2(-front[0], front[1])) % 360
        if is_door:
            wall.doors.append((s, width))
        return self._add(Placed(piece, name or piece.name, len(self.levels) - 1, *at, piece.elevation if elevation is None else elevation,
                                angle, width, depth, height or piece.height, colour, mirrored=mirrored))

    def door(self, key, x, y, into, **more):
        return self.opening(key, x, y, into, is_door=True, **more)

    def window(self, key, x, y, into, **more):
        return self.opening(key, x, y, into, **more)

    # Furniture

    def put(self, key, x, y, facing="S", **more):
        """The middle of the piece at (x, y)."""
        return self._put(key, (x, y), facing, (0, 0), more)

    def stand(self, key, x, y, facing="S", **more):
        """The middle of the piece's back at (x, y): against a wall."""
        return self._put(key, (x, y), facing, (0, 0.5), more)

    def on(self, under, key, right=0, front=0, facing=None, **more):
        """On top of another piece, so far from its middle."""
        x, y = under.local(right, front)
        more.setdefault("elevation", under.top)
        return self._put(key, (x, y), under.angle if facing is None else facing, (0, 0), more)

    def lamp(self, placed, name, flux, kelvin=2700):
        placed.name, placed.flux, placed.kelvin = name, flux, kelvin
        return placed

    def ceiling(self, key, x, y, name, flux, kelvin=2700, facing="S", **more):
        """A lamp that hangs from the ceiling."""
        height = more.get("height", self.pieces[key].height)
        return self.lamp(self.put(key, x, y, facing, elevation=self.wall_height - height, **more), name, flux, kelvin)

    def _put(self, key, at, facing, back, more):
        piece = self.pieces[key]
        scale = more.pop("scale", 1)
        width, depth, height = (more.pop(k, None) or getattr(piece, k) * scale for k in ("width", "depth", "height"))
        angle = FACING.get(facing, facing) % 360
        a = math.radians(angle)
        x, y = at[0] - back[1] * depth * math.sin(a), at[1] + back[1] * depth * math.cos(a)
        elevation = more.pop("elevation", None)
        return self._add(Placed(piece, more.pop("name", piece.name), len(self.levels) - 1, x, y,
                                piece.elevation if elevation is None else elevation, angle, width, depth, height, **more))

    def _add(self, placed):
        self.placed.append(placed)
        return placed

    # Views and light

    def view(self, name, eye, towards, fov=63):
        """Eyes at (x, y, height above this level's floor) look at such a point; `fov` is that of the picture's width in degrees."""
        dx, dy, dz = (t - e for t, e in zip(towards, eye))
        self.views.append(View(name, eye[0], eye[1], eye[2] + self.level.elevation, math.atan2(-dx, dy), math.atan2(-dz, math.hypot(dx, dy)),
                               math.radians(fov)))

    @property
    def time_ms(self):
        """The clock on the wall as Sweet Home 3D stores it: as if it were UTC."""
        return calendar.timegm((*self.day, 0)) * 1000

    @property
    def time_text(self):
        return "{:04}-{:02}-{:02}T{:02}:{:02}".format(*self.day) + self.offset

    def lamps(self):
        return [p for p in self.placed if p.flux > 0]

    def used_pieces(self):
        return {p.piece.key: p.piece for p in self.placed}
