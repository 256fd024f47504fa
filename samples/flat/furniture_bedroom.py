"""Bed, bedside tables, wardrobe and dresser."""

from cloth import boxes_distance, drape, fabric, pillow
from furniture_living import corners, turned_leg
from shapes import box, join, lathe, quad, tube


def bed(width=1.6, length=2.0):
    """Upholstered headboard at -z; the duvet and the blanket at its foot fall over the mattress."""
    frame_top, top = 0.28, 0.53
    parts = [("oak", join(*[turned_leg(x, z, 0.14, 0.026, 0.018) for x, z in corners(width / 2 - 0.08, length / 2 - 0.10)])),
             ("oak", box(width + 0.08, 0.16, length + 0.06, 0.010).at(0, frame_top - 0.08, 0)),
             ("linen", box(width - 0.02, top - frame_top, length - 0.02, 0.06, bulge=(0.006, 0, 0.006), steps=5).at(0, (frame_top + top) / 2, 0))]
    channels = 9
    w = (width + 0.24) / channels
    parts.append(("headboard", join(*[box(w + 0.004, 0.86, 0.10, 0.045, bulge=(0, 0, 0.012), steps=6).at((k - (channels - 1) / 2) * w, 0.62, -length / 2 - 0.07) for k in range(channels)])))
    body = boxes_distance([((0, top / 2, 0), (width, top, length), 0.07), ((0, frame_top / 2, 0), (width + 0.08, frame_top, length + 0.06), 0.01)])
    parts.append(("duvet", fabric(drape(width + 0.52, 1.42, body, (0, top + 0.06, 0.38), 0, 0.04, 110, seed=3), 0.012, 5, 0.040)))
    # The blanket lies on what the duvet made of the bed.
    padded = boxes_distance([((0, (top + 0.055) / 2, 0.2), (width + 0.17, top + 0.055, length - 0.1), 0.09)])
    parts.append(("blanket", fabric(drape(width + 0.54, 0.50, padded, (0.02, top + 0.12, 0.66), 3, 0.035, 110, seed=8), 0.008, 6, 0.004)))
    for s in (-1, 1):
        parts += [("linen", pillow(0.72, 0.50, 0.20, 30 + s).turned(-58, 0).turned(3 * s).at(s * 0.40, top + 0.16, -length / 2 + 0.25)),
                  ("duvet", pillow(0.70, 0.48, 0.19, 34 + s).turned(-44, 0).turned(-4 * s).at(s * 0.385, top + 0.22, -length / 2 + 0.44))]
    parts.append(("pillow rust", pillow(0.60, 0.34, 0.15, 40).turned(-40, 0).turned(4).at(0.03, top + 0.19, -length / 2 + 0.62)))
    return parts


def nightstand(width=0.46, height=0.48, depth=0.38):
    """One drawer, an open shelf below it, tapered legs."""
    t = 0.018
    parts = [("oak", box(width, t, depth, 0.004).at(0, height - t / 2, 0)), ("oak", box(width, t, depth, 0.004).at(0, 0.20, 0)), ("oak", box(width - 2 * t, height - 0.2, 0.01, 0.001).at(0, (height + 0.2) / 2, -depth / 2 + 0.008))]
    parts += [("oak", box(t, height - 0.2 - t, depth, 0.003).at(s * (width - t) / 2, (height + 0.2) / 2 - t / 2, 0)) for s in (-1, 1)]
    parts += [("oak", box(width - 2 * t - 0.004, 0.13, depth - 0.02, 0.003).at(0, height - t - 0.068, 0.006)), ("brass", tube([(-0.05, height - 0.085, depth / 2 + 0.012), (0.05, height - 0.085, depth / 2 + 0.012)], 0.0045, 10)),
              ("oak", join(*[turned_leg(x, z, 0.20, 0.016, 0.010, 0.015) for x, z in corners(width / 2 - 0.04, depth / 2 - 0.04)]))]
    books = ((("book cream", 0.0), ("book blue", 0.028), ("book ochre", 0.052)))
    return parts + [(m, box(0.22, 0.022, 0.15, 0.003).turned(7 * k - 5).at(-0.03, 0.222 + y, 0.02)) for k, (m, y) in enumerate(books)]


