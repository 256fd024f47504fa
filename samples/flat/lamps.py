"""Lamps. Emitting materials and their luminous flux are in materials.py; a glowing shade stands for the light that cloth lets
through, the bulb inside for the rest."""
import numpy as np

from shapes import box, cylinder, join, lathe, sphere, tube

BULB = 0.035  # radius of the large bulbs
DRUM = (0.21, 0.24)       # floor lamp's shade: radius, height
SMALL_DRUM = (0.115, 0.15)  # bedside lamp's
TABLE_DRUM = (0.15, 0.19)
GLOBE = 0.10
STRIP_WIDTH = 0.014


def cylinder_area(radius, height):
    return 2 * np.pi * radius * height


def sphere_area(radius):
    return 4 * np.pi * radius * radius


def drum(radius, height, glow):
    """A cloth drum open above and below, from y = 0 up: glowing outside, a white lining inside, a metal spider."""
    outside = lathe([(radius, 0), (radius, height)], 56)
    inside = lathe([(radius - 0.002, height), (radius - 0.002, 0)], 56)
    rims = [lathe([(radius - 0.003, y - 0.003), (radius + 0.0015, y - 0.003), (radius + 0.0015, y + 0.003), (radius - 0.003, y + 0.003)], 56) for y in (0.002, height - 0.002)]
    spider = [tube([(0, height - 0.02, 0), (radius * np.cos(a), height - 0.01, radius * np.sin(a))], 0.002, 6) for a in (0, 2.09, 4.19)]
    return [(glow, outside), ("shade lining", inside), ("shade rim", join(*rims)), ("black metal", join(*spider))]


def floor_lamp(height=1.52):
    """Three oak legs, a drum of linen."""
    parts = []
    for k in range(3):
        a = np.radians(90 + 120 * k)
        parts.append(("oak", tube([(0.02 * np.cos(a), height - 0.22, 0.02 * np.sin(a)), (0.25 * np.cos(a), 0, 0.25 * np.sin(a))], [0.015, 0.011], 14)))
    parts += [("brass", cylinder(0.034, 0.05, 28).at(0, height - 0.26, 0)), ("brass", tube([(0, height - 0.22, 0), (0, height - 0.11, 0)], 0.010, 12))]
    parts += [(m, s.at(0, height - DRUM[1], 0)) for m, s in drum(*DRUM, "shade floor")]
    return parts + [("bulb floor", sphere(BULB, 24).at(0, height - 0.08, 0))]


def table_lamp(small=True):
    """A ceramic foot with a small drum. The small one has no bulb of its own: its light is a point lamp in the file."""
    radius, height = SMALL_DRUM if small else TABLE_DRUM
    k = 1.0 if small else 1.35
    foot = [(0, 0), (0.050, 0), (0.056, 0.006), (0.074, 0.045), (0.078, 0.075), (0.066, 0.115), (0.034, 0.145), (0.016, 0.158), (0.014, 0.17)]
    parts = [("stoneware" if small else "stoneware dark", lathe([(r * k, y * k) for r, y in foot], 44)), ("brass", tube([(0, 0.165 * k, 0), (0, 0.165 * k + height - 0.03, 0)], 0.006, 10))]
    parts += [(m, s.at(0, 0.185 * k, 0)) for m, s in drum(radius, height, "shade bed" if small else "shade table")]
    return parts if small else parts + [("bulb table", sphere(0.028, 20).at(0, 0.165 * k + height * 0.55, 0))]


def pendant(drop, radius=0.21):
    """A spun metal dome below y = 0, white inside, on a cloth-covered cable; the rim hangs at -drop."""
    a = np.linspace(0, 1, 15)
    r, y = radius * np.sin(a * np.pi / 2) ** 0.85, radius * 0.82 * np.cos(a * np.pi / 2) ** 1.15
    outer = [(max(q, 0.022), h + 0.001) for q, h in zip(r[::-1], y[::-1])]
    inner = [(max(q - 0.003, 0.018), h - 0.002) for q, h in zip(r, y)]
    top = -drop + radius * 0.82
    return [("black metal", tube([(0, 0, 0), (0, top + 0.03, 0)], 0.003, 8)), ("black metal", cylinder(0.055, 0.022, 36).at(0, -0.022, 0)), ("brass", cylinder(0.022, 0.055, 24).at(0, top - 0.012, 0)),
            ("pendant", lathe(outer, 56).at(0, -drop, 0)), ("pendant inside", lathe(inner, 56).at(0, -drop, 0)), ("bulb dining", sphere(BULB, 24).at(0, -drop + 0.065, 0)),
            ("brass", cylinder(0.014, 0.05, 16).at(0, -drop + 0.095, 0))]


def globe_lamp():
    """An opal globe close under the ceiling, at y = 0."""
    return [("brass", cylinder(0.06, 0.02, 36).at(0, -0.02, 0)), ("brass", cylinder(0.032, 0.03, 28).at(0, -0.05, 0)), ("globe", sphere(GLOBE, 40).at(0, -0.05 - GLOBE * 0.95, 0))]


def mirror_lamp(length=0.7):
    """An opal tube along x before a wall at z = 0."""
    return [("tube bath", tube([(-length / 2, 0, 0.07), (length / 2, 0, 0.07)], 0.016, 20)), ("chrome", join(*[tube([(s * length / 2, 0, 0.07), (s * (length / 2 + 0.02), 0, 0.07)], 0.018, 20) for s in (-1, 1)])),
            ("chrome", box(0.12, 0.03, 0.06, 0.004).at(0, 0, 0.03))]


def light_strip(length):
    """Glows downwards from a slim profile at y = 0."""
    profile = box(length, 0.008, STRIP_WIDTH + 0.006, 0.001).at(0, 0.004, 0)
    strip = box(length - 0.01, 0.002, STRIP_WIDTH, 0.0005).at(0, -0.001, 0)
    return [("steel", profile), ("strip", strip)]
