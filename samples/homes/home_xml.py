"""Home.xml as Sweet Home 3D 7 reads it, by the published SweetHome3D.dtd."""
import math
from xml.sax.saxutils import quoteattr

import plan
import surfaces

PHOTO = (1280, 720)
SKY = 0xCCE4FC


def _number(v):
    return f"{v:.6g}" if isinstance(v, float) else str(v)


def _open(kind, attributes, close=False):
    words = "".join(f" {key}={quoteattr(_number(v))}" for key, v in attributes.items() if v is not None)
    return f"<{kind}{words}{'/' if close else ''}>"


def _colour(rgb):
    return f"FF{rgb:06X}"


class Writer:
    """Collects lines; `entry` gives the archive's name of a surface's picture, `model` and `icon` those of a piece."""

    def __init__(self, home, entries):
        self.home, self.entries, self.lines = home, entries, ["<?xml version='1.0'?>"]

    def add(self, kind, attributes, children=()):
        if not children:
            self.lines.append(_open(kind, attributes, close=True))
            return
        self.lines.append(_open(kind, attributes))
        for child in children:
            self.add(*child)
        self.lines.append(f"</{kind}>")

    def text(self):
        h = self.home
        self.lines.append(_open("home", {"version": 7000, "name": f"{h.name}.sh3d", "camera": "observerCamera", "wallHeight": h.wall_height}))
        self.environment()
        self.add("compass", {"x": -300.0, "y": -300.0, "diameter": 100.0, "northDirection": math.radians((-h.north) % 360),
                             "longitude": math.radians(h.longitude), "latitude": math.radians(h.latitude), "timeZone": h.zone})
        self.cameras()
        if len(h.levels) > 1:
            for i, level in enumerate(h.levels):
                self.add("level", {"id": f"level-{i}", "name": level.name, "elevation": level.elevation, "floorThickness": level.slab,
                                   "height": level.height, "elevationIndex": i})
        for i, p in enumerate(h.placed):
            self.piece(i, p)
        for i, level in enumerate(h.levels):
            for k, wall in enumerate(level.walls):
                self.wall(i, k, level, wall)
        for i, level in enumerate(h.levels):
            for k, name in enumerate(level.rooms):
                self.room(i, k, level, name)
        self.lines.append("</home>")
        return "\n".join(self.lines) + "\n"

    def level_of(self, i):
        return f"level-{i}" if len(self.home.levels) > 1 else None

    def look(self, value, colour_key, use):
        """Attributes and children of a surface: the name of a painted one, or a colour."""
        if isinstance(value, int):
            return {colour_key: _colour(value)}, []
        size = float(surfaces.ALL[value][0])
        return {}, [("texture", {"attribute": use, "name": value, "width": size, "height": size, "image": self.entries[value]})]

    def environment(self):
        attributes, children = self.look(self.home.ground, "groundColor", "groundTexture")
        self.add("environment", {"groundColor": _colour(0x9AA480), **attributes, "skyColor": _colour(SKY), "lightColor": _colour(0xF0F0F0),
                                 "photoWidth": PHOTO[0], "photoHeight": PHOTO[1], "photoAspectRatio": "RATIO_16_9", "photoQuality": 2}, children)

    def cameras(self):
        h, first = self.home, self.home.views[0]
        points = [p for level in h.levels for polygon in level.rooms.values() for p in polygon]
        x, y = ((min(p[i] for p in points) + max(p[i] for p in points)) / 2 for i in (0, 1))
        self.camera("observerCamera", "observerCamera", None, first.x, first.y, first.z, first.yaw, first.pitch, first.fov)
        self.camera("camera", "topCamera", None, x, y + 1100.0, 1100.0, math.pi, math.pi / 4, math.radians(63))
        for view in h.views:
            self.camera("observerCamera", "storedCamera", view.name, view.x, view.y, view.z, view.yaw, view.pitch, view.fov)

    def camera(self, kind, use, name, x, y, z, yaw, pitch, fov):
        self.add(kind, {"attribute": use, "name": name, "lens": "PINHOLE", "x": float(x), "y": float(y), "z": float(z), "yaw": yaw, "pitch": pitch,
                        "fieldOfView": fov, "time": self.home.time_ms})

    def piece(self, i, p):
        kind = "doorOrWindow" if p.piece.door else "light" if p.piece.lights else "pieceOfFurniture"
        model, icon = self.entries[p.piece.key]
        a = {"id": f"{kind}-{i}", "level": self.level_of(p.level), "catalogId": p.piece.catalogue_id, "name": p.name, "creator": p.piece.creator,
             "model": model, "icon": icon, "x": p.x, "y": p.y, "elevation": float(p.elevation), "angle": math.radians(p.angle),
             "width": float(p.width), "depth": float(p.depth), "height": float(p.height), "dropOnTopElevation": float(p.piece.drop_on_top),
             "modelMirrored": "true" if p.mirrored else None, "modelRotation": p.piece.rotation or None,
             "color": None if p.colour is None else _colour(p.colour), "movable": "false" if p.piece.door else "true",
             "staircaseCutOutShape": p.piece.stairs or None}
        children = [("material", {"name": name, "color": _colour(rgb)}) for name, rgb in p.materials.items()]
        if p.piece.door:
            d = p.piece.door
            a |= {"wallThickness": d["thickness"], "wallDistance": d["distance"], "cutOutShape": d["shape"] or None, "wallCutOutOnBothSides": "true",
                  "boundToWall": "true"}
            children = [("sash", dict(zip(("xAxis", "yAxis", "width", "startAngle", "endAngle"), sash))) for sash in d["sashes"]] + children
        if kind == "light":
            a["power"] = p.flux / LUMEN_AT_FULL_POWER
            colour = _colour(surfaces.lamp_colour(p.kelvin))
            children = [("lightSource", {"x": x, "y": y, "z": z, "color": colour, "diameter": d or None}) for x, y, z, d in p.piece.lights] + children
        self.add(kind, a, children)

    def wall(self, i, k, level, wall):
        name = lambda n: f"wall-{i}-{n}"
        a = {"id": name(k), "level": self.level_of(i), "wallAtStart": name(wall.at_start) if wall.at_start >= 0 else None,
             "wallAtEnd": name(wall.at_end) if wall.at_end >= 0 else None, "xStart": wall.start[0], "yStart": wall.start[1], "xEnd": wall.end[0],
             "yEnd": wall.end[1], "height": level.height, "thickness": wall.thickness}
        children = []
        for side, room in zip(("left", "right"), wall.sides):
            look = level.looks[room]["walls"] if room else self.home.facade
            more, child = self.look(look, f"{side}SideColor", f"{side}SideTexture")
            a |= more
            children += child
        for side, room in zip(("left", "right"), wall.sides):
            if room and isinstance(level.looks[room]["walls"], int):
                children.append(("baseboard", {"attribute": f"{side}SideBaseboard", "thickness": 1.2, "height": 7.0, "color": _colour(0xF6F5F2)}))
        self.add("wall", a, children)

    def room(self, i, k, level, name):
        look = level.looks[name]
        points = plan.floor_of(name, level.rooms[name], level.walls, level.openings)
        floor, children = self.look(look["floor"], "floorColor", "floorTexture")
        a = {"id": f"room-{i}-{k}", "level": self.level_of(i), "name": name, "areaVisible": "true", **floor, "ceilingColor": _colour(look["ceiling"])}
        self.add("room", a, children + [("point", {"x": x, "y": y}) for x, y in points])


# `roomlight` takes power 1 for so much, unless told otherwise.
LUMEN_AT_FULL_POWER = 1600.0
