"""Kitchen along a wall: the back is at z = 0, the front towards +z, x from the left end; everything stands on y = 0."""
import numpy as np

from lamps import light_strip
from furniture_dining import tumbler
from shapes import bent, box, cylinder, join, lathe, quad, tube

DEPTH, TOP = 0.60, 0.91  # cupboards, upper face of the worktop
UNIT = 0.60


def front(x0, x1, y0, y1, z, material="front sage"):
    """A framed front between the given edges."""
    w, h, t = x1 - x0 - 0.004, y1 - y0 - 0.004, 0.055
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    if h < 0.22:
        return [(material, box(w, h, 0.020, 0.002).at(x, y, z + 0.010))]
    parts = [box(w - 0.01, h - 0.01, 0.012, 0.001).at(x, y, z + 0.006)]
    parts += [box(t, h, 0.020, 0.002).at(x + s * (w - t) / 2, y, z + 0.010) for s in (-1, 1)]
    parts += [box(w - 2 * t + 0.002, t, 0.020, 0.002).at(x, y + s * (h - t) / 2, z + 0.010) for s in (-1, 1)]
    return [(material, join(*parts))]


def pull(x, y, z, length=0.14, upright=False):
    """A brass bar handle."""
    d = np.array([0, 1, 0]) if upright else np.array([1, 0, 0])
    middle = np.array([x, y, z + 0.032])
    bar = tube([middle - d * length / 2, middle + d * length / 2], 0.005, 12)
    posts = [tube([middle + s * d * (length / 2 - 0.018), middle + s * d * (length / 2 - 0.018) - [0, 0, 0.034]], 0.004, 8) for s in (-1, 1)]
    return [("brass", join(bar, *posts))]


def oven(x):
    """Built in below the hob, its front in the plane of the cupboard fronts."""
    parts = [("steel", box(0.594, 0.10, 0.022, 0.003).at(x, 0.815, DEPTH + 0.010)), ("black glass", box(0.594, 0.56, 0.024, 0.004).at(x, 0.475, DEPTH + 0.010)),
             ("screen", box(0.11, 0.035, 0.002, 0.0005).at(x, 0.815, DEPTH + 0.022)), ("steel", tube([(x - 0.24, 0.70, DEPTH + 0.06), (x + 0.24, 0.70, DEPTH + 0.06)], 0.009, 14))]
    parts += [("steel", join(*[tube([(x + s * 0.22, 0.70, DEPTH + 0.01), (x + s * 0.22, 0.70, DEPTH + 0.06)], 0.006, 10) for s in (-1, 1)]))]
    parts += [("black", cylinder(0.020, 0.025, 28).turned(90, 0).at(x + s * 0.19, 0.815, DEPTH + 0.022)) for s in (-1, 1)]
    return parts


def sink(x, w=0.25, d=0.19):
    """Steel bowl hung in the worktop's hole, and an arched tap."""
    z = DEPTH / 2
    parts = [box(0.008, 0.19, 2 * d).at(x + s * (w + 0.004), TOP - 0.10, z) for s in (-1, 1)] + [box(2 * w, 0.19, 0.008).at(x, TOP - 0.10, z + s * (d + 0.004)) for s in (-1, 1)]
    parts += [box(2 * w + 0.02, 0.006, 2 * d + 0.02).at(x, TOP - 0.195, z), cylinder(0.035, 0.004, 24).at(x, TOP - 0.192, z)]
    tap = join(cylinder(0.024, 0.055, 28).at(x, TOP, 0.075), bent([(x, TOP + 0.04, 0.075), (x, TOP + 0.46, 0.075), (x, TOP + 0.46, 0.27), (x, TOP + 0.24, 0.27)], 0.0115, 14, 14),
               tube([(x + 0.02, TOP + 0.035, 0.075), (x + 0.085, TOP + 0.07, 0.075)], 0.006, 10))
    return [("steel", join(*parts)), ("brass", tap)]


def worktop(width, sink_x, w=0.25, d=0.19):
    """Stone slab around the hole for the sink."""
    t, deep, z = 0.03, DEPTH + 0.035, DEPTH / 2
    pieces = [(0, sink_x - w, 0, deep), (sink_x + w, width, 0, deep), (sink_x - w, sink_x + w, 0, z - d), (sink_x - w, sink_x + w, z + d, deep)]
    parts = []
    for x0, x1, z0, z1 in pieces:
        slab = box(x1 - x0, t, z1 - z0, 0.003)
        slab.uv = slab.uv + [(x0 + x1) / 2, (z0 + z1) / 2]
        parts.append(slab.at((x0 + x1) / 2, TOP - t / 2, (z0 + z1) / 2))
    return [("worktop", join(*parts))]


def hood(x, low=1.62, high=2.6):
    """A plastered chimney hood with an oak edge."""
    body = box(0.66, high - low - 0.05, 0.34, 0.01)
    return [("wall", body.at(x, (high + low + 0.05) / 2, 0.17)), ("oak", box(0.70, 0.055, 0.37, 0.006).at(x, low + 0.025, 0.185)), ("steel", box(0.52, 0.006, 0.24, 0.001).at(x, low - 0.003, 0.18))]


