"""Pictures that tile: wood, stone, tiles, cloth, paintings. Values are sRGB 0..255, size (height, width); how many metres one
repetition covers is said where a material is made. Most return (colour, height); normals_of() makes a normal map of a height."""
import numpy as np


def noise(size, cells_x, cells_y, rng):
    """Smooth value noise -1..1 that tiles."""
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


def shaded(base, tone):
    """A colour made lighter and darker by `tone`; dark parts become a little more saturated, as wood and cloth do."""
    return np.array(base, float) * (1 + tone[..., None] * np.array([1.0, 1.12, 1.3]))


def wood(base, rng, size=768, boards=3, joints=False):
    """Boards along the picture's width: growth rings cut at a slant, pores, a tone of its own for every board."""
    y, x = np.mgrid[0:size, 0:size] / size
    row = (y * boards).astype(int) % boards
    within = y * boards - row
    tone, height, gap = np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, size))
    sway, fine, pores = fractal((size, size), 2, 6, 3, rng), fractal((size, size), 6, 110, 3, rng), fractal((size, size), 22, 220, 2, rng)
    for k in range(boards):
        mask = row == k
        shift = int(rng.integers(0, size))
        split = rng.uniform(0.35, 0.65)
        along = np.roll(x, shift, 1)
        for piece in (0, 1) if joints else (0,):
            here = mask & ((along < split) == (piece == 0)) if joints else mask
            heart, spread = rng.uniform(-0.4, 1.4), rng.uniform(5, 9)
            rings = np.sin(2 * np.pi * (spread * (within - heart) ** 2 + 0.55 * np.roll(sway, shift + 311 * piece, 1)) * 1.6)
            grain = 0.05 * rings + 0.07 * np.roll(fine, shift, 1) - 0.10 * np.clip(np.roll(pores, shift, 1) - 0.45, 0, 1)
            tone[here] = (grain + rng.normal(0, 0.065 if joints else 0.035))[here]
            height[here] = (0.4 * fine - 1.2 * np.clip(pores - 0.45, 0, 1))[here]
        if joints:
            texel = 1 / size
            seam = (within < 1.6 * boards * texel) | (np.minimum(np.abs(along - split), np.minimum(along, 1 - along)) < 0.9 * texel)
            gap[mask & seam] = 1
    return shaded(base, tone) * (1 - 0.5 * gap[..., None]), height - 3 * gap


def tiles(base, joint, rng, size=512, columns=4, rows=4, offset=False, variation=0.04, dish=0.0):
    """Tiles with joints; `dish` makes each one tilt and bulge like hand-made ones."""
    y, x = np.mgrid[0:size, 0:size] / size
    row = (y * rows).astype(int)
    xs = (x + (0.5 / columns) * (row % 2)) % 1 if offset else x
    column = (xs * columns).astype(int) % columns
    u, v = xs * columns % 1, y * rows % 1
    edge = np.minimum(np.minimum(u, 1 - u) / columns, np.minimum(v, 1 - v) / rows) * size
    gap = np.clip(2.0 - edge, 0, 1)
    tone = rng.normal(0, variation, (rows, columns))[row, column] + 0.03 * fractal((size, size), 6, 6, 4, rng)
    colour = np.array(base, float) * (1 + tone[..., None])
    tilt = (rng.uniform(-1, 1, (rows, columns))[row, column] * (u - 0.5) + rng.uniform(-1, 1, (rows, columns))[row, column] * (v - 0.5)) * 6 + 1.5 * fractal((size, size), 10, 10, 2, rng)
    height = -3.0 * np.clip(3.5 - edge, 0, 3.5) / 3.5 + dish * tilt * (edge > 3)
    return colour * (1 - gap[..., None]) + np.array(joint, float) * gap[..., None], height


def stone(base, rng, size=512, veins=0.10, chips=0):
    """Polished stone with soft veins, or terrazzo with `chips` sorts of grains."""
    field = fractal((size, size), 3, 3, 5, rng)
    vein = np.exp(-np.abs(fractal((size, size), 2, 2, 5, rng)) * 16)
    colour = np.array(base, float) * (1 + 0.03 * field - veins * vein)[..., None]
    for k in range(chips):
        grains = noise((size, size), 46 + 9 * k, 46 + 7 * k, rng) > 0.55
        tint = np.array(((120, 108, 94), (206, 198, 186), (158, 128, 104))[k % 3], float)
        colour = np.where(grains[..., None], tint * (1 + 0.05 * field[..., None]), colour)
    return colour


