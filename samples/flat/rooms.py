"""The shell of the flat: walls with openings, floors, ceilings, skirting, windows and doors. x right, y up, z into the flat from
the window front; metres.

    z=0 +-----[==window==]-----[=balcony=]--+-----[==window==]---+
        | dining               living       |                    |
    [win]                                   |      bedroom       |
        |                                  door                  |
        | kitchen run                       +--------------------+ z=4.0
    4.8 +----------------------[door]-------+      bath        [win]
                        | hall             door               |
                        +------[entrance]---+-----------------+ z=6.6
        x=0            3.9                 6.2               8.9  9.9
"""
from fittings import door, window
from shapes import box

HEIGHT = 2.6


def wall(axis, at, low, high, thickness, openings=(), material="wall", height=HEIGHT, bottom=0.0):
    """Boxes along x (axis 0) or z (axis 2) from low to high. `at` is the inner face, `thickness` goes from there, signed.
    openings: (from, to, bottom, top)."""
    parts = []

    def piece(a, b, y0, y1):
        if b - a < 1e-4 or y1 - y0 < 1e-4:
            return
        along, up, t = b - a, y1 - y0, abs(thickness)
        middle, across = (a + b) / 2, at + thickness / 2
        shape = box(along, up, t, 0.0005) if axis == 0 else box(t, up, along, 0.0005)
        shape.uv = shape.uv + [middle, (y0 + y1) / 2]
        parts.append((material, shape.at(middle, (y0 + y1) / 2, across) if axis == 0 else shape.at(across, (y0 + y1) / 2, middle)))

    x = low
    for a, b, y0, y1 in sorted(openings):
        piece(x, a, bottom, height)
        piece(a, b, bottom, min(y0, height))
        piece(a, b, y1, height)
        x = b
    piece(x, high, bottom, height)
    return parts


def skirting(axis, at, low, high, side, gaps=()):
    """A board along a wall's inner face; side +1 or -1 is the direction into the room."""
    return wall(axis, at, low, high, 0.014 * side, [(a, b, 0, 0.08) for a, b in gaps], "skirting", 0.08)


def turned(parts, degrees, x, y, z):
    return [(m, s.turned(degrees).at(x, y, z)) for m, s in parts]


LIVING_WINDOW = (0.9, 3.1, 0.85, 2.25)
BALCONY = (3.95, 5.75, 0.06, 2.25)
WEST_WINDOW = (1.4, 2.8, 0.85, 2.25)
BED_WINDOW = (7.2, 9.0, 0.85, 2.25)
BATH_WINDOW = (5.0, 5.7, 1.35, 2.15)
BEDROOM_DOOR = (3.02, 3.88, 0, 2.05)
HALL_DOOR = (4.72, 5.58, 0, 2.05)
BATH_DOOR = (5.42, 6.28, 0, 2.05)
ENTRANCE = (4.5, 5.4, 0, 2.08)


