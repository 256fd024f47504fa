"""Plants, vases, pictures, curtains: what makes rooms lived in."""
import numpy as np

from cloth import curtain
from shapes import box, cloth_noise, grid, join, lathe, quad, tube


def planter(radius=0.17, height=0.30, material="pot"):
    """A pot with soil; returns its parts and the height of the soil."""
    outline = [(0, 0), (radius * 0.72, 0), (radius * 0.76, 0.008), (radius * 0.97, height * 0.85), (radius, height), (radius - 0.012, height), (radius * 0.90, height * 0.86)]
    soil = lathe([(radius * 0.93, height * 0.86), (0, height * 0.88)], 32)
    return [(material, lathe(outline, 48)), ("soil", soil)], height * 0.87


def leaf(length, width, bend, seed=0, fold=0.25, steps=9):
    """A leaf from the origin along +x that bends down; broad below its middle, folded along its rib."""
    t = np.linspace(0, 1, steps)
    half = width / 2 * np.sin(np.pi * t ** 0.8).clip(0) ** 0.75
    angle = np.cumsum(np.full(steps, -bend / steps))
    mid = np.cumsum(np.stack([np.cos(angle), np.sin(angle), 0 * t], -1) * length / steps, axis=0)
    up = np.stack([-np.sin(angle), np.cos(angle), 0 * t], -1)
    rows = [mid + half[:, None] * (side * np.array([0, 0, 1.0]) + abs(side) * fold * up) for side in (-1, -0.5, 0, 0.5, 1)]
    p = np.stack(rows, 1)
    p[..., 1] += 0.04 * length * np.sin(7 * t + seed)[:, None] * np.array([1, 0.5, 0, -0.5, -1])
    return grid(p, np.zeros_like(p), np.stack(np.meshgrid(np.linspace(0, 1, 5), t), -1)).smoothed()


