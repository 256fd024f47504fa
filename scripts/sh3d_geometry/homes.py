"""Small homes of Sweet Home 3D, each for one kind of geometry: homes() gives {name: bytes of the .sh3d file}. Lengths are centimetres."""
import io
import math
import re
import zipfile
from xml.sax.saxutils import quoteattr


def element(kind, children="", **attributes):
    return f"<{kind} " + " ".join(f"{key}='{value}'" for key, value in attributes.items()) + f">{children}</{kind}>\n"


class Plan:
    """Collects the elements of one Home.xml. Walls are known by the number that wall() returns."""

    def __init__(self, **attributes):
        self.attributes = {"version": 7000, "wallHeight": 250, **attributes}
        self.levels, self.furniture, self.rooms, self.walls, self.models = [], [], [], [], {}

    def level(self, name, elevation, floor_thickness, height, **more):
        # Sweet Home 3D's order: an index among levels of the same elevation.
        self.levels.append(element("level", id=name, name=name, elevation=elevation, floorThickness=floor_thickness, height=height, elevationIndex=0, **more))

    def wall(self, x0, y0, x1, y1, thickness, boards="", **more):
        more.setdefault("height", self.attributes["wallHeight"])
        self.walls.append([dict(id=f"wall{len(self.walls)}", xStart=x0, yStart=y0, xEnd=x1, yEnd=y1, thickness=thickness, pattern="hatchUp", **more), boards])
        return len(self.walls) - 1

    def join(self, wall, at_start, other):
        self.walls[wall][0]["wallAtStart" if at_start else "wallAtEnd"] = f"wall{other}"

    def loop(self, points, thickness, **more):
        """Joined walls around a polygon; a thickness or one a wall."""
        n = len(points)
        widths = thickness if isinstance(thickness, list) else [thickness] * n
        made = [self.wall(*points[i], *points[(i + 1) % n], widths[i], **more) for i in range(n)]
        for i in range(n):
            self.join(made[i], True, made[i - 1])
            self.join(made[i], False, made[(i + 1) % n])
        return made

    def room(self, points, name, **more):
        more = {"floorColor": "FFC0C0C0", "ceilingColor": "FFFFFFFF", **more}
        self.rooms.append(element("room", "".join(element("point", x=x, y=y) for x, y in points), name=name, **more))

    def piece(self, kind, name, x, y, width, depth, height, model="", children="", **more):
        attributes = dict(name=name, x=x, y=y, width=width, depth=depth, height=height, **more)
        if model:
            attributes["model"] = model
        made = element(kind, children, **attributes)
        self.furniture.append(made)
        return made

    def file(self):
        walls = [element("wall", boards, **attributes) for attributes, boards in self.walls]
        xml = "<?xml version='1.0'?>\n" + element("home", "".join(["\n", *self.levels, *self.furniture, *walls, *self.rooms]), **self.attributes)
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("Home.xml", xml)
            for name, text in self.models.items():
                archive.writestr(name, text)
        return out.getvalue()


def box_obj(boxes):
    """OBJ text of boxes (group, lowest corner, highest corner)."""
    lines, count = [], 0
    for group, lo, hi in boxes:
        corners = [(x, y, z) for x in (lo[0], hi[0]) for y in (lo[1], hi[1]) for z in (lo[2], hi[2])]
        lines += [f"g {group}"] + [f"v {x} {y} {z}" for x, y, z in corners]
        for face in ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)):
            lines.append("f " + " ".join(str(count + i) for i in face))
        count += 8
    return "\n".join(lines) + "\n"


# A frame of 90 x 210 x 10 with a leaf, and one of a window with a pane; a body without any symmetry.
DOOR = box_obj([("left", (0, 0, 0), (5, 210, 10)), ("right", (85, 0, 0), (90, 210, 10)), ("lintel", (5, 205, 0), (85, 210, 10)), ("leaf", (5, 0, 3), (85, 205, 7))])
WINDOW = box_obj([("left", (0, 0, 0), (5, 100, 8)), ("right", (95, 0, 0), (100, 100, 8)), ("low", (5, 0, 0), (95, 5, 8)), ("high", (5, 95, 0), (95, 100, 8)),
                  ("sweethome3d_window_pane", (5, 5, 3.9), (95, 95, 4.1))])
