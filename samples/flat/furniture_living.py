"""Seating, storage and electronics of the living room. Every function of the furniture modules returns a list of (material,
Shape) that stands on y = 0 with its middle at the origin and its front towards +z."""
import numpy as np

from cloth import boxes_distance, cushion, drape, fabric, pillow
from shapes import bent, box, join, lathe, loft, quad, rounded_ring, tube


def placed(parts, x=0.0, y=0.0, z=0.0, turn=0.0):
    return [(m, s.turned(turn).at(x, y, z)) for m, s in parts]


def corners(dx, dz):
    return [(sx * dx, sz * dz) for sx in (-1, 1) for sz in (-1, 1)]


def turned_leg(x, z, height, top=0.018, foot=0.011, lean=0.0):
    """A tapered leg below (x, height, z) that leans outwards by `lean` metres."""
    return tube([(x, height, z), (x + np.sign(x) * lean, 0, z + np.sign(z) * lean)], [top, foot], 14)


def leaning(shape, back, turn, x, y, z):
    """A standing pillow tipped backwards and turned, its middle at (x, y, z)."""
    return shape.turned(-back, 0).turned(turn).at(x, y, z)


def sofa(width=2.45, depth=0.94):
    arm, seat_height = 0.13, 0.43
    inner = width - 2 * arm
    parts = [("black", join(*[tube([(x, 0.14, z), (x, 0, z)], [0.014, 0.012], 12) for x, z in corners(width / 2 - 0.14, depth / 2 - 0.10)])),
             ("sofa", box(width - 0.02, 0.15, depth - 0.02, 0.025).at(0, 0.20, 0)),
             ("sofa", box(inner, 0.52, 0.15, 0.055, bulge=(0, 0.01, 0.012), steps=6).turned(-7, 0).at(0, 0.49, -depth / 2 + 0.10))]
    for s in (-1, 1):
        parts.append(("sofa", box(arm, 0.46, depth, 0.055, bulge=(0.012, 0.008, 0.006), steps=7).at(s * (width - arm) / 2, 0.36, 0)))
    seat = inner / 2
    for k in range(2):
        x = (k - 0.5) * seat
        parts.append(("sofa", cushion(seat - 0.006, 0.74, 0.17, k, 0.06).at(x, seat_height - 0.075, 0.085)))
        parts.append(("sofa", leaning(pillow(seat - 0.01, 0.50, 0.24, 10 + k), 16, 0, x, seat_height + 0.235, -0.245)))
    parts += [("pillow rust", leaning(pillow(0.50, 0.50, 0.17, 21), 24, 16, -inner / 2 + 0.26, seat_height + 0.23, -0.05)),
              ("pillow cream", leaning(pillow(0.46, 0.46, 0.16, 22), 30, -4, -inner / 2 + 0.58, seat_height + 0.20, 0.00)),
              ("pillow ink", leaning(pillow(0.52, 0.36, 0.15, 23), 28, -17, inner / 2 - 0.28, seat_height + 0.17, -0.02))]
    body = boxes_distance([((s * (width - arm) / 2, 0.36, 0), (arm + 0.03, 0.48, depth + 0.02), 0.055) for s in (1,)]
                          + [((0, 0.235, 0.04), (inner, 0.42, depth - 0.04), 0.04), ((0, 0.49, -depth / 2 + 0.10), (inner, 0.52, 0.17), 0.055)])
    throw = drape(1.15, 0.52, body, (width / 2 - 0.18, 0.68, 0.12), 6, 0.03, 130, seed=4)
    parts.append(("throw", fabric(throw, 0.006, 2, 0.006)))
    return parts


def armchair():
    """A low easy chair: bent oak frame, loose cushions."""
    parts = []
    for s in (-1, 1):
        parts.append(("oak", tube([(s * 0.345, 0.56, 0.33), (s * 0.335, 0.30, 0.30), (s * 0.35, 0, 0.35)], [0.015, 0.018, 0.012], 14)))
        parts.append(("oak", tube([(s * 0.345, 0.53, -0.30), (s * 0.33, 0.26, -0.26), (s * 0.35, 0, -0.38)], [0.013, 0.018, 0.012], 14)))
        arm = loft([rounded_ring(0.012, 0.012, -0.36, 3), rounded_ring(0.024, 0.012, -0.25, 3), rounded_ring(0.030, 0.012, 0.10, 3), rounded_ring(0.036, 0.012, 0.30, 3),
                    rounded_ring(0.026, 0.011, 0.395, 3), rounded_ring(0.004, 0.004, 0.40, 2)])
        parts.append(("oak", arm.turned(90, 0).turned(4, 0).at(s * 0.347, 0.565, 0)))
        parts.append(("oak", tube([(s * 0.30, 0.33, 0.30), (s * 0.30, 0.24, -0.30), (s * 0.29, 0.84, -0.50)], 0.014, 12)))
    parts += [("oak", tube([(-0.335, y, z), (0.335, y, z)], 0.014, 12)) for y, z in ((0.315, 0.30), (0.245, -0.25), (0.82, -0.485))]
    parts += [("oak", tube([(x, 0.27, -0.30), (x, 0.82, -0.485)], 0.008, 8)) for x in np.linspace(-0.2, 0.2, 5)]
    parts.append(("armchair", cushion(0.60, 0.62, 0.13, 3, 0.05).turned(7, 0).at(0, 0.365, 0.03)))
    parts.append(("armchair", leaning(pillow(0.60, 0.60, 0.19, 4), 20, 0, 0, 0.665, -0.30)))
    return parts


