"""Furniture for living rooms and bedrooms. Every function returns a list of (material, Shape), standing on y = 0, its middle at
the origin, its front towards +z."""
import numpy as np

from shapes import bent, box, cloth_noise, curtain, cylinder, grid, join, lathe, quad, sphere, tube


def placed(parts, x=0.0, y=0.0, z=0.0, turn=0.0):
    return [(m, s.turned(turn).at(x, y, z)) for m, s in parts]


def cushion(w, d, t, seed, r=0.05):
    """A soft cushion lying flat: rounded, swollen, a little uneven."""
    shape = box(w, t, d, min(r, t * 0.45), bulge=(0.012, t * 0.28, 0.012), steps=9)
    return shape.moved(lambda p: np.outer(cloth_noise(p, 9, seed) * 0.006, [0, 1, 0]))


def sofa(width=2.2):
    parts = [("oak", join(*[lathe([(0.014, 0), (0.02, 0.13)], 12).at(sx * (width / 2 - 0.12), 0, sz * 0.34) for sx in (-1, 1) for sz in (-1, 1)])),
             ("sofa", box(width, 0.20, 0.90, 0.03).at(0, 0.23, 0))]
    arm = 0.16
    for s in (-1, 1):
        parts.append(("sofa", box(arm, 0.36, 0.90, 0.06, bulge=(0.01, 0.01, 0.01), steps=5).at(s * (width - arm) / 2, 0.46, 0)))
    parts.append(("sofa", box(width - 2 * arm, 0.46, 0.18, 0.06, steps=5).turned(-8, 0).at(0, 0.55, -0.36)))
    seat = (width - 2 * arm) / 3
    for k in range(3):
        x = (k - 1) * seat
        parts.append(("sofa", cushion(seat - 0.008, 0.68, 0.17, k).at(x, 0.41, 0.10)))
        parts.append(("sofa", cushion(seat - 0.015, 0.42, 0.15, 10 + k).turned(76, 0).at(x, 0.68, -0.24)))
    parts.append(("pillow rust", cushion(0.46, 0.46, 0.12, 21).turned(62, 0).turned(18).at(-width / 2 + 0.44, 0.71, -0.04)))
    parts.append(("pillow blue", cushion(0.46, 0.46, 0.12, 22).turned(60, 0).turned(-14).at(width / 2 - 0.46, 0.71, -0.03)))
    return parts


def armchair():
    parts = [("oak", join(*[tube([(sx * 0.30, 0.36, sz * 0.26), (sx * 0.35, 0, sz * 0.33)], 0.016) for sx in (-1, 1) for sz in (-1, 1)]))]
    parts += [("oak", bent([(s * 0.35, 0.30, 0.30), (s * 0.36, 0.60, 0.34), (s * 0.35, 0.58, -0.38)], 0.017)) for s in (-1, 1)]
    parts.append(("armchair", cushion(0.60, 0.60, 0.16, 3).turned(-4, 0).at(0, 0.42, 0.02)))
    parts.append(("armchair", cushion(0.60, 0.58, 0.14, 4).turned(72, 0).at(0, 0.70, -0.30)))
    return parts


def round_table(radius, height, top="oak"):
    parts = [(top, lathe([(0, -0.028), (radius - 0.03, -0.028), (radius - 0.004, -0.010), (radius, -0.004), (radius - 0.004, 0), (radius - 0.004, 0), (0, 0)], 64).at(0, height, 0))]
    for k in range(3):
        a = np.radians(90 + 120 * k)
        parts.append(("oak", tube([(np.cos(a) * radius * 0.55, height - 0.02, np.sin(a) * radius * 0.55), (np.cos(a) * radius * 0.85, 0, np.sin(a) * radius * 0.85)], 0.019)))
    return parts


def dining_table(length=1.7, width=0.9):
    h = 0.74
    parts = [("oak", box(length, 0.032, width, 0.008).at(0, h - 0.016, 0)),
             ("oak", box(length - 0.3, 0.07, 0.025).at(0, h - 0.067, width / 2 - 0.12)), ("oak", box(length - 0.3, 0.07, 0.025).at(0, h - 0.067, -width / 2 + 0.12))]
    for sx in (-1, 1):
        for sz in (-1, 1):
            parts.append(("oak", tube([(sx * (length / 2 - 0.16), h - 0.03, sz * (width / 2 - 0.14)), (sx * (length / 2 - 0.08), 0, sz * (width / 2 - 0.08))], 0.026, 16)))
    return parts