def wardrobe(width=2.0, height=2.3, depth=0.60, doors=4):
    """Framed doors up to a plain cornice, on a plinth."""
    parts = [("front white", box(width, height, depth, 0.003).at(0, height / 2, 0)), ("front white", box(width + 0.03, 0.05, depth + 0.03, 0.006).at(0, height + 0.02, 0.01))]
    w, h, t, z = width / doors, height - 0.12, 0.07, depth / 2
    for k in range(doors):
        x, y = (k - (doors - 1) / 2) * w, 0.09 + h / 2
        parts.append(("front white", box(w - 0.005, h - 0.005, 0.012, 0.002).at(x, y, z + 0.008)))
        parts += [("front white", box(t, h - 0.005, 0.010, 0.003).at(x + s * (w - t - 0.005) / 2, y, z + 0.017)) for s in (-1, 1)]
        parts += [("front white", box(w - 2 * t - 0.005, t, 0.010, 0.003).at(x, yy, z + 0.017)) for yy in (y + (h - t) / 2 - 0.003, y - (h - t) / 2 + 0.003, y - 0.18)]
        side = 1 if k % 2 == 0 else -1
        parts.append(("brass", join(tube([(x + side * (w / 2 - 0.037), 0.98, z + 0.045), (x + side * (w / 2 - 0.037), 1.18, z + 0.045)], 0.006, 12),
                                    *[tube([(x + side * (w / 2 - 0.037), yy, z + 0.02), (x + side * (w / 2 - 0.037), yy, z + 0.045)], 0.005, 8) for yy in (1.0, 1.16)])))
    return parts


def dresser(width=1.1, height=0.78, depth=0.44):
    """Six drawers with round knobs."""
    body = height - 0.15
    parts = [("oak", box(width, body, depth - 0.02, 0.004).at(0, 0.15 + body / 2, -0.01)), ("oak", box(width + 0.02, 0.024, depth + 0.01, 0.006).at(0, height, 0))]
    for column in range(2):
        for row in range(3):
            x, y = (column - 0.5) * (width - 0.03) / 2, 0.175 + (row + 0.5) * (body - 0.04) / 3
            parts.append(("oak", box((width - 0.03) / 2 - 0.005, (body - 0.04) / 3 - 0.005, 0.018, 0.003).at(x, y, depth / 2 - 0.008)))
            knob = lathe([(0, 0), (0.007, 0), (0.006, 0.012), (0.013, 0.018), (0.012, 0.025), (0, 0.027)], 20).turned(90, 0)
            parts += [("brass", knob.at(x + s * 0.13, y, depth / 2)) for s in (-1, 1)]
    return parts + [("oak", join(*[turned_leg(x, z, 0.16, 0.020, 0.012, 0.02) for x, z in corners(width / 2 - 0.07, depth / 2 - 0.06)]))]


def bench(width=1.2, depth=0.38, height=0.44):
    """Woven seat on an oak frame, for the foot of the bed."""
    parts = [("cord", box(width - 0.02, 0.035, depth - 0.02, 0.016, bulge=(0, 0.008, 0), steps=6).at(0, height, 0))]
    parts += [("oak", tube([(-width / 2, height - 0.012, s * (depth / 2 - 0.02)), (width / 2, height - 0.012, s * (depth / 2 - 0.02))], 0.014, 12)) for s in (-1, 1)]
    return parts + [("oak", join(*[turned_leg(x, z, height, 0.018, 0.012, 0.02) for x, z in corners(width / 2 - 0.04, depth / 2 - 0.03)]))]


def round_mirror(radius=0.36):
    """Hangs on a wall; its back at z = 0."""
    disc = lathe([(0.0, 0.0), (radius, 0.0)], 64)
    disc.normals[:] = [0, 1, 0]
    ring = lathe([(radius, 0.0), (radius + 0.012, 0.0), (radius + 0.012, 0.028), (radius, 0.028), (radius, 0.012)], 64)
    disc.triangles = disc.triangles[:, ::-1]
    return [("mirror", disc.turned(90, 0).at(0, 0, 0.014)), ("brass", ring.turned(90, 0))]


def standing_mirror(width=0.6, height=1.6):
    """Leans against a wall behind it at -z."""
    frame = [("oak", box(width + 0.05, 0.03, 0.03, 0.006).at(0, y, 0)) for y in (0.015, height + 0.035)] + [("oak", box(0.03, height + 0.05, 0.03, 0.006).at(s * (width + 0.02) / 2, height / 2 + 0.025, 0)) for s in (-1, 1)]
    parts = frame + [("mirror", quad(width, height).at(0, height / 2 + 0.025, 0.006)), ("oak", box(width, height, 0.006, 0.001).at(0, height / 2 + 0.025, -0.004))]
    return [(m, s.turned(-5, 0).at(0, 0, 0.04)) for m, s in parts]