def shell():
    """Everything that does not move, as (name, parts)."""
    out = []
    outer = 0.32
    front = wall(0, 0, -outer, 6.2, -outer, [LIVING_WINDOW, BALCONY], "facade") + wall(0, 0, 6.2, 9.9 + outer, -outer, [BED_WINDOW], "facade")
    inner = wall(0, -0.002, 0, 6.2, 0.004, [LIVING_WINDOW, BALCONY]) + wall(0, -0.002, 6.3, 9.9, 0.004, [BED_WINDOW])
    west = wall(2, 0, 0, 4.9, -outer, [WEST_WINDOW]) + wall(0, 4.8, -outer, 3.8, 0.32, (), "wall")
    east = wall(2, 9.9, 0, 4.05, outer, (), "wall accent") + wall(0, 4.05, 8.9, 9.9 + outer, 0.3)
    bath = wall(2, 8.9, 4.1, 6.6, outer, [BATH_WINDOW]) + wall(0, 6.6, 3.6, 8.9 + outer, outer, [ENTRANCE]) + wall(2, 3.9, 4.9, 6.6, -0.3)
    between = wall(2, 6.2, 0, 4.8, 0.1, [BEDROOM_DOOR]) + wall(0, 4.8, 3.8, 6.2, 0.1, [HALL_DOOR]) + wall(2, 6.2, 4.8, 6.6, 0.1, [BATH_DOOR]) + wall(0, 4.0, 6.3, 9.9, 0.1)
    out.append(("walls", front + inner + west + east + bath + between))
    tiled = (wall(0, 4.1, 6.3, 8.9, 0.008, (), "bath wall", 2.1) + wall(0, 6.6, 6.3, 8.9, -0.008, (), "bath wall", 2.1)
             + wall(2, 6.3, 4.1, 6.6, 0.008, [BATH_DOOR], "bath wall", 2.1) + wall(2, 8.9, 4.1, 6.6, -0.008, [BATH_WINDOW], "bath wall", 2.1))
    out.append(("bath tiles", tiled))

    def slab(x0, x1, z0, z1, y, material, t):
        shape = box(x1 - x0, t, z1 - z0, 0.0005)
        shape.uv = shape.uv + [(x0 + x1) / 2, (z0 + z1) / 2]
        return (material, shape.at((x0 + x1) / 2, y, (z0 + z1) / 2))

    out.append(("floors", [slab(-0.3, 6.25, -0.3, 4.85, -0.05, "floor oak", 0.1), slab(6.25, 10.2, -0.3, 4.05, -0.05, "floor oak", 0.1),
                           slab(3.6, 6.25, 4.85, 6.9, -0.05, "floor oak", 0.1), slab(6.25, 9.2, 4.05, 6.9, -0.05, "bath floor", 0.1)]))
    out.append(("ceilings", [slab(-0.3, 10.2, -0.3, 6.9, HEIGHT + 0.1, "ceiling", 0.2)]))
    boards = (skirting(0, 0, 0, 6.2, 1, [BALCONY[:2]]) + skirting(2, 0, 0, 4.8, 1) + skirting(2, 6.2, 0, 4.8, -1, [(2.93, 3.97)]) + skirting(0, 4.8, 4.05, 6.2, -1, [(4.63, 5.67)])
              + skirting(0, 0, 6.3, 9.9, 1) + skirting(2, 6.3, 0, 4.0, 1, [(2.93, 3.97)]) + skirting(2, 9.9, 0, 4.0, -1) + skirting(0, 4.0, 6.3, 9.9, -1)
              + skirting(2, 3.9, 4.9, 6.6, 1) + skirting(0, 4.9, 3.9, 6.2, 1, [(4.63, 5.67)]) + skirting(2, 6.2, 4.9, 6.6, -1, [(5.33, 6.37)]) + skirting(0, 6.6, 3.9, 6.2, -1, [(4.41, 5.49)]))
    out.append(("skirting boards", boards))
    out.append(("windows", windows()))
    out.append(("doors", turned(door(open_deg=70), 90, 6.25, 0, 3.45) + turned(door(open_deg=0), 0, 5.15, 0, 4.85) + turned(door(open_deg=0), 90, 6.25, 0, 5.85)
                + turned(door(0.9, 2.08), 0, 4.95, 0, 6.66)))
    return out


def windows():
    """Frames and glass in the openings, sills inside."""
    parts = []
    for (a, b, y0, y1), leaves in ((LIVING_WINDOW, 3), (BALCONY, 2), (BED_WINDOW, 2)):
        parts += turned(window(b - a, y1 - y0, leaves), 0, (a + b) / 2, y0, -0.16)
        if y0 > 0.5:
            parts.append(("sill", box(b - a + 0.06, 0.025, 0.22, 0.006).at((a + b) / 2, y0 + 0.005, -0.01)))
    a, b, y0, y1 = WEST_WINDOW
    parts += turned(window(b - a, y1 - y0, 2), 90, -0.16, y0, (a + b) / 2)
    parts.append(("sill", box(0.22, 0.025, b - a + 0.06, 0.006).at(-0.01, y0 + 0.005, (a + b) / 2)))
    a, b, y0, y1 = BATH_WINDOW
    parts += turned(window(b - a, y1 - y0, 1), -90, 9.06, y0, (a + b) / 2)
    return parts