def chair():
    parts = [("chair", box(0.44, 0.035, 0.42, 0.016, bulge=(0, 0.008, 0), steps=4).at(0, 0.45, 0.01))]
    parts.append(("chair", box(0.42, 0.20, 0.018, 0.008, steps=8).moved(lambda p: np.outer(p[:, 0] ** 2 * 0.9, [0, 0, 1])).turned(-10, 0).at(0, 0.74, -0.21)))
    for s in (-1, 1):
        parts.append(("oak", tube([(s * 0.17, 0.44, 0.15), (s * 0.20, 0, 0.20)], 0.015)))
        parts.append(("oak", bent([(s * 0.21, 0, -0.22), (s * 0.18, 0.40, -0.16), (s * 0.18, 0.82, -0.225)], 0.015)))
    return parts


def bookshelf(width=1.1, height=1.9, depth=0.30, shelves=5, seed=5):
    rng = np.random.default_rng(seed)
    t = 0.022
    parts = [("oak", box(t, height, depth, 0.002).at(s * (width - t) / 2, height / 2, 0)) for s in (-1, 1)]
    parts.append(("oak", box(width - 2 * t, height, 0.008, 0.001).at(0, height / 2, -depth / 2 + 0.004)))
    gap = (height - 0.06 - t) / shelves
    books = {k: [] for k in ("book red", "book blue", "book cream", "book green", "book grey")}
    for k in range(shelves + 1):
        y = 0.06 + k * gap
        parts.append(("oak", box(width - 2 * t, t, depth - 0.01, 0.002).at(0, y, 0)))
        if k == shelves:
            break
        x = -width / 2 + t + 0.01
        end = width / 2 - t - (0.02 if rng.random() < 0.4 else rng.uniform(0.15, 0.45))
        while x < end - 0.05:
            w, h, d = rng.uniform(0.014, 0.042), rng.uniform(0.17, min(0.28, gap - 0.04)), rng.uniform(0.14, 0.21)
            lean = rng.uniform(-9, -4) if rng.random() < 0.04 else 0
            books[rng.choice(list(books))].append(box(w, h, d, 0.0035).turned(lean, 2).at(x + w / 2, y + t / 2 + h / 2 + 0.001, 0.05 - d / 2 + 0.06))
            x += w + 0.0015 + abs(lean) * 0.004
    parts += [(m, join(*b)) for m, b in books.items() if b]
    parts += [(m, s.at(width * 0.30, 0.06 + 2 * gap + t / 2, 0.02)) for m, s in vase(0.20)]
    return parts


def sideboard(width=1.6, height=0.5, depth=0.42, doors=3, body="oak", front="front grey"):
    parts = [(body, box(width, height - 0.14, depth, 0.006).at(0, 0.14 + (height - 0.14) / 2, 0))]
    w = (width - 0.03) / doors
    for k in range(doors):
        x = (k - (doors - 1) / 2) * w
        parts.append((front, box(w - 0.006, height - 0.19, 0.018, 0.003).at(x, 0.14 + (height - 0.14) / 2, depth / 2 + 0.009)))
        parts.append(("brass", box(0.10, 0.010, 0.012, 0.004).at(x, height - 0.075, depth / 2 + 0.026)))
    parts += [("oak", lathe([(0.012, 0), (0.018, 0.14)], 12).at(sx * (width / 2 - 0.1), 0, sz * (depth / 2 - 0.07))) for sx in (-1, 1) for sz in (-1, 1)]
    return parts


def television(width=1.25):
    h = width * 9 / 16
    return [("black", box(width, h, 0.035, 0.006).at(0, h / 2 + 0.05, 0)), ("screen", quad(width - 0.014, h - 0.014).at(0, h / 2 + 0.05, 0.0178)),
            ("black", box(0.5, 0.012, 0.2, 0.004).at(0, 0.006, 0)), ("black", box(0.06, 0.08, 0.02).at(0, 0.05, -0.02))]


