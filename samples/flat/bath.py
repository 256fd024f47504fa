"""Fittings of the bathroom and textiles for it. Wall pieces have their back at z = 0."""
import numpy as np

from cloth import boxes_distance, drape, fabric
from shapes import bent, box, cylinder, join, lathe, loft, quad, rounded_ring, tube


def bathtub(length=1.75, width=0.80, height=0.57):
    """A free-standing oval tub with a soft rim, its middle at the origin."""
    a, b = length / 2, width / 2
    outside = [rounded_ring(a * 0.78, b * 0.74, 0.0, 2.6, 72), rounded_ring(a * 0.80, b * 0.78, 0.02, 2.6, 72), rounded_ring(a * 0.86, b * 0.86, 0.20, 2.6, 72), rounded_ring(a * 0.94, b * 0.95, 0.42, 2.6, 72),
               rounded_ring(a * 0.99, b * 0.99, height - 0.03, 2.6, 72), rounded_ring(a, b, height - 0.012, 2.6, 72), rounded_ring(a - 0.008, b - 0.008, height, 2.6, 72)]
    inside = [rounded_ring(a - 0.022, b - 0.022, height - 0.004, 2.6, 72), rounded_ring(a - 0.034, b - 0.034, height - 0.03, 2.6, 72), rounded_ring(a * 0.86, b * 0.84, 0.34, 2.6, 72), rounded_ring(a * 0.78, b * 0.74, 0.20, 2.6, 72),
              rounded_ring(a * 0.68, b * 0.60, 0.14, 2.6, 72), rounded_ring(a * 0.40, b * 0.30, 0.125, 2.4, 72), rounded_ring(0.001, 0.001, 0.12, 2, 72)]
    return [("porcelain", loft(outside + inside)), ("brass", cylinder(0.032, 0.006, 28).at(0, 0.118, 0))]


def tub_filler(height=0.86):
    """A tap that stands on the floor; the spout reaches towards +z."""
    spout = bent([(0, 0, 0), (0, height, 0), (0, height, 0.20), (0, height - 0.07, 0.20)], 0.014, 14, 10)
    return [("brass", join(spout, cylinder(0.045, 0.012, 32), tube([(-0.07, height - 0.22, 0), (0.07, height - 0.22, 0)], 0.011, 12), cylinder(0.022, 0.045, 24).at(0, height - 0.245, 0)))]


def basin_unit(width=1.0):
    """A wall-hung oak cabinet with two drawers, a stone top and a round bowl."""
    parts = [("oak", box(width, 0.42, 0.46, 0.004).at(0, 0.56, 0.23)), ("worktop", box(width + 0.01, 0.02, 0.475, 0.003).at(0, 0.78, 0.2375))]
    for y, h in ((0.665, 0.203), (0.455, 0.203)):
        flutes = int(width / 0.02)
        parts.append(("oak", join(*[box(width / flutes - 0.0025, h - 0.005, 0.018, 0.006).at((k - (flutes - 1) / 2) * width / flutes, y, 0.466) for k in range(flutes)])))
    bowl = [(0, 0), (0.10, 0), (0.12, 0.004), (0.175, 0.045), (0.205, 0.105), (0.209, 0.125), (0.205, 0.128), (0.200, 0.122), (0.168, 0.052), (0.10, 0.018), (0.02, 0.013), (0, 0.012)]
    parts += [("porcelain", lathe(bowl, 64).at(0, 0.79, 0.26)), ("brass", join(cylinder(0.020, 0.015, 24).at(0, 0.79, 0.055), bent([(0, 0.79, 0.055), (0, 1.06, 0.055), (0, 1.06, 0.20), (0, 0.995, 0.205)], 0.011, 14, 10), tube([(0.02, 0.86, 0.055), (0.075, 0.88, 0.055)], 0.006, 10))),
              ("brass", cylinder(0.022, 0.004, 24).at(0, 0.803, 0.26))]
    return parts


def toilet():
    """Wall-hung, with its flush plate."""
    def ring(a, b, y, shift):
        return rounded_ring(a, b, y, 2.3, 48, shift)

    body = loft([ring(0.05, 0.06, 0.12, 0.16), ring(0.13, 0.17, 0.16, 0.20), ring(0.165, 0.235, 0.26, 0.245), ring(0.178, 0.262, 0.36, 0.265), ring(0.180, 0.266, 0.395, 0.268), ring(0.172, 0.258, 0.402, 0.268), ring(0.02, 0.02, 0.403, 0.268)])
    lid = loft([ring(0.02, 0.02, 0.405, 0.272), ring(0.180, 0.262, 0.405, 0.272), ring(0.185, 0.268, 0.412, 0.272), ring(0.184, 0.267, 0.430, 0.272), ring(0.172, 0.255, 0.437, 0.272), ring(0.0005, 0.0005, 0.440, 0.272)])
    return [("porcelain", join(body, lid, box(0.30, 0.26, 0.12, 0.03).at(0, 0.28, 0.05))), ("brass", box(0.235, 0.16, 0.012, 0.004).at(0, 1.02, 0.006)),
            ("brass", join(*[box(0.10, 0.12, 0.006, 0.002).at(s * 0.053, 1.02, 0.013) for s in (-1, 1)]))]


def wall_mirror(width, height, frame="brass"):
    return [("mirror", quad(width, height).at(0, 0, 0.022)), (frame, box(width + 0.016, height + 0.016, 0.020, 0.004).at(0, 0, 0.010))]