def wall_units(x0, x1, low=1.48, high=2.30, depth=0.34):
    n = max(1, int(round((x1 - x0) / 0.5)))
    w = (x1 - x0) / n
    parts = [("front sage", box(x1 - x0, high - low, depth - 0.02, 0.002).at((x0 + x1) / 2, (low + high) / 2, (depth - 0.02) / 2)), ("front sage", box(x1 - x0 + 0.02, 0.05, depth + 0.02, 0.006).at((x0 + x1) / 2, high + 0.02, depth / 2))]
    for k in range(n):
        parts += front(x0 + k * w, x0 + (k + 1) * w, low, high, depth - 0.02)
        parts += pull(x0 + (k + (0.88 if k % 2 == 0 else 0.12)) * w, low + 0.13, depth, 0.12, True)
    return parts + [(m, s.at((x0 + x1) / 2, low - 0.008, 0.22)) for m, s in light_strip(x1 - x0 - 0.08)]


def open_shelf(x0, x1, y, seed):
    """An oak board on brass brackets with crockery."""
    rng = np.random.default_rng(seed)
    parts = [("oak", box(x1 - x0, 0.032, 0.24, 0.004).at((x0 + x1) / 2, y, 0.12))]
    parts += [("brass", bent([(x, y - 0.13, 0.008), (x, y - 0.020, 0.008), (x, y - 0.020, 0.20)], 0.005, 8)) for x in (x0 + 0.10, x1 - 0.10)]
    x, y = x0 + 0.10, y + 0.017
    while x < x1 - 0.08:
        kind = rng.integers(0, 4)
        if kind == 0:
            plate = lathe([(0, 0), (0.06, 0), (0.105, 0.016), (0.107, 0.019), (0.06, 0.006), (0, 0.005)], 40)
            parts += [("stoneware", plate.at(x + 0.03, y + 0.008 * k, 0.12)) for k in range(6)]
            x += 0.27
        elif kind == 1:
            bowl = lathe([(0, 0), (0.03, 0), (0.055, 0.025), (0.064, 0.052), (0.060, 0.052), (0.05, 0.026), (0, 0.01)], 36)
            parts += [("stoneware dark" if k % 2 else "stoneware", bowl.at(x, y + 0.017 * k, 0.12)) for k in range(3)]
            x += 0.17
        elif kind == 2:
            parts += [("glass", tumbler().at(x + 0.08 * k, y, 0.08 + 0.08 * j)) for k in range(2) for j in range(2)]
            x += 0.19
        else:
            parts += mug(x, y, 0.10, "ceramic") + mug(x + 0.10, y, 0.14, "stoneware")
            x += 0.22
    return parts


def mug(x, y, z, material):
    cup = lathe([(0, 0), (0.036, 0), (0.040, 0.006), (0.041, 0.088), (0.038, 0.089), (0.036, 0.010), (0, 0.008)], 32)
    return [(material, join(cup, bent([(0.038, 0.07, 0), (0.075, 0.072, 0), (0.075, 0.02, 0), (0.038, 0.022, 0)], 0.005, 8)).at(x, y, z))]


def run(width=3.0, sink_x=0.9, hob_x=2.1):
    """Base units, worktop, tiles behind it, hob with hood, wall units and an open shelf."""
    parts = [("front dark", box(width, 0.10, DEPTH - 0.06).at(width / 2, 0.05, (DEPTH - 0.06) / 2)), ("front sage", box(width, TOP - 0.13, 0.02).at(width / 2, (TOP + 0.07) / 2, 0.02))]
    parts += [("front sage", box(0.018, TOP - 0.13, DEPTH, 0.002).at(x, (TOP + 0.07) / 2, DEPTH / 2)) for x in (0.009, width - 0.009)]
    tiles = quad(width, 0.74)
    parts += [("kitchen tile", tiles.at(width / 2, TOP + 0.37, 0.006)), ("front sage", box(width - 0.04, TOP - 0.15, DEPTH - 0.03).at(width / 2, (TOP + 0.05) / 2 - 0.12, (DEPTH - 0.03) / 2).scaled(1, 0.8, 1))]
    for k in range(int(round(width / UNIT))):
        x0, x1 = k * UNIT, (k + 1) * UNIT
        if x0 < hob_x < x1:
            parts += oven((x0 + x1) / 2)
            continue
        edges = (0.10, 0.38, 0.66, 0.87) if k % 2 else (0.10, 0.70, 0.87)
        for y0, y1 in zip(edges, edges[1:]):
            parts += front(x0, x1, y0, y1, DEPTH) + pull((x0 + x1) / 2, y1 - 0.05 if y1 - y0 > 0.2 else (y0 + y1) / 2, DEPTH + 0.018)
    parts += worktop(width, sink_x) + sink(sink_x) + hood(hob_x)
    parts.append(("black glass", box(0.58, 0.006, 0.51, 0.002).at(hob_x, TOP + 0.003, DEPTH / 2 + 0.01)))
    parts += wall_units(hob_x + 0.36, width) if width - hob_x > 0.8 else []
    parts += wall_units(0, 0.6) + open_shelf(0.64, hob_x - 0.38, 1.50, 4) + open_shelf(0.64, hob_x - 0.38, 1.88, 9)
    return parts


