"""What the windows look out on: equirectangular skies with clouds over a wooded horizon, for lighting files. The centre of the
picture looks along -z, the way the living room's windows face. Values are relative; the lighting file scales them."""
import numpy as np

from textures import fractal, noise

HEIGHT, WIDTH = 1024, 2048


def write_hdr(path, picture):
    """Radiance RGBE, not packed."""
    largest = np.maximum(picture.max(-1), 1e-30)
    mantissa, exponent = np.frexp(largest)
    scale = mantissa * 256 / largest
    rgbe = np.concatenate([picture * scale[..., None], (exponent + 128)[..., None]], -1)
    with open(path, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % picture.shape[:2])
        out.write(np.clip(rgbe, 0, 255).astype(np.uint8).tobytes())


def skyline(rng, azimuth, base, rough, cells):
    """Elevation in radians of a ridge for every azimuth."""
    return base + rough * fractal((1, len(azimuth)), cells, 1, 5, rng)[0]


def sky(rng, zenith, horizon, cloud_light, cloud_shade, glow=None, cover=0.0, land=1.0):
    """A sky from horizon to zenith, clouds, and below it hills and treetops lit by `land` times the horizon. `glow` is
    (azimuth from the middle in radians, colour)."""
    elevation = np.linspace(np.pi / 2, -np.pi / 2, HEIGHT)[:, None]
    azimuth = np.linspace(-np.pi, np.pi, WIDTH, endpoint=False)
    up = np.clip(np.sin(elevation), 0, 1)[..., None]
    out = np.array(horizon) * (1 - up) ** 3 + np.array(zenith) * (1 - (1 - up) ** 3) + np.zeros((HEIGHT, WIDTH, 1))
    if glow:
        near = np.cos(azimuth - glow[0]).clip(0)[None, :] ** 3 * np.exp(-np.abs(elevation) * 3.5)
        out = out + near[..., None] * np.array(glow[1])
    # Clouds shrink towards the horizon, as a flat layer does.
    cloud = sum(noise((HEIGHT, WIDTH), 10 << k, 14 << k, rng) / 1.8 ** k for k in range(6)) * np.clip(elevation * 5, 0, 1)
    body = np.clip((cloud + cover) * 1.6, 0, 1)[..., None]
    lit = np.clip(np.roll(cloud, 3, 0) * 0.9 + 0.4, 0, 1)[..., None]
    out = out * (1 - body) + (np.array(cloud_shade) * (1 - lit) + np.array(cloud_light) * lit) * body
    haze = np.array(horizon)
    texture = fractal((HEIGHT, WIDTH), 200, 100, 4, rng)
    for base, rough, cells, colour, mist in ((0.035, 0.022, 7, (0.050, 0.062, 0.060), 0.60), (-0.015, 0.016, 12, (0.046, 0.060, 0.042), 0.28), (-0.10, 0.030, 36, (0.044, 0.060, 0.030), 0.06)):
        ridge = skyline(rng, azimuth, base, rough, cells) + 0.004 * fractal((1, WIDTH), 250, 1, 3, rng)[0]
        below = (elevation < ridge[None, :])[..., None]
        trees = np.array(colour) * land * (1 + 0.5 * texture[..., None])
        out = np.where(below, trees.clip(0) * (1 - mist) + haze * 0.6 * mist * land, out)
    return np.maximum(out, 1e-6)


def write_skies(folder):
    rng = np.random.default_rng(12)
    write_hdr(folder / "day.hdr", sky(rng, (0.16, 0.30, 0.62), (0.62, 0.74, 0.90), (1.25, 1.22, 1.16), (0.62, 0.68, 0.78), (0.6, (0.5, 0.42, 0.30)), cover=-0.10, land=2.2))
    write_hdr(folder / "evening.hdr", sky(rng, (0.05, 0.09, 0.22), (0.34, 0.34, 0.46), (0.42, 0.34, 0.40), (0.11, 0.13, 0.22), (0.9, (1.3, 0.55, 0.20)), cover=-0.25, land=0.35))