def side_table(radius=0.22, height=0.52):
    top = lathe([(0, -0.016), (radius - 0.006, -0.016), (radius, -0.010), (radius, 0.006), (radius - 0.003, 0.009), (radius - 0.006, 0.006), (radius - 0.008, -0.006), (0, -0.006)], 56)
    foot = lathe([(0, 0), (0.15, 0), (0.15, 0.006), (0.14, 0.010), (0, 0.012)], 48)
    return [("black metal", join(top.at(0, height, 0), tube([(0, 0.01, 0), (0, height - 0.01, 0)], 0.012, 14), foot))]


def coffee_tables():
    """A pair: a large one of oak, a smaller one in front of it, higher and dark."""
    parts = []
    for material, x, z, radius, height in (("oak", 0, 0, 0.43, 0.34), ("oak dark", 0.36, 0.46, 0.27, 0.42)):
        top = [(0, -0.024), (radius - 0.035, -0.024), (radius - 0.006, -0.010), (radius, -0.003), (radius - 0.001, 0.001), (radius - 0.005, 0.003), (radius - 0.005, 0.003), (0, 0.003)]
        parts.append((material, lathe(top, 72).at(x, height, z)))
        for k in range(3):
            a = np.radians(90 + 120 * k)
            c, s = np.cos(a) * radius, np.sin(a) * radius
            parts.append((material, tube([(x + 0.62 * c, height - 0.02, z + 0.62 * s), (x + 0.86 * c, 0, z + 0.86 * s)], [0.022, 0.013], 16)))
    return parts


def media_bench(width=2.1, height=0.48, depth=0.42):
    """Low bench with fluted doors."""
    parts = [("oak", box(width, 0.022, depth, 0.003).at(0, height - 0.011, 0)), ("oak", box(width, 0.022, depth, 0.003).at(0, 0.151, 0)),
             ("oak", box(width - 0.02, height - 0.16, depth - 0.04, 0.002).at(0, (height + 0.14) / 2, -0.02))]
    parts += [("oak", box(0.022, height - 0.14, depth, 0.003).at(s * (width - 0.022) / 2, (height + 0.14) / 2, 0)) for s in (-1, 1)]
    inner, doors = width - 0.05, 4
    for k in range(doors):
        x, w = (k - (doors - 1) / 2) * inner / doors, inner / doors - 0.005
        y, h = (height + 0.14) / 2, height - 0.19
        if k in (0, doors - 1):
            flutes = int(w / 0.016)
            parts.append(("oak", join(*[box(w / flutes - 0.002, h, 0.016, 0.005).at(x + (i - (flutes - 1) / 2) * w / flutes, y, depth / 2 - 0.010) for i in range(flutes)])))
        else:
            parts.append(("front white", box(w, h, 0.018, 0.003).at(x, y, depth / 2 - 0.009)))
            parts.append(("brass", lathe([(0, 0), (0.008, 0), (0.007, 0.012), (0.012, 0.018), (0.011, 0.024), (0, 0.025)], 20).turned(90, 0).at(x - (k - 1.5) * 2 * (w / 2 - 0.05), y + h / 2 - 0.05, depth / 2)))
    return parts + [("black metal", join(*[tube([(x, 0.14, z), (x, 0, z)], 0.011, 12) for x, z in corners(width / 2 - 0.12, depth / 2 - 0.07)]))]


def slatted_panel(width=2.9, height=2.52, pitch=0.045):
    """Upright oak slats over dark felt, for the wall behind the television."""
    n = int(width / pitch)
    slats = [box(pitch - 0.016, height, 0.016, 0.002).at((k - (n - 1) / 2) * pitch, height / 2, 0.018) for k in range(n)]
    for k, s in enumerate(slats):
        s.uv = s.uv + [0.0, 0.113 * k]
    return [("felt", box(n * pitch, height, 0.01, 0.001).at(0, height / 2, 0.005)), ("oak upright", join(*slats))]