BODY = box_obj([("foot", (0, 0, 0), (80, 10, 50)), ("post", (0, 10, 0), (12, 90, 20)), ("arm", (12, 70, 4), (60, 85, 16)), ("knob", (55, 10, 38), (75, 25, 48))])
HINGED = box_obj([("case", (0, 0, 0), (60, 4, 40)), ("case_back", (0, 4, 0), (60, 100, 3)), ("sweethome3d_opening_on_hinge_1", (0, 4, 37), (58, 98, 40)),
                  ("sweethome3d_hinge_1", (0, 4, 37.5), (1, 98, 38.5))])
FULL = "M0,0 v1 h1 v-1 z"
ROUND = "M0,0.5 A.5,.5 0 0 1 1,.5 a0.5 0.5 0 1 1 -1 0z"
ARCH = "M0,1 V0.4 C0,0.1 0.3,0 0.5,0 S1,0.1 1,0.4 V1 z"


def turned(points, angle, at=(0, 0)):
    c, s = math.cos(angle), math.sin(angle)
    return [(round(at[0] + x * c - y * s, 6), round(at[1] + x * s + y * c, 6)) for x, y in points]


def joints():
    """Corners of two walls at every angle and in all directions, thick on thin; T and X joints, three walls at one point."""
    plan = Plan()
    number = 0
    for degrees in (15, 30, 60, 90, 120, 150, 172, 210, 270, 330):
        for thick, thin in ((20, 20), (40, 8)):
            at = (600 * (number % 5), 600 * (number // 5))
            a = (at[0] + 200, at[1])
            b = turned([(200, 0)], math.radians(degrees), at)[0]
            first = plan.wall(*a, *at, thick) if number % 2 else plan.wall(*at, *a, thick)
            second = plan.wall(*b, *at, thin) if number % 4 > 1 else plan.wall(*at, *b, thin)
            plan.join(first, number % 2 == 0, second)
            plan.join(second, number % 4 <= 1, first)
            number += 1
    plan.loop(turned([(0, 0), (300, 0), (340, 260), (110, 330), (-60, 150)], 0.3, (100, 2700)), [20, 12, 35, 8, 25])
    t = plan.wall(900, 2700, 1300, 2700, 20)
    stem = plan.wall(1100, 2700, 1100, 3000, 12)
    plan.join(stem, True, t)
    plan.wall(1500, 2800, 1900, 2800, 20)
    plan.wall(1700, 2650, 1700, 3000, 10)
    arms = [plan.wall(2300, 2800, *turned([(180, 0)], math.radians(d), (2300, 2800))[0], 15) for d in (0, 130, 230)]
    for i in range(3):
        plan.join(arms[i], True, arms[(i + 1) % 3])
    return plan


def round_walls():
    """Arcs to either side, more than half a turn too, joined with each other and with straight walls, with doors and windows."""
    plan = Plan()
    for i, extent in enumerate((0.3, 1.2, math.pi / 2, math.pi, 4.4, -0.8, -2.2, -math.pi, -5)):
        plan.wall(600 * (i % 5), 900 * (i // 5), 600 * (i % 5) + 300, 900 * (i // 5) + 40, 10 + 4 * i, arcExtent=extent)
    d = plan.loop([(0, 2000), (400, 2000), (400, 2400), (0, 2400)], [20, 10, 30, 15])
    plan.walls[d[1]][0]["arcExtent"] = -1.2
    plan.walls[d[3]][0]["arcExtent"] = 0.9
    plan.wall(900, 2000, 1500, 2000, 20, arcExtent=1.4)
    plan.models["door.obj"] = DOOR
    sagitta = 300 / math.sin(0.7) * (1 - math.cos(0.7))
    plan.piece("doorOrWindow", "door", 1200, 2000 - sagitta, 90, 30, 210, "door.obj", cutOutShape=FULL, wallCutOutOnBothSides="true")
    plan.room([(0, 2000), (400, 2000), (400, 2400), (0, 2400)], "drum")
    return plan


def slopes():
    """Walls of two heights: gables, a shed roof, ceilings that follow them, an opening under a slope."""
    plan = Plan()
    west = plan.wall(0, 500, 0, 0, 20, height=180)
    north = plan.wall(0, 0, 300, 0, 20, height=180, heightAtEnd=330)
    north2 = plan.wall(300, 0, 600, 0, 20, height=330, heightAtEnd=180)
    east = plan.wall(600, 0, 600, 500, 20, height=180)
    south = plan.wall(600, 500, 0, 500, 30, height=180)
    ring = [west, north, north2, east, south]
    for i, wall in enumerate(ring):
        plan.join(wall, True, ring[i - 1])
        plan.join(wall, False, ring[(i + 1) % 5])
    plan.wall(0, 900, 400, 1100, 25, height=150, heightAtEnd=350, arcExtent=0.7)
    plan.room([(0, 0), (600, 0), (600, 500), (0, 500)], "attic")
    plan.room([(800, 0), (1200, 0), (1200, 300), (800, 300)], "terrace", ceilingVisible="false")
    shed = plan.loop([(1400, 0), (1800, 0), (1800, 300), (1400, 300)], 12)
    for wall, (start, end) in zip(shed, ((200, 200), (200, 310), (310, 310), (310, 200))):
        plan.walls[wall][0].update(height=start, heightAtEnd=end)
    plan.room([(1406, 6), (1794, 6), (1794, 294), (1406, 294)], "shed")
    plan.models["window.obj"] = WINDOW
    plan.piece("doorOrWindow", "gable window", 300, 0, 120, 20, 120, "window.obj", elevation=120, cutOutShape=FULL)
    plan.piece("doorOrWindow", "under the slope", 130, 0, 100, 20, 160, "window.obj", elevation=80, cutOutShape=FULL)
    return plan


def openings():
    """Doors and windows of every shape and place."""
    plan = Plan()
    plan.models.update({"door.obj": DOOR, "window.obj": WINDOW})

    def straight(row, length=700, thickness=20):
        plan.wall(0, 300 * row, length, 300 * row, thickness)
        return 300 * row

    y = straight(0)
    plan.piece("doorOrWindow", "door", 100, y, 90, 20, 210, "door.obj", cutOutShape=FULL)
    plan.piece("doorOrWindow", "window", 260, y, 120, 20, 100, "window.obj", elevation=90, cutOutShape=FULL)
    plan.piece("doorOrWindow", "turned", 420, y, 100, 20, 100, "window.obj", elevation=80, angle=math.pi, cutOutShape=FULL)
    plan.piece("doorOrWindow", "no shape", 600, y, 100, 20, 100, "window.obj", elevation=80)
    y = straight(1, thickness=25)
    plan.piece("doorOrWindow", "round", 100, y, 100, 25, 100, "window.obj", elevation=90, cutOutShape=ROUND)
    plan.piece("doorOrWindow", "arch", 280, y, 90, 25, 210, "door.obj", cutOutShape=ARCH)
    plan.piece("doorOrWindow", "mirrored", 450, y, 90, 25, 180, "window.obj", elevation=30, modelMirrored="true", cutOutShape="M0,0 L1,.5 V1 H0 z")
    plan.piece("doorOrWindow", "turned arch", 600, y, 90, 25, 150, "window.obj", elevation=30, angle=math.pi, cutOutShape="M0,0 L1,.5 V1 H0 z")
    y = straight(2, thickness=30)
    plan.piece("doorOrWindow", "niche", 100, y + 13, 100, 20, 100, "window.obj", elevation=60, cutOutShape=FULL)
    plan.piece("doorOrWindow", "both sides", 260, y + 13, 100, 20, 100, "window.obj", elevation=60, cutOutShape=FULL, wallCutOutOnBothSides="true")
    plan.piece("doorOrWindow", "other side", 420, y - 13, 100, 20, 100, "window.obj", elevation=60, cutOutShape=FULL)
    plan.piece("doorOrWindow", "unbound", 580, y, 100, 30, 100, "window.obj", elevation=60, cutOutShape=FULL, boundToWall="false")
    y = straight(3)
    plan.piece("doorOrWindow", "part of it", 150, y, 200, 20, 200, "window.obj", cutOutShape=FULL, wallWidth=0.5, wallLeft=0.1, wallHeight=0.5, wallTop=0.2)
    plan.piece("doorOrWindow", "neighbour a", 350, y, 100, 20, 200, "door.obj", cutOutShape=FULL)
    plan.piece("doorOrWindow", "neighbour b", 450, y, 100, 20, 120, "window.obj", elevation=60, cutOutShape=FULL)
    plan.piece("doorOrWindow", "too high", 600, y, 100, 20, 150, "window.obj", elevation=180, cutOutShape=FULL)
    corner = plan.loop([(0, 1300), (500, 1300), (500, 1600), (0, 1600)], 20)
    plan.walls[corner[2]][0]["thickness"] = 12
    plan.piece("doorOrWindow", "by the corner", 435, 1300, 90, 20, 210, "door.obj", cutOutShape=FULL)
    plan.piece("doorOrWindow", "in the corner", 55, 1600, 90, 20, 210, "door.obj", cutOutShape=FULL)
    plan.piece("doorOrWindow", "east", 500, 1450, 90, 20, 210, "door.obj", angle=math.pi / 2, cutOutShape=FULL)
    plan.piece("doorOrWindow", "askew", 250, 1600, 90, 30, 210, "door.obj", angle=0.1, cutOutShape=FULL, wallCutOutOnBothSides="true")
    slant = turned([(0, 0), (500, 0), (250, 0)], 0.5, (900, 200))
    plan.wall(*slant[1], *slant[0], 30)
    plan.piece("doorOrWindow", "slanted", *slant[2], 100, 30, 100, "window.obj", elevation=80, angle=0.5, cutOutShape=ROUND)
    # Openings that reach over ends, which stand askew to them: walls a little turned, mitres of every angle.
    for row, degrees in enumerate((0.1, 2.5)):
        at = (1350, 700 + 200 * row)
        plan.wall(*turned([(-300, 0)], math.radians(degrees), at)[0], *at, 12)
        plan.piece("doorOrWindow", "over the end", at[0] + 20, at[1], 160, 20, 100, "window.obj", elevation=80, cutOutShape=FULL, wallCutOutOnBothSides="true")
    for column, degrees in enumerate((15, 80, 90)):
        at = (1800 + 500 * column, 700)
        mitre = [plan.wall(at[0] - 200, at[1], *at, 20), plan.wall(*at, *turned([(200, 0)], math.radians(degrees), at)[0], 20)]
        plan.join(mitre[0], False, mitre[1])
        plan.join(mitre[1], True, mitre[0])
        plan.piece("doorOrWindow", "over a mitre", at[0] - 65, at[1], 130, 20, 210, "door.obj", cutOutShape=FULL)
    # A door that only just stands in the end of a wall which runs up to it.
    plan.wall(1500, 1300, 2000, 1300, 12)
    plan.wall(1700, 1000, 1700, 1300, 12)
    plan.piece("doorOrWindow", "beside an end", 1650, 1300, 96, 28, 210, "door.obj", cutOutShape=FULL, wallCutOutOnBothSides="true")
    return plan


def odd():
    """Where Sweet Home 3D's own faces are no body's, or differ where nobody can see it: ODD says why, a wall each."""
    plan = Plan()
    plan.models["window.obj"] = WINDOW

    def case(row, *pieces, **more):
        plan.wall(0, 300 * row, 400, 300 * row, 30)
        for i, (x, depth, low, high) in enumerate(pieces):
            plan.piece("doorOrWindow", f"{row} {i}", x, 300 * row, 100, depth, high - low, "window.obj", elevation=low, cutOutShape=FULL, **more)

    case(0, (150, 30, 0, 200), (200, 30, 60, 180))
    case(1, (200, 20, 60, 160))
    case(2, (200, 60, 60, 160), angle=0.5)
    plan.loop([(600, 0), (1000, 0), (1000, 300), (600, 300)], 20)
    plan.piece("doorOrWindow", "corner", 955, 0, 90, 20, 200, "window.obj", cutOutShape=FULL)
    return plan


ODD = {"wall0": "Sweet Home 3D leaves the wall above two overlapping openings of different heights away",
       "wall1": "a piece inside the wall's thickness: Sweet Home 3D hollows the wall where nobody can see it",
       "wall2": "a piece that stands askew by half a radian: cut here where both sides are open, there as its box on the plan",
       "wall4": "a door in a corner cuts the mitre of the neighbour: there faces are missing (its area vectors do not add up to zero)"}


def levels():
    """A cellar, a ground floor and an upper one, with slabs, a stairwell, and a window each."""
    plan = Plan()
    plan.level("cellar", -260, 12, 240)
    plan.level("ground", 0, 20, 250)
    plan.level("upper", 270, 20, 230)
    plan.level("hidden", 540, 12, 250, viewable="false")
    plan.models.update({"window.obj": WINDOW, "body.obj": BODY})
    for name, height in (("cellar", 240), ("ground", 250), ("upper", 230), ("hidden", 250)):
        plan.loop([(0, 0), (600, 0), (600, 400), (0, 400)], 24, level=name, height=height)
        plan.room([(0, 0), (600, 0), (600, 400), (0, 400)], name, level=name)
        plan.piece("doorOrWindow", "window " + name, 300, 0, 100, 24, 100, "window.obj", level=name, elevation=90, cutOutShape=FULL)
    plan.piece("pieceOfFurniture", "stairs", 450, 200, 100, 250, 270, "body.obj", level="ground", staircaseCutOutShape="M0.1,0 H1 V1 H0.1 z")
    plan.piece("pieceOfFurniture", "turned stairs", 150, 200, 90, 240, 260, "body.obj", level="cellar", angle=0.4, modelMirrored="true", staircaseCutOutShape="M0,0.2 H1 V1 H0 z")
    plan.wall(300, 0, 300, 400, 10, level="upper", height=120)
    return plan


def rooms():
    """Concave rooms, rooms in rooms, overlaps, rooms that share walls, without floor or ceiling."""
    plan = Plan()
    plan.loop([(0, 0), (900, 0), (900, 500), (0, 500)], 20)
    plan.room([(0, 0), (900, 0), (900, 500), (0, 500)], "big")
    plan.room([(200, 100), (400, 100), (400, 300), (200, 300)], "in it")
    plan.room([(700, 300), (1000, 300), (1000, 600), (700, 600)], "across", ceilingVisible="false")
    plan.room([(0, 800), (500, 800), (500, 1100), (200, 1100), (200, 1300), (0, 1300)], "L")
    plan.room([(600, 800), (600, 1200), (1000, 1200), (1000, 1100), (700, 1100), (700, 900), (1000, 900), (1000, 800)], "C", floorVisible="false")
    plan.room(turned([(0, 0), (300, 30), (420, 250), (210, 160), (40, 330)], 0.7, (1500, 200)), "star", ceilingFlat="true")
    return plan


def baseboards():
    """Baseboards of several sizes around corners, along round walls, with doors and low windows in them."""
    def board(side, thickness, height):
        return element("baseboard", attribute=side + "SideBaseboard", thickness=thickness, height=height, color="FF804020")

    plan = Plan()
    plan.models.update({"door.obj": DOOR, "window.obj": WINDOW})
    plan.loop([(0, 0), (500, 0), (500, 400), (0, 400)], 20, boards=board("right", 2, 10))
    plan.piece("doorOrWindow", "door", 250, 0, 90, 20, 210, "door.obj", cutOutShape=FULL)
    plan.piece("doorOrWindow", "window", 500, 200, 100, 20, 120, "window.obj", elevation=60, angle=math.pi / 2, cutOutShape=FULL)
    plan.piece("doorOrWindow", "low window", 250, 400, 100, 20, 120, "window.obj", elevation=5, cutOutShape=FULL)
    plan.wall(900, 0, 1400, 0, 20, boards=board("left", 1, 7) + board("right", 3, 15))
    plan.wall(900, 300, 1400, 300, 20, boards=board("left", 1.5, 8) + board("right", 1.5, 8), arcExtent=0.9)
    plan.wall(900, 700, 1400, 750, 10, boards=board("left", 1, 7), height=6, heightAtEnd=200)
    return plan


def furniture():
    """A body without symmetry, turned, mirrored, tilted, stretched, on other heights, in groups; doors that stand open."""
    plan = Plan()
    plan.models.update({"body.obj": BODY, "hinged.obj": HINGED})
    plan.wall(-200, -200, 200, -200, 10)

    def body(name, i, j, **more):
        return plan.piece("pieceOfFurniture", name, 200 * i, 200 * j, 80, 50, 90, "body.obj", **more)

    body("plain", 0, 0)
    body("raised", 1, 0, elevation=45)
    body("turned", 2, 0, angle=0.6)
    body("mirrored", 3, 0, modelMirrored="true")
    body("turned mirror", 4, 0, angle=2.1, modelMirrored="true")
    body("pitched", 0, 1, pitch=0.3, depthInPlan=74.3, widthInPlan=80, heightInPlan=100.8)
    body("pitched and turned", 1, 1, pitch=-0.5, angle=0.8, elevation=20, depthInPlan=87, widthInPlan=80, heightInPlan=103)
    body("rolled", 2, 1, roll=0.4, depthInPlan=50, widthInPlan=108.7, heightInPlan=114)
    body("rolled mirror", 3, 1, roll=-0.4, angle=1, modelMirrored="true", depthInPlan=50, widthInPlan=108.7, heightInPlan=114)
    body("model turned", 4, 1, modelRotation="0 0 1 0 1 0 -1 0 0")
    body("model tipped", 0, 2, modelRotation="1 0 0 0 0 -1 0 1 0", angle=0.3)
    plan.piece("pieceOfFurniture", "stretched", 200, 400, 160, 20, 45, "body.obj", angle=-0.7)
    plan.piece("pieceOfFurniture", "hidden", 400, 400, 80, 50, 90, "body.obj", visible="false")
    c, s = math.cos(-1.1), math.sin(-1.1)
    opened = element("transformation", name="sweethome3d_hinge_1", matrix=f"{c} 0 {s} {0.0} 0 1 0 0 {-s} 0 {c} {0.0}")
    plan.piece("pieceOfFurniture", "open cupboard", 0, 600, 60, 40, 100, "hinged.obj", opened)
    inner = plan.piece("pieceOfFurniture", "in a group", 200, 600, 80, 50, 90, "body.obj", angle=0.6) + \
        plan.piece("pieceOfFurniture", "in it too", 320, 620, 80, 50, 45, "body.obj", elevation=30)
    del plan.furniture[-2:]
    plan.furniture.append(element("furnitureGroup", inner, name="group", x=260, y=610, width=200, depth=90, height=90))
    return plan


def catalogue(jar):
    """The furniture that Sweet Home 3D comes with, turned, mirrored and raised in turn; its doors and windows in a wall each."""
    folder = "com/eteks/sweethome3d/io/"
    plan = Plan()
    with zipfile.ZipFile(jar) as archive:
        properties = archive.read(folder + "DefaultFurnitureCatalog.properties").decode("latin-1")
        listed = {}
        for key, number, value in re.findall(r"^(\w+)#(\d+)=(.*)$", properties, re.MULTILINE):
            listed.setdefault(int(number), {})[key] = value.strip()
        for i, entry in sorted(listed.items()):
            path = entry["model"].lstrip("/")
            if entry.get("multiPartModel") == "true":
                parts = [name for name in archive.namelist() if name.startswith(path.rsplit("/", 1)[0] + "/") and not name.endswith("/")]
            else:
                parts = [path]
            for part in parts:
                plan.models[f"{i}/{part.rsplit('/', 1)[1]}"] = archive.read(part)
            x, y, angle = 500 * (i % 10), 500 * (i // 10), round(0.63 * (i % 10), 3)
            more = {"elevation": entry.get("elevation", 0), "angle": angle, "modelMirrored": "true" if i % 3 == 0 else "false"}
            if "modelRotation" in entry:
                more["modelRotation"] = entry["modelRotation"]
            size = [float(entry[key]) for key in ("width", "depth", "height")]
            door = entry["doorOrWindow"] == "true"
            if door:
                more["wallCutOutOnBothSides"] = "true"
                ends = turned([(-200, 0), (200, 0)], angle, (x, y))
                plan.wall(*ends[0], *ends[1], 25, height=320)
                more |= {"cutOutShape": entry["doorOrWindowCutOutShape"]} if "doorOrWindowCutOutShape" in entry else {}
            plan.piece("doorOrWindow" if door else "pieceOfFurniture", quoteattr(entry["name"])[1:-1].replace("'", "&apos;"), x, y, *size, f"{i}/{path.rsplit('/', 1)[1]}", **more)
    return plan.file()


def examples(jar):
    """The homes that Sweet Home 3D comes with: {name: bytes of the .sh3d file}. Their models and pictures get folders of their own, as it saves them."""
    folder, out = "com/eteks/sweethome3d/io/resources/", {}
    with zipfile.ZipFile(jar) as archive:
        names = archive.namelist()
        for file in (n for n in names if n.startswith(folder + "examples/") and n.endswith(".xml")):
            entries = {}

            def moved(match):
                place, name = match.group(2).lstrip("/").rsplit("/", 1)
                number = entries.setdefault((place, name), len(entries))
                return f"{match.group(1)}='{number}/{name}'"

            xml = re.sub(r"\b(model|icon|planIcon|image)='([^']+/[^']+)'", moved, archive.read(file).decode())
            packed = io.BytesIO()
            with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as home:
                home.writestr("Home.xml", xml)
                for (place, name), number in entries.items():
                    # A model in a folder of its own has parts beside it.
                    parts = [name] if place + "/" == folder else [n.rsplit("/", 1)[1] for n in names if n.rsplit("/", 1)[0] == place and not n.endswith("/")]
                    for part in parts:
                        home.writestr(f"{number}/{part}", archive.read(f"{place}/{part}"))
            out[file.rsplit("/", 1)[1][:-4]] = packed.getvalue()
    return out


MAKERS = {"odd": odd, "joints": joints, "round": round_walls, "slopes": slopes, "openings": openings, "levels": levels, "rooms": rooms,
          "baseboards": baseboards, "furniture": furniture}


def homes():
    return {name: maker().file() for name, maker in MAKERS.items()}
