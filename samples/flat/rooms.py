"""The shell of the flat: walls with openings, floors, ceiling, skirting, windows and doors. x right, y up, z into the flat from
the window front; metres.

    z=0 +----[==window==]----[==balcony==]----+------[==window==]---+
        | books              sofa  television |                     |
      [win]     table                         |       bed           |
        |                                    door                   |
        | hob, sink   fridge                  +-------------------+-+ z=4.1
    5.2 +--------------------+---[door]-------+ basin             |
                      | wardrobe    hall     door            tub [win]
                      +-----[entrance]--------+-------------------+ z=6.9
        x=0          3.7                     6.8                 9.7  10.9
"""
from openings import door, sill, window
from shapes import box, join

HEIGHT = 2.6
OUTER, INNER = 0.34, 0.10  # thickness of walls
LIVING_X, LIVING_Z = 6.8, 5.2
BED_X, BED_Z = (6.9, 10.9), 4.0
BATH_X, BATH_Z = (6.9, 9.7), (4.1, 6.9)
HALL_X, HALL_Z = (3.7, 6.8), (5.3, 6.9)

# Openings: from, to along the wall, lower and upper edge.
LIVING_WINDOW = (0.9, 3.1, 0.85, 2.32)
BALCONY = (4.15, 6.05, 0.03, 2.32)
WEST_WINDOW = (1.65, 3.05, 0.85, 2.32)
BED_WINDOW = (7.9, 9.9, 0.85, 2.32)
BATH_WINDOW = (5.25, 6.15, 1.38, 2.25)
BEDROOM_DOOR = (3.02, 3.88, 0, 2.05)
LIVING_DOOR = (5.00, 5.86, 0, 2.05)
BATH_DOOR = (5.75, 6.61, 0, 2.05)
ENTRANCE = (4.50, 5.42, 0, 2.10)
WAINSCOT = 1.25  # height of the tiles in the bathroom


def turned(parts, degrees, x, y, z):
    return [(m, s.turned(degrees).at(x, y, z)) for m, s in parts]


def wall(axis, at, low, high, thickness, openings=(), material="wall", height=HEIGHT, bottom=0.0):
    """Boxes along x (axis 0) or z (axis 2) from low to high. `at` is one face, `thickness` goes from there, signed."""
    parts = []

    def piece(a, b, y0, y1):
        if b - a < 1e-4 or y1 - y0 < 1e-4:
            return
        along, up, t = b - a, y1 - y0, abs(thickness)
        middle, across = (a + b) / 2, at + thickness / 2
        shape = box(along, up, t, 0.0005, grain=False) if axis == 0 else box(t, up, along, 0.0005, grain=False)
        shape.uv = shape.uv + [middle, (y0 + y1) / 2]
        parts.append((material, shape.at(middle, (y0 + y1) / 2, across) if axis == 0 else shape.at(across, (y0 + y1) / 2, middle)))

    x = low
    for a, b, y0, y1 in sorted(openings):
        piece(x, a, bottom, height)
        piece(a, b, bottom, min(y0, height))
        piece(a, b, max(y1, bottom), height)
        x = b
    piece(x, high, bottom, height)
    return parts


def skirting(axis, at, low, high, side, gaps=()):
    """A board with a thinner lip along a wall's face; side +1 or -1 is the direction into the room."""
    openings = [(a - 0.065, b + 0.065, 0, 0.10) for a, b in gaps]
    return wall(axis, at, low, high, 0.016 * side, openings, "skirting", 0.085) + wall(axis, at, low, high, 0.010 * side, openings, "skirting", 0.10, 0.085)