def television(width=1.32):
    h = width * 9 / 16
    return [("black", box(width, h, 0.028, 0.006).at(0, h / 2, 0)), ("screen", quad(width - 0.012, h - 0.012).at(0, h / 2, 0.0145)), ("black", box(width * 0.6, h * 0.5, 0.03, 0.01).at(0, h / 2, -0.025))]


def bookshelf(width=1.2, height=2.0, depth=0.32, shelves=5, seed=5):
    """An open shelf on a steel frame, filled with standing and lying books."""
    rng = np.random.default_rng(seed)
    t, low = 0.026, 0.10
    gap = (height - low - t) / shelves
    parts = [("black metal", tube([(x, 0, z), (x, height, z)], 0.010, 10)) for x, z in corners(width / 2 - 0.012, depth / 2 - 0.02)]
    parts.append(("black metal", join(*[tube([(s * (width / 2 - 0.012), low + 0.4, -depth / 2 + 0.02), (-s * (width / 2 - 0.012), height - 0.4, -depth / 2 + 0.02)], 0.004, 8) for s in (-1, 1)])))
    books = {k: [] for k in ("book red", "book blue", "book cream", "book green", "book grey", "book white", "book ochre")}
    names = list(books)
    for k in range(shelves + 1):
        y = low + k * gap
        parts.append(("oak", box(width, t, depth, 0.003).at(0, y, 0)))
        if k == shelves:
            break
        y += t / 2 + 0.001
        x, end = -width / 2 + 0.04, width / 2 - 0.04
        lying = rng.uniform(0.22, 0.30)
        stack_left = k % 2 == 0
        start, stop = (x + lying + 0.03, end - (0.20 if k in (1, 2) else 0.02)) if stack_left else (x, end - lying - 0.05)
        # A lying stack at one end.
        sx, sy = (x + lying / 2 if stack_left else end - lying / 2), y
        for _ in range(rng.integers(2, 5)):
            h = rng.uniform(0.018, 0.036)
            books[rng.choice(names)].append(box(lying * rng.uniform(0.82, 1), h, rng.uniform(0.17, 0.22), 0.003).turned(rng.uniform(-5, 5)).at(sx, sy + h / 2, 0.03))
            sy += h + 0.0005
        x = start
        while x < stop - 0.03:
            w, h, d = rng.uniform(0.014, 0.040), rng.uniform(0.18, min(0.29, gap - 0.05)), rng.uniform(0.14, 0.22)
            books[names[int(rng.choice(len(names), p=[0.08, 0.14, 0.22, 0.10, 0.18, 0.20, 0.08]))]].append(box(w, h, d, 0.0035).at(x + w / 2, y + h / 2, 0.13 - d / 2))
            x += w + 0.0015
        if x < end - 0.05 and stack_left:
            h = 0.22
            books[rng.choice(names)].append(box(0.024, h, 0.17, 0.0035).turned(11, 2).at(x + 0.035, y + h / 2 - 0.001, 0.04))
    return parts + [(m, join(*b)) for m, b in books.items() if b]


def console(width=1.0, height=0.80, depth=0.32):
    """A narrow table with one shelf below."""
    parts = [("oak", box(width, 0.026, depth, 0.006).at(0, height - 0.013, 0)), ("oak", box(width - 0.10, 0.018, depth - 0.08, 0.004).at(0, 0.22, 0)),
             ("oak", box(width - 0.12, 0.07, depth - 0.07, 0.003).at(0, height - 0.061, 0))]
    return parts + [("oak", join(*[turned_leg(x, z, height - 0.02, 0.018, 0.012, 0.012) for x, z in corners(width / 2 - 0.07, depth / 2 - 0.05)]))]


def basket(radius=0.20, height=0.28):
    """Wound seagrass: rings one on the other."""
    rings = [tube(rounded_ring(radius * (0.82 + 0.18 * np.sin(np.pi * (0.15 + 0.7 * k / 15))), radius * (0.82 + 0.18 * np.sin(np.pi * (0.15 + 0.7 * k / 15))), 0.01 + height * k / 16, 2, 40), 0.0105, 8) for k in range(16)]
    handles = [bent([(s * (radius - 0.01), height - 0.04, -0.05), (s * (radius + 0.01), height + 0.05, -0.05), (s * (radius + 0.01), height + 0.05, 0.05), (s * (radius - 0.01), height - 0.04, 0.05)], 0.008) for s in (-1, 1)]
    return [("seagrass", join(*rings, *handles, lathe([(0, 0.002), (radius * 0.85, 0.002)], 32)))]
