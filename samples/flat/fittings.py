"""Kitchen and bathroom fittings, doors and windows. Same conventions as furniture.py."""
import numpy as np

from shapes import bent, box, cylinder, grid, join, lathe, quad, sphere, tube


def kitchen_run(width=3.0, hob=-0.6, sink=0.75, depth=0.6):
    """Base units, worktop, sink, hob, oven, wall units, hood and splashback; the back is at z = 0, the front towards +z."""
    parts = [("front dark", box(width, 0.10, depth - 0.08).at(0, 0.05, (depth - 0.08) / 2)), ("front grey", box(width, 0.76, depth - 0.02, 0.002).at(0, 0.48, (depth - 0.02) / 2)),
             ("splashback", quad(width, 0.58).at(0, 1.19, 0.004))]
    units = int(round(width / 0.6))
    for k in range(units):
        x = (k - (units - 1) / 2) * width / units
        if abs(x - hob) < 0.3:
            parts += [("black glass", box(0.59, 0.58, 0.02, 0.004).at(x, 0.46, depth)), ("steel", tube([(x - 0.22, 0.70, depth + 0.045), (x + 0.22, 0.70, depth + 0.045)], 0.009)),
                      ("steel", box(0.59, 0.13, 0.02, 0.003).at(x, 0.80, depth))]
            continue
        for y, h in ((0.24, 0.28), (0.53, 0.28), (0.77, 0.18)) if k % 2 else ((0.385, 0.57), (0.77, 0.18)):
            parts += [("front grey", box(width / units - 0.004, h - 0.006, 0.02, 0.003).at(x, y, depth)), ("brass", box(0.16, 0.012, 0.014, 0.004).at(x, y + h / 2 - 0.035, depth + 0.02))]
    # The worktop leaves a hole for the sink.
    top, y, w2, d2 = "worktop", 0.88, 0.25, 0.19
    zc = depth / 2
    parts += [(top, box(width / 2 + sink - w2, 0.03, depth + 0.03, 0.004).at((-width / 2 + sink - w2) / 2, y, (depth + 0.03) / 2)),
              (top, box(width / 2 - sink - w2, 0.03, depth + 0.03, 0.004).at((width / 2 + sink + w2) / 2, y, (depth + 0.03) / 2)),
              (top, box(2 * w2, 0.03, zc - d2, 0.002).at(sink, y, (zc - d2) / 2)), (top, box(2 * w2, 0.03, depth + 0.03 - zc - d2, 0.002).at(sink, y, (depth + 0.03 + zc + d2) / 2))]
    for s in (-1, 1):
        parts += [("steel", box(0.012, 0.20, 2 * d2).at(sink + s * (w2 + 0.004), y - 0.095, zc)), ("steel", box(2 * w2, 0.20, 0.012).at(sink, y - 0.095, zc + s * (d2 + 0.004)))]
    parts += [("steel", box(2 * w2 + 0.02, 0.008, 2 * d2 + 0.02).at(sink, y - 0.19, zc)), ("steel", cylinder(0.022, 0.05, 20).at(sink, y + 0.012, 0.07)),
              ("steel", bent([(sink, y + 0.02, 0.07), (sink, y + 0.42, 0.07), (sink, y + 0.40, 0.28), (sink, y + 0.22, 0.27)], 0.011, 12, 12))]
    parts.append(("black glass", box(0.56, 0.006, 0.50, 0.002).at(hob, y + 0.018, zc)))
    parts += [("steel", lathe([(0, 0), (0.10, 0), (0.105, 0.005), (0.105, 0.12), (0.10, 0.12), (0.10, 0.008), (0, 0.006)], 36).at(hob + 0.13, y + 0.022, zc - 0.08)),
              ("steel", tube([(hob + 0.235, y + 0.12, zc - 0.08), (hob + 0.40, y + 0.135, zc - 0.02)], 0.009))]
    # Wall units beside the hood, with a strip of light under them.
    for x0, x1 in ((-width / 2, hob - 0.3), (hob + 0.3, width / 2)):
        w, x = x1 - x0, (x0 + x1) / 2
        parts.append(("front white", box(w, 0.70, 0.34, 0.003).at(x, 1.83, 0.17)))
        n = max(1, int(round(w / 0.55)))
        parts += [("front white", box(w / n - 0.004, 0.694, 0.018, 0.003).at(x + (k - (n - 1) / 2) * w / n, 1.83, 0.349)) for k in range(n)]
        parts.append(("strip", quad(w - 0.1, 0.018).turned(90, 0).at(x, 1.478, 0.20)))
    parts += [("steel", box(0.60, 0.06, 0.46, 0.006).at(hob, 1.55, 0.23)), ("steel", box(0.28, 0.62, 0.26, 0.004).at(hob, 1.88, 0.13))]
    return parts