def slab(x0, x1, z0, z1, y0, y1, material):
    shape = box(x1 - x0, y1 - y0, z1 - z0, 0.0005, grain=False)
    shape.uv = shape.uv + [(x0 + x1) / 2, (z0 + z1) / 2]
    return [(material, shape.at((x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2))]


def walls():
    east, south = BED_X[1], HALL_Z[1]
    parts = wall(0, 0, -OUTER, east + OUTER, -OUTER, [LIVING_WINDOW, BALCONY, BED_WINDOW])
    parts += wall(2, 0, 0, LIVING_Z, -OUTER, [WEST_WINDOW]) + wall(0, LIVING_Z, -OUTER, HALL_X[0] - OUTER, OUTER)
    parts += wall(2, HALL_X[0], HALL_Z[0], south, -OUTER) + wall(0, south, HALL_X[0] - OUTER, BATH_X[1] + OUTER, OUTER, [ENTRANCE])
    parts += wall(2, BATH_X[1], BATH_Z[0], south, OUTER, [BATH_WINDOW]) + wall(0, BED_Z, BATH_X[1], east + OUTER, OUTER) + wall(2, east, 0, BED_Z, OUTER)
    parts += wall(2, LIVING_X, 0, south, INNER, [BEDROOM_DOOR, BATH_DOOR]) + wall(0, LIVING_Z, HALL_X[0] - OUTER, LIVING_X, INNER, [LIVING_DOOR]) + wall(0, BED_Z, BED_X[0], BATH_X[1], INNER)
    return parts + wall(2, east, 0, BED_Z, -0.004, (), "wall accent")


def bath_tiles():
    def lining(material, t, height, bottom=0.0):
        (x0, x1), (z0, z1) = BATH_X, BATH_Z
        below = [(BATH_DOOR[0] - 0.065, BATH_DOOR[1] + 0.065, 0, HEIGHT)]
        return (wall(0, z0, x0, x1, t, (), material, height, bottom) + wall(0, z1, x0, x1, -t, (), material, height, bottom)
                + wall(2, x0, z0, z1, t, below, material, height, bottom) + wall(2, x1, z0, z1, -t, (), material, height, bottom))
    return lining("bath tile", 0.010, WAINSCOT) + lining("oak", 0.018, WAINSCOT + 0.016, WAINSCOT)


def skirtings():
    (b0, b1), (h0, h1) = BED_X, HALL_X
    z0, z1 = HALL_Z
    living = skirting(0, 0, 0, LIVING_X, 1, [BALCONY[:2]]) + skirting(2, 0, 0, LIVING_Z, 1) + skirting(2, LIVING_X, 0, LIVING_Z, -1, [BEDROOM_DOOR[:2]]) + skirting(0, LIVING_Z, 3.7, LIVING_X, -1, [LIVING_DOOR[:2]])
    bedroom = skirting(0, 0, b0, b1, 1) + skirting(2, b0, 0, BED_Z, 1, [BEDROOM_DOOR[:2]]) + skirting(2, b1, 0, BED_Z, -1) + skirting(0, BED_Z, b0, b1, -1)
    hall = skirting(2, h0, z0, z1, 1) + skirting(0, z0, h0, h1, 1, [LIVING_DOOR[:2]]) + skirting(2, h1, z0, z1, -1, [BATH_DOOR[:2]]) + skirting(0, z1, h0, h1, -1, [ENTRANCE[:2]])
    return living + bedroom + hall


def windows():
    parts = []
    depth = 0.14  # from a window's plane to the inner face of its wall
    for (a, b, y0, y1), leaves in ((LIVING_WINDOW, 3), (BALCONY, 2), (BED_WINDOW, 2)):
        parts += turned(window(b - a, y1 - y0, leaves), 0, (a + b) / 2, y0, -depth)
        if y0 > 0.5:
            parts += turned(sill(b - a), 0, (a + b) / 2, y0, -depth + 0.03)
    for (a, b, y0, y1), leaves, turn, face, into in ((WEST_WINDOW, 2, 90, 0, 1), (BATH_WINDOW, 1, -90, BATH_X[1], -1)):
        parts += turned(window(b - a, y1 - y0, leaves), turn, face - into * depth, y0, (a + b) / 2)
        parts += turned(sill(b - a), turn, face - into * (depth - 0.03), y0, (a + b) / 2)
    return parts


def doors():
    middle = lambda opening: (opening[0] + opening[1]) / 2
    x, z = LIVING_X + INNER / 2, LIVING_Z + INNER / 2
    return (turned(door(thickness=INNER + 0.01, open_deg=68), 90, x, 0, middle(BEDROOM_DOOR)) + turned(door(thickness=INNER + 0.01, open_deg=78), 0, middle(LIVING_DOOR), 0, z)
            + turned(door(thickness=INNER + 0.01), -90, x, 0, middle(BATH_DOOR)) + turned(door(0.92, 2.10, INNER + 0.01), 180, middle(ENTRANCE), 0, HALL_Z[1] + 0.05))


def balcony():
    """A terrace slab before the balcony door, with a railing of thin bars."""
    x0, x1, z0, z1 = 3.5, LIVING_X + 0.1, -1.95, -OUTER
    parts = slab(x0, x1, z0, z1, -0.20, -0.02, "terrace")
    posts = [box(0.012, 0.98, 0.012, 0.002).at(x, 0.49, z0 + 0.05) for x in [x0 + 0.05 + 0.11 * k for k in range(int((x1 - x0 - 0.1) / 0.11) + 1)]]
    posts += [box(0.012, 0.98, 0.012, 0.002).at(x, 0.49, z0 + 0.05 + 0.11 * k) for x in (x0 + 0.05, x1 - 0.05) for k in range(1, 15)]
    rails = [box(x1 - x0 - 0.06, 0.035, 0.05, 0.006).at((x0 + x1) / 2, 0.99, z0 + 0.05), box(x1 - x0 - 0.06, 0.02, 0.03, 0.004).at((x0 + x1) / 2, 0.06, z0 + 0.05)]
    rails += [box(0.05, 0.035, z1 - z0, 0.006).at(x, 0.99, (z0 + z1) / 2) for x in (x0 + 0.05, x1 - 0.05)]
    return parts + [("black metal", join(*posts, *rails))]


def shell():
    """Everything that does not move, as (name, parts)."""
    south, bath_east, east = HALL_Z[1], BATH_X[1], BED_X[1]
    floors = (slab(-0.3, LIVING_X + 0.05, -0.3, LIVING_Z + 0.05, -0.1, 0, "floor oak") + slab(LIVING_X + 0.05, east + 0.3, -0.3, BED_Z + 0.05, -0.1, 0, "floor oak")
              + slab(HALL_X[0] - 0.3, LIVING_X + 0.05, LIVING_Z + 0.05, south + 0.3, -0.1, 0, "floor oak") + slab(LIVING_X + 0.05, bath_east + 0.3, BED_Z + 0.05, south + 0.3, -0.1, 0, "bath floor"))
    ceilings = slab(-OUTER, east + OUTER, -OUTER, BED_Z + OUTER, HEIGHT, HEIGHT + 0.2, "ceiling") + slab(-OUTER, bath_east + OUTER, BED_Z + OUTER, south + OUTER, HEIGHT, HEIGHT + 0.2, "ceiling")
    return [("walls", walls()), ("bath tiles", bath_tiles()), ("floors", floors), ("ceilings", ceilings), ("skirting boards", skirtings()), ("windows", windows()), ("doors", doors()), ("balcony", balcony())]
