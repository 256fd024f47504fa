"""Windows and doors. A window stands in the middle of its wall; a door in the plane z = 0."""
from shapes import bent, box, cylinder, join, quad


def window(width, height, leaves=2):
    """Frame and leaves with thin glass; lower edge at y = 0, the room towards +z."""
    parts = []

    def frame(w, h, x, y, t, d, z, sill_extra=0.0):
        for s in (-1, 1):
            parts.append(("window frame", box(t, h, d, 0.004).at(x + s * (w - t) / 2, y, z)))
        parts.append(("window frame", box(w - 2 * t, t, d, 0.004).at(x, y + (h - t) / 2, z)))
        parts.append(("window frame", box(w - 2 * t, t + sill_extra, d, 0.004).at(x, y - (h - t - sill_extra) / 2, z)))

    frame(width, height, 0, height / 2, 0.05, 0.07, 0)
    w = (width - 0.10) / leaves
    for k in range(leaves):
        x = (k - (leaves - 1) / 2) * w
        frame(w, height - 0.10, x, height / 2, 0.050, 0.050, 0.018)
        frame(w - 0.096, height - 0.196, x, height / 2, 0.010, 0.030, 0.018)
        parts.append(("glass", quad(w - 0.10, height - 0.20).at(x, height / 2, 0.016)))
        if k:
            handle_y = height / 2 - 0.08
            parts += [("steel", cylinder(0.016, 0.010, 20).turned(90, 0).at(x - w / 2 + 0.026, handle_y, 0.043)), ("steel", bent([(x - w / 2 + 0.026, handle_y, 0.045), (x - w / 2 + 0.026, handle_y, 0.085), (x - w / 2 + 0.026, handle_y - 0.13, 0.085)], 0.008, 10))]
    return parts


def sill(width, depth=0.24):
    """Inner board below a window; its back edge at z = 0."""
    return [("sill", box(width + 0.08, 0.028, depth, 0.008).at(0, -0.010, depth / 2))]


def casing(width, height, thickness):
    """Lining of a door's opening and architraves on both sides of the wall."""
    parts = [("door", box(0.022, height, thickness + 0.004, 0.002).at(s * (width / 2 - 0.011), height / 2, 0)) for s in (-1, 1)]
    parts.append(("door", box(width, 0.022, thickness + 0.004, 0.002).at(0, height - 0.011, 0)))
    for side in (-1, 1):
        z = side * (thickness / 2 + 0.008)
        for w, d, inset in ((0.075, 0.012, 0), (0.020, 0.020, 0.055)):
            parts += [("door", box(w, height + 0.06, d, 0.003).at(s * (width / 2 - 0.012 + inset + w / 2), (height + 0.06) / 2, z)) for s in (-1, 1)]
            parts.append(("door", box(width - 0.024 + 2 * (inset + w), w, d, 0.003).at(0, height - 0.012 + inset + w / 2, z)))
    return parts


def door(width=0.86, height=2.05, thickness=0.12, open_deg=0.0):
    """A panelled leaf in its casing; hinges at -x, the leaf opens towards +z."""
    w, h, t = width - 0.05, height - 0.034, 0.04
    stile = 0.115
    leaf = [("door", box(w, h, t - 0.016, 0.001).at(w / 2, h / 2 + 0.008, 0))]
    rails = ((0.008, 0.20), (0.86, 0.13), (h + 0.008 - stile, stile))
    leaf += [("door", box(stile, h, t, 0.002).at(x, h / 2 + 0.008, 0)) for x in (stile / 2, w - stile / 2)]
    leaf += [("door", box(w - 2 * stile + 0.002, size, t, 0.002).at(w / 2, y + size / 2, 0)) for y, size in rails]
    # Raised fields with a bevelled edge inside each frame.
    for (y0, s0), (y1, _) in zip(rails, rails[1:]):
        bottom, top = y0 + s0, y1
        leaf.append(("door", box(w - 2 * stile - 0.07, top - bottom - 0.07, t - 0.006, 0.007).at(w / 2, (bottom + top) / 2, 0)))
    for s in (-1, 1):
        x = w - 0.06
        leaf.append(("brass", join(cylinder(0.026, 0.006, 28).turned(90, 0).at(x, 1.03, t / 2 if s > 0 else -t / 2 - 0.006), bent([(x, 1.03, s * t / 2), (x, 1.03, s * 0.068), (x - 0.125, 1.03, s * 0.068)], 0.009, 12))))
    hinges = [("brass", cylinder(0.008, 0.09, 12).at(-width / 2 + 0.024, y, thickness / 2 - 0.005)) for y in (0.22, 1.72)]
    return casing(width, height, thickness) + hinges + [(m, p.turned(-open_deg).at(-width / 2 + 0.025, 0, thickness / 2 - t / 2 - 0.004)) for m, p in leaf]