def tall_unit(width=0.6, height=2.18, depth=0.62):
    return [("front grey", box(width, height, depth, 0.003).at(0, height / 2, depth / 2)), ("front grey", box(width - 0.005, 1.30, 0.02, 0.003).at(0, 1.50, depth + 0.01)),
            ("front grey", box(width - 0.005, 0.72, 0.02, 0.003).at(0, 0.47, depth + 0.01)), ("brass", box(0.014, 0.45, 0.016, 0.004).at(-width / 2 + 0.06, 1.25, depth + 0.03)),
            ("brass", box(0.014, 0.30, 0.016, 0.004).at(-width / 2 + 0.06, 0.62, depth + 0.03))]


def kettle():
    return [("steel", lathe([(0, 0), (0.08, 0), (0.085, 0.01), (0.075, 0.12), (0.05, 0.17), (0.015, 0.18), (0.012, 0.20), (0, 0.205)], 36)),
            ("black", bent([(0.075, 0.05, 0), (0.15, 0.10, 0), (0.14, 0.20, 0), (0.05, 0.17, 0)], 0.009)), ("steel", tube([(-0.07, 0.09, 0), (-0.13, 0.15, 0)], 0.013))]


def basin_unit(width=0.9):
    parts = [("oak", box(width, 0.42, 0.46, 0.006).at(0, 0.56, 0.23)), ("front white", box(width - 0.01, 0.20, 0.018).at(0, 0.665, 0.468)), ("front white", box(width - 0.01, 0.20, 0.018).at(0, 0.455, 0.468)),
             ("brass", box(0.2, 0.012, 0.014, 0.004).at(0, 0.74, 0.485)), ("brass", box(0.2, 0.012, 0.014, 0.004).at(0, 0.53, 0.485)), ("worktop", box(width + 0.02, 0.025, 0.48, 0.004).at(0, 0.783, 0.24))]
    bowl = lathe([(0, 0), (0.12, 0), (0.19, 0.06), (0.21, 0.125), (0.205, 0.13), (0.198, 0.125), (0.175, 0.065), (0.10, 0.02), (0, 0.016)], 48).scaled(1, 1, 0.85)
    parts += [("porcelain", bowl.at(0, 0.796, 0.25)), ("chrome", cylinder(0.018, 0.20, 20).at(0, 0.796, 0.05)), ("chrome", bent([(0, 0.97, 0.05), (0, 1.03, 0.05), (0, 1.03, 0.17), (0, 0.98, 0.18)], 0.010)), ]
    return parts


def mirror(width, height):
    return [("mirror", quad(width, height).at(0, 0, 0.022)), ("frame black", box(width + 0.02, height + 0.02, 0.02, 0.003).at(0, 0, 0.01))]


def bathtub(length=1.7, width=0.75, height=0.56):
    """Long side along x, the back at z = 0. The hollow is a swollen bowl set into a rim."""
    n, m = 48, 14
    t = np.linspace(0, 2 * np.pi, n + 1)
    rings = []
    for a, b, y in ((length / 2, width / 2, 0), (length / 2, width / 2, height), (length / 2, width / 2, height), (length / 2 - 0.06, width / 2 - 0.06, height),
                    (length / 2 - 0.07, width / 2 - 0.07, height - 0.01), (length / 2 - 0.12, width / 2 - 0.10, height - 0.25), (length / 2 - 0.22, width / 2 - 0.16, height - 0.40), (0.02, 0.01, height - 0.42)):
        e = 0.28
        c, s = np.cos(t), -np.sin(t)
        rings.append(np.stack([a * np.sign(c) * np.abs(c) ** e, np.full_like(t, y), b * np.sign(s) * np.abs(s) ** e], -1))
    p = np.array(rings)
    outer = grid(p[:2], np.zeros_like(p[:2]), p[:2, :, :2]).smoothed()
    rim = grid(p[2:], np.zeros_like(p[2:]), p[2:, :, :2]).smoothed()
    return [("porcelain", join(outer, rim).at(0, 0, width / 2)), ("chrome", bent([(0.6, height, 0.06), (0.6, height + 0.14, 0.06), (0.6, height + 0.14, 0.20)], 0.014))]