def fig_tree(height=1.75, seed=3, leaves=64):
    """A young fiddle-leaf fig: two stems in a pot, large leaves around their upper parts."""
    rng = np.random.default_rng(seed)
    parts, soil = planter(0.19, 0.34, "stoneware")
    stems, blades = [], []
    for k in range(3):
        top = height * (1 - 0.16 * k)
        t = np.linspace(0, 1, 12)
        lean = rng.uniform(-0.13, 0.13, 2)
        path = np.stack([lean[0] * t + 0.03 * np.sin(5 * t + k) + 0.03 * (k - 1), soil + (top - soil) * t, lean[1] * t + 0.03 * np.cos(4 * t + k)], -1)
        stems.append(tube(path, np.linspace(0.014, 0.006, 12), 8))
        for i in range(leaves // 3):
            at = rng.uniform(0.38, 1.0)
            p = np.array([np.interp(at, t, path[:, c]) for c in range(3)])
            size = rng.uniform(0.17, 0.27)
            blade = leaf(size, size * 0.62, rng.uniform(0.3, 1.1), seed + i).turned(rng.uniform(5, 50), 2).turned(i * 137.5 + 40 * k)
            blades.append(blade.at(*p))
    return parts + [("bark", join(*stems)), ("leaf", join(*blades))]


def palm(height=1.2, leaves=42, seed=3):
    """Long arching leaves out of a basket-like pot."""
    rng = np.random.default_rng(seed)
    parts, soil = planter(0.16, 0.28)
    blades = []
    for _ in range(leaves):
        turn, reach, top = rng.uniform(0, 360), rng.uniform(0.18, 0.55), rng.uniform(0.55, 1.0) * height
        t = np.linspace(0, 1, 13)
        r, y = 0.03 + reach * t ** 1.5, soil + (top - soil) * (1.25 * t - 0.45 * t ** 3 * rng.uniform(0.7, 1.4))
        w = 0.030 * np.sin(np.pi * np.clip(0.08 + 0.92 * t, 0, 1)).clip(0) ** 0.7 * rng.uniform(0.8, 1.2)
        p = np.stack([np.stack([r, y + 0.35 * np.abs(side) * w, side * w], -1) for side in (-1, 0, 1)], 1)
        blades.append(grid(p, np.zeros_like(p), np.stack(np.meshgrid([0, 0.5, 1], t), -1)).smoothed().turned(turn))
    return parts + [("leaf", join(*blades))]


def herbs(seed=1, material="pot"):
    """A small pot of basil."""
    rng = np.random.default_rng(seed)
    parts, soil = planter(0.06, 0.105, material)
    blades = []
    for _ in range(70):
        a, r, y = rng.uniform(0, 360), rng.uniform(0.0, 0.065), soil + rng.uniform(0.02, 0.15)
        size = rng.uniform(0.025, 0.05)
        blades.append(leaf(size, size * 0.6, rng.uniform(0.2, 1.0), 0, 0.3, 5).turned(rng.uniform(0, 45), 2).at(r, y, 0).turned(a))
    stems = [tube([(0, soil, 0), (0.04 * np.cos(a), soil + 0.12, 0.04 * np.sin(a))], 0.0018, 5) for a in np.linspace(0, 6, 7)]
    return parts + [("leaf light", join(*blades, *stems))]


def trailing(seed=6):
    """A pot whose shoots hang down, for a shelf; the hanging side is +z."""
    rng = np.random.default_rng(seed)
    parts, soil = planter(0.075, 0.13, "stoneware")
    shoots, blades = [], []
    for _ in range(11):
        a, fall = rng.uniform(-1.2, 1.2), rng.uniform(0.15, 0.60)
        t = np.linspace(0, 1, 9)
        r = 0.10 * np.sin(np.minimum(t * 2.2, 1.57))
        path = np.stack([r * np.sin(a) * 1.2, soil + 0.05 * np.sin(t * 3.1) - fall * t ** 1.8, r * np.cos(a)], -1)
        shoots.append(tube(path, 0.0016, 5))
        for at in np.arange(0.1, 1.0, 0.09):
            p = [np.interp(at, t, path[:, c]) for c in range(3)]
            size = rng.uniform(0.035, 0.06)
            blades.append(leaf(size, size * 0.75, rng.uniform(0.6, 1.4), 0, 0.15, 5).turned(rng.uniform(-20, 30), 2).turned(rng.uniform(0, 360)).at(*p))
    return parts + [("leaf light", join(*shoots, *blades))]


def vase(height=0.26, material="ceramic", belly=0.24):
    t = np.linspace(0, 1, 24)
    outline = [(0, 0)] + [((0.22 + belly * np.sin(np.pi * k ** 0.75) - 0.10 * k ** 2) * height, k * height) for k in t]
    inside = [(r - 0.005, h) for r, h in outline[::-1][:10]]
    return [(material, lathe(outline + inside, 48))]


def branches(height=0.26, reach=0.75, seed=2):
    """A tall vase with leafy twigs."""
    rng = np.random.default_rng(seed)
    twigs, blades = [], []
    for k in range(6):
        a, t = rng.uniform(0, 6.28), np.linspace(0, 1, 9)
        spread = rng.uniform(0.10, 0.30)
        path = np.stack([spread * t ** 1.6 * np.cos(a), 0.06 + reach * rng.uniform(0.7, 1) * t, spread * t ** 1.6 * np.sin(a)], -1)
        twigs.append(tube(path, np.linspace(0.004, 0.0015, 9), 6))
        for at in np.linspace(0.45, 1, 10):
            p = [np.interp(at, t, path[:, c]) for c in range(3)]
            size = rng.uniform(0.04, 0.065)
            blades.append(leaf(size, size * 0.75, 0.5, 0, 0.2, 5).turned(rng.uniform(0, 60), 2).turned(rng.uniform(0, 360)).at(*p))
    return vase(height, "ceramic", 0.16) + [("bark", join(*twigs)), ("leaf olive", join(*blades))]


def framed(width, height, picture, frame="frame", mat=0.0):
    """A picture on a wall, its back at z = 0; `mat` is the width of the white border round it."""
    parts = [(frame, box(width + 0.036, 0.020, 0.028, 0.002).at(0, s * (height + 0.018) / 2, 0.014)) for s in (-1, 1)]
    parts += [(frame, box(0.020, height + 0.001, 0.028, 0.002).at(s * (width + 0.018) / 2, 0, 0.014)) for s in (-1, 1)]
    if mat:
        parts.append(("paper", quad(width, height).at(0, 0, 0.010)))
    w, h = width - 2 * mat, height - 2 * mat
    art = quad(w, h).at(0, 0, 0.012)
    art.uv = art.uv * [1 / w, -1 / h] + 0.5
    return parts + [(picture, art)]


def curtain_pair(width, height, each=0.5, material="curtain", seed=0):
    """A rod at y = 0 with one curtain on either side of an opening of the given width."""
    half = width / 2 + 0.22
    rod = join(tube([(-half, 0.02, 0), (half, 0.02, 0)], 0.011, 12), *[lathe([(0, 0), (0.018, 0), (0.022, 0.015), (0.014, 0.03), (0, 0.032)], 20).turned(-90 * s, 2).at(s * half, 0.02, 0) for s in (-1, 1)],
               *[tube([(s * (half - 0.06), 0.02, -0.09), (s * (half - 0.06), 0.02, 0)], 0.007, 8) for s in (-1, 1)])
    return [("brass", rod)] + [(material, curtain(each, height, max(4, int(each / 0.065)), seed + s + 1).at(s * (half - 0.05 - each / 2), 0, 0)) for s in (-1, 1)]


def rug(width, length, material="rug", fringe=True):
    """Lies on y = 0, its length along z; slightly uneven, with fringes at the ends."""
    body = box(width, 0.012, length, 0.005, steps=24).moved(lambda p: np.outer(0.0012 * cloth_noise(p, 5, 1), [0, 1, 0])).at(0, 0.007, 0)
    body.uv = body.positions[:, [0, 2]] / [width, length] + 0.5
    if not fringe:
        return [(material, body)]
    rng = np.random.default_rng(1)
    threads = []
    for s in (-1, 1):
        for x in np.arange(-width / 2 + 0.01, width / 2, 0.022):
            end = x + rng.uniform(-0.014, 0.014)
            threads.append(tube([(x, 0.008, s * (length / 2 - 0.002)), ((x + end) / 2, 0.007, s * (length / 2 + 0.03)), (end, 0.004, s * (length / 2 + 0.065))], 0.0028, 5))
    return [(material, body), ("fringe", join(*threads))]


def magazines():
    return [("book cream", box(0.30, 0.020, 0.23, 0.003).turned(8).at(0, 0.010, 0)), ("book ink", box(0.27, 0.026, 0.21, 0.003).turned(-6).at(0.01, 0.033, 0)), ("book rust", box(0.20, 0.018, 0.15, 0.003).turned(20).at(0, 0.055, 0))]


def candles():
    """Two candlesticks of different height."""
    stick = [(0, 0), (0.038, 0), (0.040, 0.004), (0.012, 0.014), (0.007, 0.03), (0.007, 0.10), (0.014, 0.108), (0.014, 0.118), (0, 0.118)]
    parts = []
    for x, k in ((0, 1.0), (0.085, 1.45)):
        parts += [("brass", lathe([(r, y * k) for r, y in stick], 32).at(x, 0, 0.03 * (k - 1))), ("candle", lathe([(0, 0), (0.010, 0), (0.010, 0.20), (0.004, 0.205), (0, 0.205)], 20).at(x, 0.116 * k, 0.03 * (k - 1)))]
    return parts
