"""Soft things: cushions, pillows, curtains, and cloth that falls over furniture."""
import numpy as np

from shapes import Shape, box, cloth_noise, grid, join, rounded_ring, tube


def cushion(w, d, t, seed, r=0.05):
    """A seat cushion lying flat, its middle at the origin: rounded, swollen, a little uneven, with piping round its edges."""
    body = box(w, t, d, min(r, t * 0.45), bulge=(0.010, t * 0.16, 0.010), steps=9)
    body = body.moved(lambda p: np.outer(cloth_noise(p, 9, seed) * 0.004, [0, 1, 0]))
    return join(body, *[tube(rounded_ring(w / 2 - 0.004, d / 2 - 0.004, s * (t / 2 - 0.030), 9, 64), 0.0045, 6) for s in (-1, 1)])


def pillow(w, h, t, seed, steps=26):
    """A loose pillow standing in the plane z = 0: thick in the middle, pinched corners, edges drawn in."""
    u, v = np.meshgrid(np.linspace(-1, 1, steps), np.linspace(-1, 1, steps))
    u, v = np.sin(u * np.pi / 2), np.sin(v * np.pi / 2)
    x = w / 2 * u * (1 - 0.06 * np.cos(v * np.pi / 2) * np.abs(u))
    y = h / 2 * v * (1 - 0.06 * np.cos(u * np.pi / 2) * np.abs(v))
    full = ((1 - np.abs(u) ** 3) * (1 - np.abs(v) ** 3)).clip(0) ** 0.55
    sides = []
    for side in (1, -1):
        flat = np.stack([x, y, 0 * x], -1)
        # Creases run from the corners to the middle and fade there.
        folds = cloth_noise((flat * [1, 1, 0] + [0, 0, side]).reshape(-1, 3), 16 / max(w, h), seed).reshape(x.shape)
        z = side * (t / 2 * full + 0.014 * folds * full * (u * u + v * v) / 2)
        p = np.stack([x, y, z], -1)
        sides.append(grid(p if side > 0 else p[:, ::-1], np.zeros_like(p), np.stack([x, y], -1)).smoothed())
    return join(*sides)


def curtain(width, height, folds, seed=0, depth=0.045):
    """Cloth that hangs in folds, its top edge at y = 0: even pleats above, loose waves below."""
    u, v = np.meshgrid(np.linspace(0, 1, folds * 12 + 1), np.linspace(-height, 0, 26))
    rng = np.random.default_rng(seed)
    low = (-v / height) ** 0.7
    phase = 2 * np.pi * folds * u + low * (0.9 * np.sin(2 * np.pi * u * 1.7 + rng.uniform(0, 6)) + 0.5 * np.sin(2 * np.pi * u * 3.1 + rng.uniform(0, 6)))
    swell = 1 + 0.35 * low * np.sin(2 * np.pi * u * folds / 2.6 + rng.uniform(0, 6))
    z = depth * swell * (np.sin(phase) + 0.15 * np.sin(2 * phase + 1))
    x = (u - 0.5) * width * (1 + 0.05 * low) + 0.010 * np.sin(2 * phase)
    p = np.stack([x, v, z], -1)
    return grid(p, np.zeros_like(p), np.stack([u * width * 2.2, v], -1)).smoothed()


def boxes_distance(boxes):
    """Signed distance to a union of rounded boxes, each (centre, size, radius)."""
    def distance(p):
        best = np.full(p.shape[:-1], np.inf)
        for centre, size, radius in boxes:
            q = np.abs(p - np.array(centre)) - (np.array(size) / 2 - radius)
            outside = np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(-1), 0)
            best = np.minimum(best, outside - radius)
        return best
    return distance


def _gradient(distance, p):
    e = 1e-3
    return np.stack([distance(p + e * np.eye(3)[k]) - distance(p - e * np.eye(3)[k]) for k in range(3)], -1) / (2 * e)


