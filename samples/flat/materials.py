"""Materials of the flat: colours are sRGB 0..255 where a texture is painted, linear albedo elsewhere."""
import numpy as np

import lamps
import paintings
import textures as tx

# Metres that one repetition of a material's texture covers; 1 where there is none.
SIZE = {}


def black_body(kelvin):
    """Linear Rec.709 colour of a black body from 2222 K on, its largest component 1: the Planckian locus by Kim et al. (2002)."""
    t = 1000.0 / kelvin
    if kelvin < 4000:
        x = np.polyval([-0.2661239, -0.2343589, 0.8776956, 0.179910], t)
        y = np.polyval([-0.9549476, -1.37418593, 2.09137015, -0.16748867], x)
    else:
        x = np.polyval([-3.0258469, 2.1070379, 0.2226347, 0.240390], t)
        y = np.polyval([3.0817580, -5.87338670, 3.75112997, -0.37001483], x)
    xyz = np.array([x / y, 1, (1 - x - y) / y])
    rgb = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]) @ xyz
    return rgb.clip(0) / rgb.max()


# A camera balanced for daylight shows lamps of 2700 K as orange; these are what a picture of a warm room looks like.
WARM, NEUTRAL = black_body(4200), black_body(5000)


def lambertian(flux_lm, area_m2, colour):
    """Luminance of a Lambertian emitter: flux / (pi area), spread over a colour of luminance 1."""
    luminance = flux_lm / (np.pi * area_m2)
    return [luminance * c / np.dot(colour, [0.2126, 0.7152, 0.0722]) for c in colour]


def define(glb):
    rng = np.random.default_rng(7)

    def painted(name, size, colour, height=None, strength=0.6, roughness=0.6, **more):
        SIZE[name] = size
        normal = glb.texture(tx.normals_of(height, strength), name + " normal") if height is not None else None
        glb.material(name, (1, 1, 1), roughness, texture=None if colour is None else glb.texture(colour, name), normal=normal, **more)

    def plain(name, r, g, b, roughness=0.6, **more):
        glb.material(name, (r, g, b), roughness, **more)

    surfaces(painted, plain, rng)
    cloths(painted, rng)
    for name, paint in paintings.ALL.items():
        painted(name, 1.0, paint(rng), roughness=0.8)
    walls(glb, rng)
    solids(plain)
    lights(plain)


def surfaces(painted, plain, rng):
    """Wood, tiles and stone."""
    painted("floor oak", 2.0, *tx.wood((186, 154, 118), rng, 1152, boards=12, joints=True), strength=0.22, roughness=0.42)
    colour, height = tx.wood((200, 168, 128), rng)
    painted("oak", 0.8, colour, height, strength=0.12, roughness=0.45)
    painted("oak upright", 0.8, colour, height, strength=0.12, roughness=0.45)
    painted("oak dark", 0.8, *tx.wood((104, 80, 62), rng, 512), strength=0.12, roughness=0.45)
    painted("bath floor", 0.9, tx.stone((186, 178, 166), rng, 768, 0.0, chips=3), roughness=0.28)
    painted("bath tile", 0.8, *tx.tiles((150, 168, 156), (204, 202, 194), rng, 768, 8, 8, variation=0.07, dish=0.16), strength=0.30, roughness=0.14)
    painted("kitchen tile", 0.9, *tx.tiles((224, 219, 208), (196, 192, 184), rng, 768, 12, 12, variation=0.035, dish=0.16), strength=0.30, roughness=0.14)
    painted("worktop", 1.2, tx.stone((212, 208, 200), rng, 512, 0.16), roughness=0.22)
    painted("seagrass", 0.08, *tx.wicker((176, 142, 98), rng), strength=0.5, roughness=0.9)
    painted("bark", 0.2, tx.shaded((108, 88, 68), 0.3 * tx.fractal((128, 128), 4, 24, 3, rng)), roughness=0.95)


def cloths(painted, rng):
    painted("sofa", 0.30, *tx.boucle((206, 196, 180), rng), strength=0.45, roughness=1.0)
    for name, base in (("armchair", (104, 112, 88)), ("pillow rust", (172, 98, 68)), ("pillow cream", (224, 214, 196)), ("pillow ink", (62, 76, 88)), ("curtain", (224, 216, 202)), ("linen", (234, 230, 222)),
                       ("duvet", (214, 208, 196)), ("headboard", (168, 150, 128)), ("linen mat", (150, 152, 138)), ("felt", (48, 46, 44))):
        painted(name, 0.14, *tx.weave(base, rng), strength=0.35, roughness=0.95, double_sided=name == "curtain")
    for name, base in (("towel", (188, 168, 146)), ("towel white", (228, 224, 216)), ("bath mat", (214, 206, 192))):
        painted(name, 0.16, *tx.boucle(base, rng, 256), strength=0.5, roughness=1.0)
    for name, base in (("throw", (150, 118, 96)), ("blanket", (138, 128, 108))):
        painted(name, 0.16, *tx.knit(base, rng), strength=0.6, roughness=1.0)
    painted("cord", 0.12, *tx.cord((206, 182, 144), rng), strength=0.5, roughness=0.8)
    painted("rug", 1.0, *tx.rug(rng), strength=0.4, roughness=1.0)


