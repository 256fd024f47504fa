"""Triangle shapes with normals and texture coordinates in metres. All functions return a Shape around the origin; y is up."""
import numpy as np


class Shape:
    def __init__(self, positions, normals, uv, triangles):
        self.positions, self.normals = np.asarray(positions, float), np.asarray(normals, float)
        self.uv, self.triangles = np.asarray(uv, float), np.asarray(triangles, int).reshape(-1, 3)

    def at(self, x, y, z):
        return Shape(self.positions + [x, y, z], self.normals, self.uv, self.triangles)

    def turned(self, degrees, axis=1):
        """Rotated about an axis (0 x, 1 y, 2 z) through the origin, counter-clockwise."""
        a = np.radians(degrees)
        c, s = np.cos(a), np.sin(a)
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        m = np.eye(3)
        m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
        return Shape(self.positions @ m.T, self.normals @ m.T, self.uv, self.triangles)

    def scaled(self, x, y, z):
        n = self.normals / [x, y, z]
        return Shape(self.positions * [x, y, z], n / np.linalg.norm(n, axis=1, keepdims=True), self.uv, self.triangles)

    def moved(self, displace):
        """Every point p becomes p + displace(p); normals are made anew."""
        return Shape(self.positions + displace(self.positions), self.normals, self.uv, self.triangles).smoothed()

    def smoothed(self):
        """Area-weighted vertex normals, shared by points at the same place."""
        p, t = self.positions, self.triangles
        n = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
        _, place = np.unique(np.round(p, 5), axis=0, return_inverse=True)
        place = place.reshape(-1)
        sums = np.zeros((place.max() + 1, 3))
        for k in range(3):
            np.add.at(sums, place[t[:, k]], n)
        return Shape(p, unit(sums[place]), self.uv, t)


def unit(normals):
    """Normals of length 1; up where there is none, at points of triangles without area."""
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    return np.where(length > 1e-12, normals / np.maximum(length, 1e-12), np.eye(normals.shape[-1])[1])


def join(*shapes):
    offsets = np.cumsum([0] + [len(s.positions) for s in shapes[:-1]])
    return Shape(np.concatenate([s.positions for s in shapes]), np.concatenate([s.normals for s in shapes]),
                 np.concatenate([s.uv for s in shapes]), np.concatenate([s.triangles + o for s, o in zip(shapes, offsets)]))


def grid(points, normals, uv):
    """Triangles of a (rows, columns, 3) array of points; counter-clockwise when rows go up and columns go right."""
    rows, columns, _ = points.shape
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    return Shape(points.reshape(-1, 3), normals.reshape(-1, 3), uv.reshape(-1, 2), triangles)


def box(x, y, z, r=0.004, bulge=(0, 0, 0), steps=0, grain=True):
    """A box of the given size with edges rounded to radius r, its middle at the origin. `bulge` swells each pair of faces by so
    many metres in their middle, for cushions; `steps` adds lines over the faces. With `grain`, u runs along the longer edge of
    each face, as wood is cut; else v is up."""
    half = np.array([x, y, z]) / 2
    r = min(r, half.min() * 0.999)
    parts = []
    arc = 1 if r < 0.006 else 3 if r < 0.03 else 5
    for axis in range(3):
        i, j = (axis + 1) % 3, (axis + 2) % 3

        def lines(k):
            edge = np.linspace(0, 1, arc + 1)
            low = -half[k] + r * edge
            inner = np.linspace(-half[k] + r, half[k] - r, steps + 2)[1:-1]
            return np.concatenate([low, inner, -low[::-1]])

        u, v = np.meshgrid(lines(i), lines(j))
        for side in (1, -1):
            q = np.zeros(u.shape + (3,))
            q[..., axis], q[..., i], q[..., j] = side * half[axis], u * side, v
            inner = np.clip(q, -(half - r), half - r)
            n = q - inner
            n /= np.maximum(np.linalg.norm(n, axis=-1, keepdims=True), 1e-12)
            p = inner + r * n
            uv = np.stack([p[..., i], p[..., j]] if axis != 0 else [p[..., 2], p[..., 1]], -1)
            if axis == 1:
                uv = np.stack([p[..., 0], p[..., 2]], -1)
            if grain and np.ptp(uv[..., 1]) > np.ptp(uv[..., 0]):
                uv = uv[..., ::-1]
            parts.append(grid(p, n, uv))
    shape = join(*parts)
    if any(bulge):
        w = 1 - np.minimum(np.abs(shape.positions) / half, 1) ** 2
        swell = np.stack([np.sign(shape.positions[:, k]) * bulge[k] * np.delete(w, k, 1).prod(1) for k in range(3)], -1)
        shape = Shape(shape.positions + swell, shape.normals, shape.uv, shape.triangles).smoothed()
    return shape


def quad(width, height):
    """A rectangle in the plane z = 0 that looks along +z."""
    x, y = np.meshgrid([-width / 2, width / 2], [-height / 2, height / 2])
    p = np.stack([x, y, 0 * x], -1)
    return grid(p, np.broadcast_to([0.0, 0, 1], p.shape), np.stack([x, y], -1))