def toilet():
    bowl = lathe([(0, 0), (0.11, 0), (0.11, 0.12), (0.15, 0.28), (0.19, 0.38), (0.19, 0.40), (0.15, 0.40), (0.13, 0.36), (0.06, 0.24), (0, 0.22)], 40).scaled(1, 1, 1.3)
    lid = lathe([(0, 0.01), (0.18, 0.01), (0.195, 0.02), (0.19, 0.032), (0, 0.036)], 40).scaled(1, 1, 1.28)
    return [("porcelain", bowl.at(0, 0, 0.36)), ("porcelain", lid.at(0, 0.40, 0.36)), ("porcelain", box(0.38, 0.36, 0.16, 0.02).at(0, 0.60, 0.085)), ("porcelain", box(0.20, 0.36, 0.16, 0.03).at(0, 0.2, 0.1)),
            ("chrome", cylinder(0.02, 0.008, 20).at(0, 0.782, 0.085))]


def towel(width=0.5, length=0.7, material="towel"):
    rail = tube([(-width / 2 - 0.06, 0, 0.07), (width / 2 + 0.06, 0, 0.07)], 0.008)
    cloth = box(width, length, 0.022, 0.010, steps=6).at(0, -length / 2 + 0.012, 0.07)
    return [("chrome", rail), (material, cloth.moved(lambda p: np.outer(0.008 * np.sin(14 * p[:, 0] + 2 * p[:, 1]), [0, 0, 1])))]


def window(width, height, leaves=2):
    """Frame, leaves with thin glass and a sill inside (+z); lower edge at y = 0, in the middle of the wall."""
    parts = []

    def frame(w, h, x, y, t, d, z):
        for s in (-1, 1):
            parts.append(("window frame", box(t, h, d, 0.004).at(x + s * (w - t) / 2, y, z)))
            parts.append(("window frame", box(w - 2 * t, t, d, 0.004).at(x, y + s * (h - t) / 2, z)))

    frame(width, height, 0, height / 2, 0.05, 0.07, 0)
    w = (width - 0.10) / leaves
    for k in range(leaves):
        x = (k - (leaves - 1) / 2) * w
        frame(w, height - 0.10, x, height / 2, 0.055, 0.055, 0.012)
        parts.append(("glass", quad(w - 0.10, height - 0.20).at(x, height / 2, 0.01)))
        if k:
            parts.append(("steel", box(0.018, 0.12, 0.02, 0.006).at(x - w / 2 + 0.03, height / 2 - 0.1, 0.055)))
    return parts


def door(width=0.86, height=2.05, thickness=0.12, open_deg=0.0):
    """Frame and leaf; the opening stands in the plane z = 0, hinges at -x, the leaf opens towards +z."""
    parts = []
    for side in (-1, 1):
        z = side * (thickness / 2 + 0.006)
        parts += [("door", box(0.07, height + 0.07, 0.014, 0.003).at(s * (width / 2 + 0.025), (height + 0.07) / 2, z)) for s in (-1, 1)]
        parts.append(("door", box(width - 0.02, 0.07, 0.014, 0.003).at(0, height + 0.035, z)))
    parts += [("door", box(0.018, height, thickness, 0.002).at(s * (width / 2 - 0.009), height / 2, 0)) for s in (-1, 1)]
    parts.append(("door", box(width, 0.018, thickness, 0.002).at(0, height - 0.009, 0)))
    w = width - 0.04
    leaf = [("door", box(w, height - 0.03, 0.04, 0.003).at(w / 2, (height - 0.03) / 2 + 0.006, 0))]
    for y, h in ((0.58, 0.72), (1.45, 0.80)):
        leaf.append(("door", box(w - 0.26, h, 0.052, 0.008).at(w / 2, y, 0)))
    for s in (-1, 1):
        leaf.append(("brass", bent([(w - 0.07, 1.02, s * 0.02), (w - 0.07, 1.02, s * 0.065), (w - 0.19, 1.02, s * 0.065)], 0.009)))
    parts += [(m, p.turned(-open_deg).at(-width / 2 + 0.02, 0, 0.02)) for m, p in leaf]
    return parts


def ceiling_lamp(radius=0.17):
    return [("black metal", cylinder(radius, 0.02, 40).at(0, -0.02, 0)), ("globe hall", lathe([(0, -0.09), (radius * 0.6, -0.08), (radius * 0.92, -0.045), (radius * 0.95, -0.02)], 40))]


def bottles():
    tall = lathe([(0, 0), (0.03, 0), (0.032, 0.004), (0.032, 0.13), (0.012, 0.16), (0.012, 0.19), (0, 0.19)], 24)
    return [("ceramic", tall), ("pillow blue", tall.scaled(1, 0.7, 1).at(0.08, 0, 0.02)), ("soap", sphere(0.03).scaled(1.3, 0.5, 1).at(0.16, 0.015, 0.01))]