def drape(width, length, distance, centre, turn=0.0, spacing=0.035, steps=140, gap=0.004, bend=0.25, seed=0):
    """Lets a cloth (width along x, length along z, before `turn`) fall from its centre onto what `distance` describes.
    Position-based dynamics (Müller et al. 2007) with friction; returns its points, rows along z."""
    nx, nz = int(width / spacing) + 1, int(length / spacing) + 1
    x, z = np.meshgrid(np.linspace(-width / 2, width / 2, nx), np.linspace(-length / 2, length / 2, nz))
    a = np.radians(turn)
    rng = np.random.default_rng(seed)
    flat = np.stack([x.ravel(), 0 * x.ravel(), z.ravel()], -1)
    lift = 0.012 * cloth_noise(flat + rng.uniform(0, 9), 6, seed).reshape(x.shape)
    p = np.stack([np.cos(a) * x + np.sin(a) * z, lift, -np.sin(a) * x + np.cos(a) * z], -1) + centre
    before = p.copy()
    # (offset in rows, offset in columns, stiffness): threads, diagonals, bending.
    families = ((0, 1, 1.0), (1, 0, 1.0), (1, 1, 0.4), (1, -1, 0.4), (0, 2, bend), (2, 0, bend))
    rest = [np.hypot(dr * length / (nz - 1), dc * width / (nx - 1)) for dr, dc, _ in families]
    share = sum(2 * k for _, _, k in families) / 4
    for _ in range(steps):
        velocity = (p - before) * 0.96
        before = p.copy()
        p = p + velocity + np.array([0, -9.81 * 0.012 ** 2, 0])
        for _ in range(10):
            move = np.zeros_like(p)
            for (dr, dc, k), length0 in zip(families, rest):
                first = (slice(0, nz - dr), slice(0, nx - dc) if dc >= 0 else slice(-dc, nx))
                second = (slice(dr, nz), slice(dc, nx) if dc >= 0 else slice(0, nx + dc))
                d = p[second] - p[first]
                size = np.linalg.norm(d, axis=-1, keepdims=True)
                push = 0.5 * k * (1 - length0 / np.maximum(size, 1e-9)) * d
                move[first] += push
                move[second] -= push
            p = p + move / share
        inside = distance(p) - gap
        hit = inside < 0
        if hit.any():
            at = p[hit]
            n = _gradient(distance, at)
            n /= np.maximum(np.linalg.norm(n, axis=-1, keepdims=True), 1e-9)
            at = at - n * inside[hit][:, None]
            slide = at - before[hit]
            along = slide - n * (slide * n).sum(-1, keepdims=True)
            p[hit] = at - 0.7 * along
        p[..., 1] = np.maximum(p[..., 1], gap)
    return p


def _finer(p):
    """Twice as many points each way, on Catmull-Rom curves."""
    for _ in range(2):
        q = np.concatenate([2 * p[:1] - p[1:2], p, 2 * p[-1:] - p[-2:-1]])
        middle = (-q[:-3] + 9 * q[1:-2] + 9 * q[2:-1] - q[3:]) / 16
        out = np.empty((2 * len(p) - 1,) + p.shape[1:])
        out[0::2], out[1::2] = p, middle
        p = out.swapaxes(0, 1)
    return p


def fabric(points, thickness, seed=0, puff=0.0):
    """Closed cloth of the given thickness above `points`; `puff` swells it between its edges, as a duvet's filling does."""
    p = _finer(points)
    rows, columns, _ = p.shape
    step_u, step_v = (np.linalg.norm(np.diff(points, axis=k), axis=-1).mean() / 2 for k in (1, 0))
    uv = np.stack(np.meshgrid(np.arange(columns) * step_u, np.arange(rows) * step_v), -1)
    below = grid(p, np.zeros_like(p), uv).smoothed()
    n = below.normals.reshape(p.shape)
    if n[..., 1].mean() < 0:
        return fabric(points[::-1], thickness, seed, puff)
    edge = np.minimum.reduce([uv[..., 0], uv[..., 1], uv[-1, -1, 0] - uv[..., 0], uv[-1, -1, 1] - uv[..., 1]])
    ease = 1 - (1 - np.clip(edge / max(0.05, puff), 0, 1)) ** 2
    wrinkle = cloth_noise(np.concatenate([uv, 0 * uv[..., :1]], -1).reshape(-1, 3), 11, seed).reshape(edge.shape)
    height = thickness + ease * puff * (1 + 0.22 * wrinkle)
    top = p + n * height[..., None]
    upper = grid(top, np.zeros_like(p), uv).smoothed()
    rim = []
    for a, b in ((p[0], top[0]), (top[-1], p[-1]), (top[:, 0], p[:, 0]), (p[:, -1], top[:, -1])):
        strip = np.stack([a, b])
        rim.append(grid(strip, np.zeros_like(strip), np.zeros(strip.shape[:2] + (2,))).smoothed())
    under = Shape(below.positions, -below.normals, below.uv, below.triangles[:, ::-1])
    return join(upper, under, *rim)