def plant(height=1.2, leaves=42, seed=3):
    """A pot with long arching leaves."""
    rng = np.random.default_rng(seed)
    parts = [("pot", lathe([(0, 0), (0.13, 0), (0.145, 0.02), (0.18, 0.30), (0.172, 0.305), (0.165, 0.28), (0.165, 0.27)], 40)), ("soil", lathe([(0.168, 0.262), (0, 0.268)], 24))]
    blades = []
    for k in range(leaves):
        turn, reach, top = rng.uniform(0, 360), rng.uniform(0.18, 0.55), rng.uniform(0.55, 1.0) * height
        t = np.linspace(0, 1, 11)
        r, y = 0.04 + reach * t ** 1.5, 0.27 + (top - 0.27) * (1.25 * t - 0.45 * t ** 3 * rng.uniform(0.7, 1.4))
        w = 0.034 * np.sin(np.pi * np.clip(0.08 + 0.92 * t, 0, 1)) ** 0.7 * rng.uniform(0.8, 1.2)
        left = np.stack([r, y + 0.010, -w], -1)
        mid = np.stack([r, y, 0 * w], -1)
        right = np.stack([r, y + 0.010, w], -1)
        p = np.stack([left, mid, right], 1)
        uv = np.stack(np.meshgrid([0, 0.5, 1], t), -1)
        blades.append(grid(p, np.zeros_like(p), uv).smoothed().turned(turn))
    parts.append(("leaf", join(*blades)))
    return parts


def vase(height=0.26, material="ceramic"):
    y = np.linspace(0, 1, 18)
    outline = [(0, 0)] + [((0.30 + 0.22 * np.sin(np.pi * t ** 0.8) - 0.16 * t ** 3) * height, t * height) for t in y]
    inside = [(r - 0.004, h) for r, h in outline[::-1][:8]]
    return [(material, lathe(outline + inside, 36))]


def bowl_of_fruit():
    parts = [("ceramic", lathe([(0, 0), (0.06, 0), (0.11, 0.03), (0.15, 0.075), (0.146, 0.077), (0.105, 0.035), (0, 0.012)], 40))]
    for k, (m, x, z, y, r) in enumerate((("orange", 0.045, 0.02, 0.062, 0.038), ("orange", -0.04, 0.035, 0.062, 0.038), ("apple", 0.0, -0.05, 0.06, 0.036), ("apple", 0.008, 0.01, 0.115, 0.036), ("lemon", -0.055, -0.03, 0.06, 0.03))):
        parts.append((m, sphere(r).scaled(1, 0.92, 1).at(x, y, z)))
    return parts


def lampshade(bottom, top, height):
    """Cloth cone, open above and below, seen from inside and outside."""
    return lathe([(bottom, 0), (top, height)], 48)


def floor_lamp():
    return [("black metal", cylinder(0.14, 0.018, 40)), ("black metal", cylinder(0.011, 1.42, 16).at(0, 0.018, 0)),
            ("shade", lampshade(0.21, 0.16, 0.26).at(0, 1.34, 0)), ("bulb floor", sphere(0.045).at(0, 1.47, 0))]


def table_lamp():
    return [("ceramic", lathe([(0, 0), (0.055, 0), (0.075, 0.05), (0.07, 0.11), (0.03, 0.17), (0.014, 0.19), (0.012, 0.26)], 32)),
            ("shade", lampshade(0.125, 0.085, 0.16).at(0, 0.22, 0)), ("bulb bed", sphere(0.03).at(0, 0.295, 0))]


def pendant(drop):
    """Hangs from y = 0 down to -drop: a spun metal shade with a bulb."""
    outline = [(0.03, 0.19), (0.045, 0.18), (0.10, 0.145), (0.165, 0.08), (0.20, 0.0), (0.20, 0.0), (0.196, 0.0), (0.16, 0.078), (0.098, 0.14), (0.03, 0.176)]
    return [("black metal", cylinder(0.004, drop - 0.18, 8).at(0, -drop + 0.18, 0)), ("black metal", cylinder(0.05, 0.02, 24).at(0, -0.02, 0)),
            ("pendant", lathe(outline[::-1], 48).at(0, -drop, 0)), ("bulb dining", sphere(0.04).at(0, -drop + 0.06, 0))]


def curtain_pair(width, height, each=0.5, material="curtain"):
    rod = tube([(-width / 2 - 0.1, 0.02, 0), (width / 2 + 0.1, 0.02, 0)], 0.011)
    return [("black metal", rod)] + [(material, curtain(each, height, 7).at(s * (width / 2 - each / 2 + 0.08), 0, 0)) for s in (-1, 1)]