def walls(glb, rng):
    """One roller texture for all painted walls."""
    normal = glb.texture(tx.normals_of(tx.plaster(rng), 0.02), "plaster normal")
    for name, rgb in (("wall", (0.80, 0.775, 0.73)), ("wall accent", (0.30, 0.34, 0.30)), ("ceiling", (0.86, 0.85, 0.83)), ("facade", (0.70, 0.66, 0.58))):
        SIZE[name] = 0.8
        glb.material(name, rgb, 0.9, normal=normal)


def solids(plain):
    plain("skirting", 0.80, 0.78, 0.74, 0.4)
    plain("door", 0.80, 0.78, 0.74, 0.38)
    plain("window frame", 0.80, 0.79, 0.76, 0.35)
    plain("sill", 0.80, 0.78, 0.74, 0.3)
    plain("front white", 0.78, 0.75, 0.70, 0.4)
    plain("front sage", 0.30, 0.35, 0.28, 0.42)
    plain("front dark", 0.06, 0.06, 0.055, 0.5)
    plain("black", 0.025, 0.025, 0.025, 0.45)
    plain("black metal", 0.03, 0.03, 0.03, 0.42)
    plain("screen", 0.012, 0.012, 0.014, 0.10)
    plain("black glass", 0.015, 0.015, 0.015, 0.07)
    plain("frame", 0.42, 0.29, 0.17, 0.5)
    plain("frame black", 0.03, 0.03, 0.03, 0.45)
    plain("paper", 0.80, 0.79, 0.76, 0.9)
    plain("brass", 0.78, 0.57, 0.31, 0.30, metallic=1.0)
    plain("steel", 0.62, 0.61, 0.59, 0.24, metallic=1.0)
    plain("chrome", 0.70, 0.70, 0.70, 0.08, metallic=1.0)
    plain("mirror", 0.90, 0.90, 0.90, 0.0, metallic=1.0)
    plain("porcelain", 0.82, 0.81, 0.78, 0.12)
    plain("ceramic", 0.70, 0.64, 0.55, 0.4)
    plain("stoneware", 0.62, 0.57, 0.49, 0.35)
    plain("stoneware dark", 0.16, 0.17, 0.165, 0.35)
    plain("enamel", 0.42, 0.15, 0.075, 0.18)
    plain("amber", 0.16, 0.06, 0.018, 0.15)
    plain("candle", 0.78, 0.73, 0.62, 0.5)
    plain("fringe", 0.60, 0.54, 0.44, 1.0)
    plain("pot", 0.48, 0.27, 0.17, 0.8)
    plain("soil", 0.05, 0.035, 0.025, 1.0)
    plain("leaf", 0.055, 0.145, 0.045, 0.38, double_sided=True)
    plain("leaf light", 0.12, 0.24, 0.07, 0.45, double_sided=True)
    plain("leaf olive", 0.20, 0.25, 0.13, 0.55, double_sided=True)
    plain("orange", 0.75, 0.28, 0.03, 0.4)
    plain("lemon", 0.78, 0.62, 0.08, 0.4)
    plain("pendant", 0.045, 0.05, 0.05, 0.45)
    plain("pendant inside", 0.80, 0.76, 0.68, 0.4)
    plain("shade lining", 0.80, 0.78, 0.74, 0.9)
    plain("shade rim", 0.60, 0.54, 0.45, 0.9)
    plain("terrace", 0.40, 0.38, 0.35, 0.9)
    for name, rgb in (("red", (0.36, 0.08, 0.06)), ("rust", (0.44, 0.17, 0.08)), ("blue", (0.10, 0.17, 0.26)), ("ink", (0.05, 0.07, 0.10)), ("cream", (0.68, 0.61, 0.49)), ("green", (0.14, 0.21, 0.15)),
                      ("grey", (0.34, 0.33, 0.31)), ("white", (0.76, 0.74, 0.70)), ("ochre", (0.52, 0.34, 0.12))):
        plain("book " + name, *rgb, 0.7)
    plain("glass", 1, 1, 1, 0.0, transmission=1.0)


def lights(plain):
    """(name, flux in lm, area of the emitting shape in m2, colour, albedo). A shade and its bulb together give the lamp's flux."""
    ball, side = lamps.sphere_area, lamps.cylinder_area
    for name, flux, area, colour, albedo in (
            ("bulb dining", 806, ball(lamps.BULB), WARM, 0.7),
            ("bulb floor", 1000, ball(lamps.BULB), WARM, 0.7), ("shade floor", 120, side(*lamps.DRUM), WARM, 0.6),
            ("bulb table", 330, ball(0.028), WARM, 0.7), ("shade table", 45, side(*lamps.TABLE_DRUM), WARM, 0.6),
            ("shade bed", 36, side(*lamps.SMALL_DRUM), WARM, 0.6),
            ("strip", 500, lamps.STRIP_WIDTH * 0.5, NEUTRAL, 0.7), ("tube bath", 900, side(0.016, 0.7), NEUTRAL, 0.7),
            ("globe", 1200, ball(lamps.GLOBE), WARM, 0.8)):
        plain(name, albedo, albedo, albedo * 0.97, 0.5, emission=lambertian(flux, area, colour))