def plaster(rng, size=512):
    """Height of a wall painted with a roller."""
    return fractal((size, size), 28, 28, 4, rng)


def weave(base, rng, size=256, threads=40, contrast=0.07, melange=0.022):
    """Cloth: threads over and under each other, every one a little different."""
    y, x = np.mgrid[0:size, 0:size] / size
    i, j = (x * threads).astype(int), (y * threads).astype(int)
    a, b = np.abs(np.sin(np.pi * threads * x)), np.abs(np.sin(np.pi * threads * y))
    over = (i + j) % 2 == 0
    height = np.where(over, a ** 0.5 * (0.6 + 0.4 * b), b ** 0.5 * (0.6 + 0.4 * a))
    thread = np.where(over, rng.normal(0, melange, threads)[i], rng.normal(0, melange, threads)[j])
    return shaded(base, contrast * (height - 0.7) + thread + 0.03 * fractal((size, size), 6, 6, 3, rng)), height


def boucle(base, rng, size=384):
    """Loops of thick yarn."""
    lumps = np.abs(fractal((size, size), 34, 34, 3, rng))
    return shaded(base, 0.16 * (np.clip(lumps, 0, 0.8) - 0.4)), np.clip(lumps, 0, 0.8) * 2.2


def knit(base, rng, size=256, columns=18, rows=14):
    """Stocking stitch: columns of v-shaped loops."""
    y, x = np.mgrid[0:size, 0:size] / size
    u = x * columns % 1 - 0.5
    loop = np.abs(np.sin(np.pi * (y * rows + np.abs(u) * 0.9)))
    height = loop * np.sqrt(np.clip(1 - (np.abs(u) * 2 - 0.5) ** 2 * 3, 0, 1))
    return shaded(base, 0.22 * (height - 0.6) + 0.04 * fractal((size, size), 12, 12, 2, rng)), height * 2


def cord(base, rng, size=256, strands=22):
    """Paper cord wound side by side."""
    y, x = np.mgrid[0:size, 0:size] / size
    round_ = np.abs(np.sin(np.pi * strands * y))
    twist = 0.5 + 0.5 * np.sin(2 * np.pi * (x * 40 + y * strands))
    return shaded(base, 0.20 * (round_ ** 0.5 - 0.8) + 0.05 * twist + rng.normal(0, 0.04, strands)[(y * strands).astype(int)]), round_ ** 0.5 * 2.5


def wicker(base, rng, size=256, strands=8):
    y, x = np.mgrid[0:size, 0:size] / size
    over = np.sin(2 * np.pi * x * strands) * np.where((y * strands).astype(int) % 2, 1, -1)
    return shaded(base, 0.14 * over + 0.10 * fractal((size, size), 16, 16, 3, rng)), over


def rug(rng, size=768):
    """A hand-knotted rug: undyed wool with a lattice of dark lines, not quite straight."""
    y, x = np.mgrid[0:size, 0:size] / size
    wx, wy = 0.012 * fractal((size, size), 5, 5, 3, rng), 0.012 * fractal((size, size), 5, 5, 3, rng)
    pile = fractal((size, size), 120, 120, 2, rng)
    u, v = (x + wx) * 4, (y + wy) * 4
    lines = np.minimum(np.abs((u + v) % 1 - 0.5), np.abs((u - v) % 1 - 0.5)) + 0.004 * pile
    dots = np.hypot((u + v) % 1 - 0.0, (u - v) % 1 - 0.0)
    dark = np.maximum(np.clip(1 - (lines - 0.020) / 0.010, 0, 1), np.clip(1 - (dots - 0.05) / 0.02, 0, 1))
    border = np.minimum(x, 1 - x)
    dark = np.maximum(dark * (border > 0.05), (np.abs(border - 0.035) < 0.006) * 0.9)
    ground = np.array([206, 196, 178.0]) * (1 + 0.05 * fractal((size, size), 9, 30, 3, rng) + 0.07 * pile)[..., None]
    return ground * (1 - 0.72 * dark[..., None]), pile * 1.4 - 0.4 * dark