def lathe(profile, segments=32):
    """The profile, points (radius, height) from bottom to top along the outside, turned about y."""
    profile = np.array(profile, float)
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    slope = np.gradient(profile, axis=0)
    n2 = np.stack([slope[:, 1], -slope[:, 0]], -1)
    n2 = unit(n2)
    c, s = np.cos(angle), -np.sin(angle)
    p = np.stack([np.outer(profile[:, 0], c), np.outer(profile[:, 1], np.ones_like(c)), np.outer(profile[:, 0], s)], -1)
    n = np.stack([np.outer(n2[:, 0], c), np.outer(n2[:, 1], np.ones_like(c)), np.outer(n2[:, 0], s)], -1)
    uv = np.stack(np.meshgrid(angle * profile[:, 0].max(), profile[:, 1]), -1)
    return grid(p, n, uv)


def cylinder(radius, height, segments=24, bevel=0.003):
    b = min(bevel, radius / 2, height / 3)
    return lathe([(0, 0), (radius - b, 0), (radius - b, 0), (radius, b), (radius, b), (radius, height - b), (radius, height - b),
                  (radius - b, height), (radius - b, height), (0, height)], segments)


def sphere(radius, segments=20):
    a = np.linspace(-np.pi / 2, np.pi / 2, segments // 2 + 1)
    return lathe(np.stack([radius * np.cos(a), radius * np.sin(a)], -1), segments)


def tube(path, radius, segments=10):
    """A round tube along a line of points, closed at both ends; `radius` is one number or one a point."""
    path = np.array(path, float)
    radius = np.broadcast_to(np.asarray(radius, float), len(path))
    direction = np.gradient(path, axis=0)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    helper = np.array([0.0, 1, 0]) if abs(direction[0, 1]) < 0.9 else np.array([1.0, 0, 0])
    angle = np.linspace(0, 2 * np.pi, segments + 1)
    rings, normals = [], []
    for p, d, r in zip(path, direction, radius):
        u = np.cross(d, helper)
        u /= np.linalg.norm(u)
        v = np.cross(d, u)
        helper = np.cross(u, d)
        n = -np.outer(np.cos(angle), u) + np.outer(np.sin(angle), v)
        rings.append(p + r * n)
        normals.append(n)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    uv = np.stack(np.meshgrid(angle * radius.mean(), length), -1)[..., ::-1]
    parts = [grid(np.array(rings), np.array(normals), uv)]
    for end, sign in ((0, -1), (-1, 1)):
        cap = np.stack([rings[end], np.broadcast_to(path[end], rings[end].shape)])
        parts.append(grid(cap, np.broadcast_to(sign * direction[end], cap.shape), np.zeros(cap.shape[:2] + (2,))))
    return facing(join(*parts))


def facing(shape):
    """Turns triangles round whose corners run against their normals."""
    p, t = shape.positions, shape.triangles
    n = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
    wrong = (n * shape.normals[t].sum(1)).sum(1) < 0
    t[wrong] = t[wrong][:, ::-1]
    return shape


def rounded_ring(a, b, y, exponent=2.0, count=48, shift=0.0):
    """A superellipse of half-axes a and b at height y; exponent 2 is an ellipse, more is squarer. For loft()."""
    t = np.linspace(0, 2 * np.pi, count + 1)
    c, s, e = np.cos(t), -np.sin(t), 2 / exponent
    return np.stack([a * np.sign(c) * np.abs(c) ** e, np.full_like(t, y), b * np.sign(s) * np.abs(s) ** e + shift], -1)


def loft(rings, creases=()):
    """A skin through rings of equally many points, from bottom to top along the outside; sharp at the rings in `creases`."""
    rings, parts, start = np.array(rings), [], 0
    for stop in [*creases, len(rings) - 1]:
        p = rings[start:stop + 1]
        around = np.linalg.norm(np.diff(p[0], axis=0), axis=1).cumsum()
        up = np.concatenate([[0], np.linalg.norm(np.diff(p[:, 0], axis=0), axis=1).cumsum()])
        parts.append(grid(p, np.zeros_like(p), np.stack(np.meshgrid(np.concatenate([[0], around]), up), -1)).smoothed())
        start = stop
    return join(*parts)


def bent(points, radius, segments=10, steps=8):
    """A tube whose corners are rounded: quadratic curves between the middles of its legs."""
    p = [np.array(q, float) for q in points]
    path = [p[0]]
    for a, b, c in zip(p, p[1:], p[2:]):
        start, end = (a + b) / 2, (b + c) / 2
        for t in np.linspace(0, 1, steps):
            path.append((1 - t) ** 2 * start + 2 * t * (1 - t) * b + t * t * end)
    path.append(p[-1])
    keep = [path[0]] + [b for a, b in zip(path, path[1:]) if np.linalg.norm(b - a) > 1e-5]
    return tube(keep, radius, segments)


def cloth_noise(points, scale, seed):
    """Smooth wrinkles: a sum of waves in random directions, about -1..1."""
    rng = np.random.default_rng(seed)
    out = np.zeros(len(points))
    for octave in range(4):
        for _ in range(4):
            d = rng.normal(size=3)
            d *= scale * 2 ** octave / np.linalg.norm(d)
            out += np.sin(points @ d + rng.uniform(0, 6.28)) / 2 ** octave
    return out / 4