def towel_rail(width=0.55, length=0.72, material="towel"):
    """A rail with a towel folded over it."""
    rail = join(tube([(-width / 2 - 0.08, 0, 0.075), (width / 2 + 0.08, 0, 0.075)], 0.008, 12), *[tube([(s * (width / 2 + 0.05), 0, 0.0), (s * (width / 2 + 0.05), 0, 0.075)], 0.006, 10) for s in (-1, 1)])
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, 21), np.linspace(-1, 1, 41))
    fall = np.abs(v) ** 1.0
    drop = np.where(v < 0, length, length * 0.86) * np.maximum(fall - 0.03, 0)
    z = np.where(np.abs(v) < 0.03, 0.0, np.sign(v) * 0.016) + 0.010 * drop * np.sin(9 * u + 3 * v) + 0.075
    p = np.stack([u * width * (1 + 0.02 * np.sin(5 * v)), 0.012 - drop, z], -1)
    cloth = fabric(p, 0.007, 3)
    return [("brass", rail), (material, cloth)]


def ladder(height=1.7, width=0.45):
    """A towel ladder that leans against a wall behind it at -z, with a towel over a rung."""
    rails = [tube([(s * width / 2, 0, 0.32), (s * width / 2, height, 0.02)], 0.014, 12) for s in (-1, 1)]
    rungs = [tube([(-width / 2, y, 0.32 - 0.30 * y / height), (width / 2, y, 0.32 - 0.30 * y / height)], 0.011, 10) for y in (0.35, 0.70, 1.05, 1.40)]
    towel = towel_rail(0.36, 0.50, "towel white")[1][1].at(0, 1.40, 0.32 - 0.30 * 1.40 / height - 0.075)
    second = towel_rail(0.34, 0.42)[1][1].at(0, 0.70, 0.32 - 0.30 * 0.70 / height - 0.075)
    return [("oak", join(*rails, *rungs)), ("towel white", towel), ("towel", second)]


def stool_with_towel():
    """A small oak stool beside the tub; a towel lies over it."""
    legs = [tube([(0.10 * np.cos(a), 0.43, 0.10 * np.sin(a)), (0.155 * np.cos(a), 0, 0.155 * np.sin(a))], [0.016, 0.012], 12) for a in (0.8, 2.9, 5.0)]
    top = lathe([(0, -0.03), (0.15, -0.03), (0.165, -0.02), (0.165, -0.006), (0.158, 0), (0, 0)], 48).at(0, 0.45, 0)
    cloth = drape(0.30, 0.62, boxes_distance([((0, 0.228, 0), (0.335, 0.456, 0.335), 0.02)]), (0.02, 0.48, 0.06), 12, 0.025, 90, seed=2)
    return [("oak", join(top, *legs)), ("towel white", fabric(cloth, 0.008, 4, 0.003))]


def bottles():
    """Soap, a bottle and a beaker with brushes."""
    tall = lathe([(0, 0), (0.030, 0), (0.033, 0.004), (0.033, 0.115), (0.026, 0.130), (0.012, 0.136), (0.012, 0.15)], 32)
    pump = join(tube([(0, 0.145, 0), (0, 0.185, 0)], 0.005, 10), tube([(-0.008, 0.185, 0), (0.045, 0.182, 0)], 0.006, 10))
    beaker = lathe([(0, 0), (0.032, 0), (0.035, 0.004), (0.036, 0.095), (0.033, 0.095), (0.032, 0.01), (0, 0.01)], 32)
    brushes = [tube([(0.16 + 0.01 * k, 0.02, 0), (0.15 + 0.035 * k, 0.18, 0.01 * k)], 0.004, 8) for k in range(2)]
    return [("amber", tall), ("black", pump), ("amber", tall.scaled(0.9, 0.8, 0.9).at(0.08, 0, 0.025)), ("black", pump.at(0.08, -0.03, 0.025)), ("stoneware", beaker.at(0.165, 0, 0)), ("oak", join(*brushes))]


def shower_screen(width=0.9, height=2.0):
    """A pane of thin glass with slim black bars."""
    bars = [box(0.02, height, 0.02, 0.002).at(s * (width - 0.02) / 2, height / 2, 0) for s in (-1, 1)] + [box(width, 0.02, 0.02, 0.002).at(0, y, 0) for y in (0.01, height - 0.01)]
    bars += [box(width, 0.012, 0.012, 0.002).at(0, height * k / 4, 0) for k in (1, 2, 3)]
    return [("glass", quad(width - 0.03, height - 0.03).at(0, height / 2, 0)), ("black metal", join(*bars))]


def shower(height=2.1):
    """Rain shower on a wall pipe."""
    pipe = bent([(0, 1.0, 0.05), (0, height, 0.05), (0, height, 0.38)], 0.010, 12)
    head = lathe([(0, 0.0), (0.12, 0.0), (0.124, 0.006), (0.02, 0.016), (0.014, 0.05)], 48).at(0, height - 0.06, 0.38)
    mixer = join(tube([(-0.13, 1.0, 0.055), (0.13, 1.0, 0.055)], 0.020, 16), *[tube([(s * 0.08, 1.0, 0), (s * 0.08, 1.0, 0.055)], 0.012, 10) for s in (-1, 1)])
    return [("brass", join(pipe, head, mixer))]
