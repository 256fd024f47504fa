"""Pictures that tile: wood, tiles, cloth, paintings. Values are sRGB 0..255; sizes in metres are set by uv()."""
import numpy as np


def noise(size, cells_x, cells_y, rng):
    """Smooth value noise -1..1 that tiles; size is (height, width)."""
    g = rng.uniform(-1, 1, (cells_y, cells_x))
    y, x = np.linspace(0, cells_y, size[0], endpoint=False), np.linspace(0, cells_x, size[1], endpoint=False)
    yi, xi = y.astype(int), x.astype(int)
    fy, fx = y - yi, x - xi
    fy, fx = (fy * fy * (3 - 2 * fy))[:, None], (fx * fx * (3 - 2 * fx))[None, :]
    y1, x1 = (yi + 1) % cells_y, (xi + 1) % cells_x
    top = g[np.ix_(yi, xi)] * (1 - fx) + g[np.ix_(yi, x1)] * fx
    low = g[np.ix_(y1, xi)] * (1 - fx) + g[np.ix_(y1, x1)] * fx
    return top * (1 - fy) + low * fy


def fractal(size, cells_x, cells_y, octaves, rng):
    return sum(noise(size, cells_x << k, cells_y << k, rng) / 2 ** k for k in range(octaves))


def normals_of(height, strength):
    """A normal map of a tiling height field; `strength` is the slope of one unit over one texel."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * strength / 2
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) * strength / 2
    n = np.stack([-dx, dy, np.ones_like(dx)], -1)
    return (n / np.linalg.norm(n, axis=-1, keepdims=True) + 1) * 127.5


def wood(base, rng, size=512, planks=8, joints=True):
    """Planks along the picture's width, with grain; returns colour and height."""
    h = w = size
    y, x = np.mgrid[0:h, 0:w]
    rows = y * planks // h
    shift = rng.integers(0, w, planks)
    grain = fractal((h, w), 4, 64, 3, rng)
    rings = fractal((h, w), 2, 16, 3, rng)
    tone = np.zeros((h, w))
    gap = np.zeros((h, w))
    for k in range(planks):
        mask = rows == k
        offset = int(shift[k])
        board = (x + offset) % w < w * 0.55
        tone += mask * np.where(board, rng.uniform(-1, 1), rng.uniform(-1, 1)) * 0.10
        tone += mask * np.roll(0.10 * np.sin(9 * rings + 4 * grain) + 0.07 * grain, offset, 1)
        if joints:
            edge = (y * planks % h < planks * 1.2) | (np.abs((x + offset) % w - w * 0.55) < 1.1) | ((x + offset) % w < 1.3)
            gap += mask * edge
    gap = np.minimum(gap, 1)
    colour = np.array(base)[None, None, :] * (1 + tone[..., None] * np.array([1.0, 1.1, 1.3])) * (1 - 0.45 * gap[..., None])
    return colour, 0.3 * grain - 3 * gap


def tiles(base, joint, rng, size=512, columns=4, rows=4, offset=False):
    h = w = size
    y, x = np.mgrid[0:h, 0:w]
    row = y * rows // h
    xs = (x + (w // columns // 2) * (row % 2)) % w if offset else x
    tx, ty = xs * columns % w / w, y * rows % h / h
    edge = np.minimum(np.minimum(tx, 1 - tx) / columns * w, np.minimum(ty, 1 - ty) / rows * h)
    gap = np.clip(1.8 - edge, 0, 1)
    tone = rng.uniform(-0.035, 0.035, (rows, columns))[row, (xs * columns // w) % columns] + 0.03 * fractal((h, w), 6, 6, 3, rng)
    colour = np.array(base)[None, None, :] * (1 + tone[..., None])
    colour = colour * (1 - gap[..., None]) + np.array(joint)[None, None, :] * gap[..., None]
    return colour, -2.5 * np.clip(3 - edge, 0, 3) / 3


def weave(base, rng, size=256, threads=48, contrast=0.16):
    """Cloth: threads over and under each other."""
    y, x = np.mgrid[0:size, 0:size] / size
    a, b = np.sin(2 * np.pi * threads * x), np.sin(2 * np.pi * threads * y)
    over = (np.floor(x * threads).astype(int) + np.floor(y * threads).astype(int)) % 2
    height = np.where(over, np.abs(a), np.abs(b))
    tone = contrast * (height - 0.6) + 0.06 * fractal((size, size), 8, 8, 3, rng)
    return np.array(base)[None, None, :] * (1 + tone[..., None]), height


def rug(rng, size=512):
    """A quiet geometric rug: cream ground, bands and lozenges in blue-grey and rust."""
    y, x = np.mgrid[0:size, 0:size] / size
    ground = np.ones((size, size, 1)) * np.array([214, 203, 184.0])
    u, v = (x * 6) % 1 - 0.5, (y * 4) % 1 - 0.5
    lozenge = np.abs(u) + np.abs(v)
    for low, high, colour in ((0.30, 0.36, (96, 108, 122)), (0.12, 0.17, (158, 96, 70))):
        mask = ((lozenge > low) & (lozenge < high))[..., None]
        ground = np.where(mask, np.array(colour, float), ground)
    border = np.minimum(np.minimum(x, 1 - x), np.minimum(y, 1 - y))
    ground = np.where(((border > 0.03) & (border < 0.045))[..., None], np.array([96, 108, 122.0]), ground)
    pile = fractal((size, size), 64, 64, 2, rng)
    return ground * (1 + 0.10 * pile[..., None]), pile


def painting(kind, rng, size=256):
    """Abstract pictures: 'hills', 'forms', 'strokes'."""
    y, x = np.mgrid[0:size, 0:size] / size
    out = np.ones((size, size, 3)) * np.array([236, 229, 216.0])
    if kind == "hills":
        out = out * (0.75 + 0.3 * y[..., None]) * np.array([0.93, 0.97, 1.05])
        for k, colour in enumerate(((168, 178, 180), (122, 146, 148), (84, 112, 110), (58, 78, 72), (46, 52, 48))):
            line = 0.38 + 0.13 * k + 0.07 * noise((1, size), 3 + k, 1, rng)[0] + 0.02 * noise((1, size), 11, 1, rng)[0]
            out = np.where((y > line[None, :])[..., None], np.array(colour, float), out)
    elif kind == "forms":
        for colour in ((190, 104, 70), (214, 170, 108), (72, 92, 104), (222, 206, 182)):
            cx, cy, a, b = rng.uniform(0.25, 0.75, 2).tolist() + rng.uniform(0.12, 0.32, 2).tolist()
            inside = ((x - cx) / a) ** 2 + ((y - cy) / b) ** 2 < 1 + 0.12 * noise((size, size), 5, 5, rng)
            out = np.where(inside[..., None], np.array(colour, float), out)
    else:
        field = fractal((size, size), 2, 9, 3, rng)
        for low, colour in ((0.2, (44, 62, 80)), (0.55, (120, 144, 156)), (0.85, (204, 160, 110))):
            out = np.where((field > low)[..., None], np.array(colour, float), out)
    return out * (1 + 0.03 * fractal((size, size), 48, 48, 2, rng)[..., None])