def framed(width, height, picture):
    parts = [("frame", box(width + 0.05, 0.025, 0.03).at(0, s * (height + 0.025) / 2, 0.015)) for s in (-1, 1)]
    parts += [("frame", box(0.025, height + 0.05, 0.03).at(s * (width + 0.025) / 2, 0, 0.015)) for s in (-1, 1)]
    picture_quad = quad(width, height).at(0, 0, 0.012)
    picture_quad.uv = picture_quad.uv * [1 / width, -1 / height] + 0.5
    return parts + [(picture, picture_quad)]


def bed(width=1.6, length=2.0):
    parts = [("oak", box(width + 0.08, 0.26, length + 0.06, 0.012).at(0, 0.19, 0)), ("headboard", box(width + 0.2, 0.62, 0.09, 0.04, bulge=(0, 0, 0.015), steps=7).at(0, 0.72, -length / 2 - 0.06)),
             ("linen", box(width, 0.20, length, 0.06, steps=4).at(0, 0.41, 0))]
    # The duvet: a soft slab with wrinkles that hangs over the sides and the foot.
    duvet = box(width + 0.30, 0.10, length * 0.72, 0.048, bulge=(0, 0.02, 0), steps=56)

    def drape(p):
        over = np.maximum(np.abs(p[:, 0]) - (width / 2 + 0.01), 0)
        foot = np.maximum(p[:, 2] - (length * 0.36 - 0.10), 0)
        wrinkle = 0.011 * cloth_noise(p * [1, 0.2, 1], 7, 8) + 0.006 * cloth_noise(p * [1, 0.2, 1], 19, 9)
        return np.stack([-np.sign(p[:, 0]) * over * 0.75, wrinkle - over * 1.7 - foot * 0.3, wrinkle * 0.2], -1)

    parts.append(("duvet", duvet.moved(drape).at(0, 0.545, 0.27)))
    for s in (-1, 1):
        parts.append(("linen", cushion(0.70, 0.46, 0.16, 30 + s, 0.07).turned(22, 0).at(s * 0.38, 0.60, -length / 2 + 0.28)))
    parts.append(("pillow rust", cushion(0.55, 0.34, 0.12, 40).turned(40, 0).at(0, 0.66, -length / 2 + 0.56)))
    blanket = box(width + 0.32, 0.018, 0.50, 0.008, steps=40).moved(lambda p: np.stack([-np.sign(p[:, 0]) * np.maximum(np.abs(p[:, 0]) - width / 2 - 0.02, 0) * 0.75, 0.01 * cloth_noise(p * [1, 0.2, 1], 7, 8) - np.maximum(np.abs(p[:, 0]) - width / 2 - 0.02, 0) * 1.5, 0 * p[:, 0]], -1))
    parts.append(("blanket", blanket.at(0, 0.628, 0.62)))
    return parts


def nightstand():
    return [("oak", box(0.46, 0.34, 0.38, 0.006).at(0, 0.31, 0)), ("front grey", box(0.43, 0.14, 0.016).at(0, 0.39, 0.198)), ("front grey", box(0.43, 0.14, 0.016).at(0, 0.235, 0.198)),
            ("brass", box(0.09, 0.01, 0.012, 0.004).at(0, 0.39, 0.212)), ("brass", box(0.09, 0.01, 0.012, 0.004).at(0, 0.235, 0.212))] + [
                ("oak", lathe([(0.010, 0), (0.015, 0.14)], 10).at(sx * 0.18, 0, sz * 0.14)) for sx in (-1, 1) for sz in (-1, 1)]


def wardrobe(width=1.8, height=2.2, depth=0.6, doors=4):
    parts = [("front white", box(width, height, depth, 0.004).at(0, height / 2, 0))]
    w = width / doors
    for k in range(doors):
        x = (k - (doors - 1) / 2) * w
        parts.append(("front white", box(w - 0.005, height - 0.10, 0.02, 0.003).at(x, height / 2 + 0.03, depth / 2 + 0.01)))
        parts.append(("brass", box(0.012, 0.24, 0.014, 0.004).at(x + (0.5 * w - 0.05) * (1 if k % 2 == 0 else -1), 1.05, depth / 2 + 0.03)))
    return parts
