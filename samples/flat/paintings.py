"""Pictures for the walls."""
import numpy as np

from textures import fractal, noise

PAPER = np.array([233, 226, 212.0])


def _finish(out, rng):
    return out * (1 + 0.025 * fractal(out.shape[:2], 64, 64, 2, rng)[..., None])


def _over(out, mask, colour):
    """Paints a colour through a mask 0..1."""
    return out * (1 - mask[..., None]) + np.array(colour, float) * mask[..., None]


def hills(rng, size=512):
    """Layers of misty hills under a pale sun."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 1)) * PAPER * (0.80 + 0.22 * y[..., None]) * np.array([0.98, 0.985, 1.0])
    out = _over(out, np.clip((0.075 - np.hypot(x - 0.68, y - 0.24)) * size / 2, 0, 1), (214, 150, 104))
    for k, colour in enumerate(((188, 190, 182), (154, 166, 160), (116, 134, 128), (84, 104, 98), (60, 76, 72))):
        line = 0.40 + 0.115 * k + 0.085 * noise((1, size), 3 + k, 1, rng)[0] + 0.015 * noise((1, size), 14, 1, rng)[0]
        mist = np.clip((y - line[None, :]) / 0.30, 0, 1)
        out = _over(out, np.clip((y - line[None, :]) * size / 2, 0, 1), colour) + 22 * (mist * np.clip((y - line[None, :]) * size, 0, 1))[..., None] * (k < 4)
    return _finish(out, rng)


def forms(rng, size=512):
    """Cut-out arches and discs in earth colours."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 1)) * PAPER
    wobble = 0.006 * fractal((size, size), 6, 6, 2, rng)

    def arch(cx, foot, half, top, colour):
        nonlocal out
        inside = np.minimum(half - np.hypot(np.abs(x - cx), np.minimum(y - top - half, 0)), foot - y) + wobble
        out = _over(out, np.clip(inside * size / 1.5, 0, 1), colour)

    arch(0.42, 0.86, 0.27, 0.26, (186, 112, 82))
    arch(0.42, 0.86, 0.185, 0.36, (222, 184, 144))
    arch(0.42, 0.86, 0.10, 0.47, (64, 82, 88))
    out = _over(out, np.clip((0.115 - np.hypot(x - 0.73, y - 0.23) + wobble) * size / 1.5, 0, 1), (206, 158, 84))
    out = _over(out, np.clip((0.012 - np.abs(y - 0.86 + wobble)) * size / 1.5, 0, 1) * (np.abs(x - 0.5) < 0.38), (58, 56, 52))
    return _finish(out, rng)


def brush(rng, size=512):
    """Two sweeps of ink with dry edges."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 1)) * PAPER
    for cx, cy, r, wide, colour, start in ((0.47, 0.50, 0.27, 0.075, (44, 50, 56), 0.9), (0.62, 0.66, 0.15, 0.045, (176, 108, 78), 3.2)):
        radius, angle = np.hypot(x - cx, (y - cy) * 0.92), (np.arctan2(y - cy, x - cx) - start) % (2 * np.pi)
        bristles = noise((size, size), 3, 90, rng)
        streak = np.interp(radius.ravel(), np.linspace(0, 0.5, 160), rng.uniform(-1, 1, 160)).reshape(size, size)
        width = wide * (1 - 0.45 * angle / 6.28)
        ink = np.clip((width - np.abs(radius - r - 0.02 * np.sin(angle))) * size / 4, 0, 1)
        dry = np.clip(1.35 - 0.85 * angle / 5.2 + 0.6 * streak + 0.15 * bristles, 0, 1) * (angle < 5.4)
        out = _over(out, ink * dry, colour)
    return _finish(out, rng)


def botanical(rng, size=512):
    """A pressed fern."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 1)) * PAPER * np.array([1.0, 1.0, 0.99])
    stem = 0.5 + 0.05 * np.sin(3 * y)
    out = _over(out, np.clip((0.004 - np.abs(x - stem)) * size, 0, 1) * (y > 0.12) * (y < 0.92), (88, 96, 70))
    for k in range(15):
        at = 0.16 + 0.046 * k
        length, cx = 0.30 * np.sin(np.pi * (0.12 + 0.80 * k / 15)), 0.5 + 0.05 * np.sin(3 * at)
        for side in (-1, 1):
            a = np.radians(-28 + 20 * k / 15)
            u = (side * (x - cx) * np.cos(a) + (y - at) * np.sin(a)) / length
            v = (-side * (x - cx) * np.sin(a) + (y - at) * np.cos(a)) / length
            teeth = 1 + 0.25 * np.sin(50 * u)
            inside = 0.13 * np.sin(np.pi * np.clip(u, 0, 1)) ** 0.6 * teeth - np.abs(v)
            out = _over(out, np.clip(inside * length * size, 0, 1) * (u > 0) * (u < 1), (86 + 30 * (k % 3), 108 + 14 * (k % 2), 78))
    return _finish(out, rng)


def field(rng, size=512):
    """Two soft fields of colour."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 1)) * np.array([206, 190, 168.0])
    ragged = 0.012 * fractal((size, size), 9, 9, 3, rng)
    for y0, y1, colour in ((0.09, 0.52, (176, 112, 84)), (0.57, 0.91, (72, 88, 92))):
        edge = np.minimum(np.minimum(x - 0.09, 0.91 - x), np.minimum(y - y0, y1 - y)) + ragged
        cloud = 1 + 0.10 * fractal((size, size), 3, 5, 4, rng)
        out = _over(out, np.clip(edge / 0.03, 0, 1) * 0.94, np.array(colour)) * np.where(edge > 0, cloud, 1)[..., None]
    return _finish(out, rng)


ALL = {"picture hills": hills, "picture forms": forms, "picture brush": brush, "picture fern": botanical, "picture field": field}