def tall_unit(width=0.62, height=2.32, depth=0.62):
    """Housing of the fridge: two framed doors with long handles. Left edge at x = 0."""
    parts = [("front sage", box(width, height - 0.10, depth - 0.02, 0.003).at(width / 2, height / 2 + 0.05, (depth - 0.02) / 2)), ("front dark", box(width, 0.10, depth - 0.08).at(width / 2, 0.05, (depth - 0.08) / 2)),
             ("front sage", box(width + 0.02, 0.05, depth + 0.04, 0.006).at(width / 2, height + 0.02, depth / 2))]
    for y0, y1 in ((0.10, 0.87), (0.87, height)):
        parts += front(0, width, y0, y1, depth - 0.02)
    return parts + pull(0.07, 0.70, depth, 0.24, True) + pull(0.07, 1.20, depth, 0.40, True)


def pots():
    """A casserole and a pan for the hob."""
    body = [(0, 0), (0.105, 0), (0.112, 0.006), (0.114, 0.105), (0.117, 0.110), (0.112, 0.110), (0.109, 0.012), (0, 0.008)]
    lid = [(0.118, 0.110), (0.118, 0.116), (0.06, 0.134), (0, 0.140)]
    knob = cylinder(0.018, 0.022, 24).at(0, 0.138, 0)
    ears = [bent([(s * 0.11, 0.085, -0.035), (s * 0.15, 0.088, -0.035), (s * 0.15, 0.088, 0.035), (s * 0.11, 0.085, 0.035)], 0.006, 8) for s in (-1, 1)]
    pan = lathe([(0, 0), (0.09, 0), (0.118, 0.038), (0.121, 0.040), (0.121, 0.040), (0.115, 0.038), (0.088, 0.006), (0, 0.005)], 40)
    return [("enamel", join(lathe(body, 44), lathe(lid, 44), *ears)), ("brass", knob), ("black", join(pan.at(0.27, 0, 0.18), tube([(0.34, 0.04, 0.26), (0.44, 0.06, 0.38)], 0.010, 10)))]


def kettle():
    body = [(0, 0), (0.078, 0), (0.086, 0.008), (0.084, 0.06), (0.066, 0.13), (0.046, 0.158), (0.018, 0.166), (0.014, 0.172), (0.016, 0.184), (0, 0.188)]
    return [("black", lathe(body, 44)), ("oak", bent([(0.062, 0.13, 0), (0.11, 0.19, 0), (0.14, 0.13, 0), (0.13, 0.05, 0)], 0.009, 12)), ("black", tube([(-0.06, 0.06, 0), (-0.105, 0.10, 0), (-0.13, 0.16, 0), (-0.15, 0.165, 0)], [0.012, 0.008, 0.005, 0.004], 12))]


def boards():
    """Two cutting boards that lean against the wall behind them at z = 0."""
    return [("oak", box(0.27, 0.40, 0.018, 0.008).turned(-9, 0).at(0, 0.198, 0.045)), ("oak dark", box(0.20, 0.28, 0.016, 0.008).turned(-12, 0).at(0.13, 0.138, 0.085))]


def jars(seed=2):
    """Three storage jars with oak lids and a pot of wooden spoons."""
    rng = np.random.default_rng(seed)
    parts = []
    for k, (r, h) in enumerate(((0.052, 0.17), (0.046, 0.135), (0.042, 0.10))):
        x = 0.115 * k
        parts += [("ceramic", lathe([(0, 0), (r - 0.004, 0), (r, 0.006), (r, h - 0.008), (r - 0.006, h), (0, h)], 36).at(x, 0, 0)), ("oak", cylinder(r - 0.002, 0.018, 36).at(x, h, 0))]
    parts.append(("stoneware dark", lathe([(0, 0), (0.045, 0), (0.05, 0.01), (0.05, 0.14), (0.046, 0.14), (0.046, 0.02), (0, 0.02)], 36).at(0.38, 0, 0.03)))
    for _ in range(5):
        a, lean, h = rng.uniform(0, 6.28), rng.uniform(0.015, 0.035), rng.uniform(0.24, 0.31)
        top = np.array([0.38 + lean * 1.6 * np.cos(a), h, 0.03 + lean * 1.6 * np.sin(a)])
        parts.append(("oak", tube([(0.38 - lean * 0.5 * np.cos(a), 0.03, 0.03 - lean * 0.5 * np.sin(a)), top - [0, 0.06, 0], top - [0, 0.03, 0], top], [0.005, 0.005, 0.019, 0.010], 12)))
    return parts
