"""Dining table, chairs and what stands on the table."""
import numpy as np

from furniture_living import corners
from shapes import box, join, lathe, loft, rounded_ring, sphere, tube


def dining_table(length=1.9, width=0.92, h=0.74):
    """Rounded oak top on tapered legs."""
    def outline(inset, y):
        return rounded_ring(length / 2 - inset, width / 2 - inset, y, 8, 96)

    top = loft([outline(0.5, h - 0.028), outline(0.05, h - 0.028), outline(0.012, h - 0.018), outline(0, h - 0.008), outline(0.001, h - 0.002), outline(0.004, h), outline(0.44, h)], [1, 5])
    # Grain follows the table's length over the whole top.
    top.uv = top.positions[:, [0, 2]].copy()
    parts = [("oak", top)]
    parts += [("oak", box(length - 0.42, 0.075, 0.022, 0.003).at(0, h - 0.064, s * (width / 2 - 0.13))) for s in (-1, 1)]
    parts += [("oak", box(0.022, 0.075, width - 0.30, 0.003).at(s * (length / 2 - 0.19), h - 0.064, 0)) for s in (-1, 1)]
    parts.append(("oak", join(*[tube([(x, h - 0.03, z), (x * 1.07, 0, z * 1.10)], [0.031, 0.017], 18) for x, z in corners(length / 2 - 0.17, width / 2 - 0.13)])))
    return parts


def chair(frame="oak"):
    """A wooden chair with a bent rail round its back and a seat of woven cord."""
    a = np.linspace(-0.62 * np.pi, 0.62 * np.pi, 33)
    rail = np.stack([0.275 * np.sin(a), 0.725 - 0.035 * (np.abs(a) / a[-1]) ** 2, 0.02 - 0.275 * np.cos(a)], -1)
    parts = [tube(rail, 0.013 + 0.007 * np.cos(a * 0.75) ** 2, 14)]
    for s in (-1, 1):
        parts.append(tube([(s * 0.232, 0.47, 0.20), (s * 0.228, 0.42, 0.20), (s * 0.235, 0, 0.215)], [0.015, 0.019, 0.012], 14))
        back = np.array([(s * 0.205, 0, -0.215), (s * 0.195, 0.24, -0.20), (s * 0.195, 0.43, -0.185), (s * 0.215, 0.58, -0.155), (s * 0.245, 0.715, -0.105)])
        parts.append(tube(back, [0.012, 0.017, 0.019, 0.015, 0.012], 14))
        parts += [tube([(s * 0.215, 0.25, 0.205), (s * 0.197, 0.25, -0.20)], [0.011, 0.009], 10), tube([(s * 0.228, 0.415, 0.20), (s * 0.195, 0.415, -0.185)], 0.013, 10)]
        parts.append(tube([(s * 0.004, 0.565, -0.222), (s * 0.05, 0.63, -0.238), (s * 0.105, 0.715, -0.236)], [0.011, 0.010, 0.008], 10))
    parts.append(tube([(0, 0.42, -0.185), (0, 0.50, -0.208), (0, 0.575, -0.224)], [0.013, 0.011, 0.012], 10))
    parts += [tube([(-0.228, 0.415, 0.20), (0.228, 0.415, 0.20)], 0.014, 10), tube([(-0.195, 0.415, -0.185), (0.195, 0.415, -0.185)], 0.013, 10), tube([(-0.205, 0.20, 0.0), (0.205, 0.20, 0.0)], 0.009, 10)]
    # The seat: narrower behind, lower in its middle.

    def shape_seat(p):
        x, z = p[:, 0] / 0.23, p[:, 2] / 0.20
        return np.stack([-p[:, 0] * 0.075 * (1 - z), -0.016 * (1 - x ** 2) * (1 - z ** 2), 0 * x], -1)

    seat = box(0.46, 0.028, 0.41, 0.013, steps=9).moved(shape_seat).at(0, 0.432, 0.008)
    return [(frame, join(*parts)), ("cord", seat)]


def bowl_of_fruit():
    bowl = [(0, 0), (0.055, 0), (0.06, 0.006), (0.10, 0.026), (0.145, 0.070), (0.152, 0.084), (0.148, 0.084), (0.14, 0.070), (0.095, 0.030), (0.05, 0.014), (0, 0.012)]
    parts = [("ceramic", lathe(bowl, 56))]
    fruit = (("orange", 0.050, 0.020, 0.066, 0.039), ("orange", -0.042, 0.045, 0.066, 0.038), ("lemon", 0.010, -0.058, 0.062, 0.033), ("orange", 0.004, 0.004, 0.112, 0.038), ("lemon", -0.062, -0.028, 0.064, 0.032))
    for k, (material, x, z, y, r) in enumerate(fruit):
        body = sphere(r, 24)
        if material == "lemon":
            body = body.moved(lambda p: np.outer(np.sign(p[:, 0]) * np.maximum(np.abs(p[:, 0]) / 0.032 - 0.8, 0) * 0.03, [1, 0, 0])).turned(40 * k, 1)
        parts.append((material, body.scaled(1, 0.94, 1).at(x, y, z)))
    return parts


def place_setting(mat="linen mat"):
    """A mat with plate, bowl and glass."""
    plate = [(0, 0), (0.07, 0), (0.085, 0.004), (0.132, 0.016), (0.134, 0.018), (0.130, 0.018), (0.085, 0.009), (0, 0.006)]
    bowl = [(0, 0), (0.032, 0), (0.036, 0.006), (0.062, 0.028), (0.070, 0.052), (0.067, 0.052), (0.058, 0.030), (0.03, 0.010), (0, 0.009)]
    return [(mat, box(0.44, 0.003, 0.32, 0.0014).at(0, 0.0015, 0)), ("stoneware", lathe(plate, 48).at(0, 0.003, 0)), ("stoneware dark", lathe(bowl, 40).at(0, 0.010, 0)), ("glass", tumbler().at(0.16, 0.004, -0.13))]


def tumbler(radius=0.034, height=0.10):
    """Thin-walled glass: one skin outside, one closed bottom."""
    return lathe([(0, 0.001), (radius * 0.86, 0.001), (radius * 0.88, 0.004), (radius, height)], 32)
