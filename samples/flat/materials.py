"""Materials of the flat: colours are sRGB 0..255 where a texture is painted, linear albedo elsewhere."""
import numpy as np

import textures as tx

# Metres that one repetition of a material's texture covers; 1 where there is none.
SIZE = {}


def lamp(flux_lm, area_m2, kelvin_rgb):
    """Luminance of a Lambertian emitter: flux / (pi area), spread over a colour of luminance 1."""
    luminance = flux_lm / (np.pi * area_m2)
    weight = np.dot(kelvin_rgb, [0.2126, 0.7152, 0.0722])
    return [luminance * c / weight for c in kelvin_rgb]


WARM = (1.0, 0.62, 0.30)      # about 2700 K in linear Rec.709, up to scale
NEUTRAL = (1.0, 0.78, 0.55)   # about 3500 K


def define(glb):
    rng = np.random.default_rng(7)

    def painted(name, size, colour, height=None, strength=0.6, roughness=0.6, **more):
        SIZE[name] = size
        normal = glb.texture(tx.normals_of(height, strength), name + " normal") if height is not None else None
        glb.material(name, (1, 1, 1), roughness, texture=glb.texture(colour, name), normal=normal, **more)

    def plain(name, r, g, b, roughness=0.6, **more):
        glb.material(name, (r, g, b), roughness, **more)

    painted("floor oak", 1.44, *tx.wood((196, 154, 108), rng), strength=0.25, roughness=0.42)
    painted("oak", 0.9, *tx.wood((198, 158, 112), rng, planks=2, joints=False), strength=0.15, roughness=0.45)
    painted("bath floor", 1.2, *tx.tiles((148, 146, 140), (108, 106, 102), rng, columns=4, rows=4), strength=0.3, roughness=0.35)
    painted("bath wall", 0.8, *tx.tiles((214, 218, 212), (188, 190, 186), rng, columns=4, rows=8, offset=True), strength=0.35, roughness=0.18)
    painted("splashback", 0.6, *tx.tiles((206, 214, 210), (182, 184, 180), rng, columns=4, rows=8, offset=True), strength=0.35, roughness=0.15)
    for name, base in (("sofa", (150, 152, 148)), ("armchair", (86, 104, 98)), ("pillow rust", (176, 104, 74)), ("pillow blue", (92, 112, 132)),
                       ("curtain", (222, 216, 204)), ("linen", (232, 229, 222)), ("duvet", (222, 218, 208)), ("blanket", (126, 138, 130)), ("headboard", (140, 132, 120)), ("towel", (196, 178, 156))):
        colour, height = tx.weave(base, rng)
        painted(name, 0.12, colour, height, strength=0.5, roughness=0.95, double_sided=name == "curtain")
    colour, height = tx.rug(rng)
    painted("rug", 1.0, colour, height, strength=0.4, roughness=1.0)
    for kind in ("hills", "forms", "strokes"):
        painted("picture " + kind, 1.0, tx.painting(kind, rng), roughness=0.8)

    plain("wall", 0.78, 0.76, 0.72, 0.9)
    plain("wall accent", 0.30, 0.37, 0.36, 0.9)
    plain("ceiling", 0.84, 0.84, 0.82, 0.95)
    plain("facade", 0.62, 0.58, 0.52, 0.95)
    plain("skirting", 0.80, 0.79, 0.76, 0.4)
    plain("door", 0.80, 0.79, 0.76, 0.4)
    plain("window frame", 0.82, 0.82, 0.80, 0.35)
    plain("sill", 0.74, 0.73, 0.70, 0.25)
    plain("front white", 0.80, 0.79, 0.76, 0.35)
    plain("front grey", 0.36, 0.38, 0.36, 0.45)
    plain("front dark", 0.05, 0.05, 0.05, 0.5)
    plain("worktop", 0.55, 0.54, 0.52, 0.25)
    plain("chair", 0.16, 0.20, 0.20, 0.5)
    plain("black", 0.03, 0.03, 0.03, 0.45)
    plain("screen", 0.015, 0.015, 0.017, 0.12)
    plain("black glass", 0.02, 0.02, 0.02, 0.08)
    plain("black metal", 0.05, 0.05, 0.05, 0.4, metallic=0.0)
    plain("frame", 0.45, 0.33, 0.21, 0.5)
    plain("frame black", 0.04, 0.04, 0.04, 0.45)
    plain("brass", 0.80, 0.58, 0.30, 0.28, metallic=1.0)
    plain("steel", 0.60, 0.60, 0.59, 0.25, metallic=1.0)
    plain("chrome", 0.68, 0.68, 0.68, 0.08, metallic=1.0)
    plain("mirror", 0.90, 0.90, 0.90, 0.0, metallic=1.0)
    plain("porcelain", 0.82, 0.82, 0.80, 0.12)
    plain("ceramic", 0.66, 0.60, 0.52, 0.35)
    plain("soap", 0.75, 0.62, 0.48, 0.5)
    plain("pot", 0.50, 0.30, 0.20, 0.8)
    plain("soil", 0.05, 0.035, 0.025, 1.0)
    plain("leaf", 0.07, 0.19, 0.06, 0.45, double_sided=True)
    plain("orange", 0.75, 0.28, 0.03, 0.4)
    plain("apple", 0.42, 0.10, 0.06, 0.3)
    plain("lemon", 0.78, 0.62, 0.08, 0.4)
    plain("shade", 0.78, 0.74, 0.66, 0.9, double_sided=True)
    plain("pendant", 0.72, 0.70, 0.66, 0.5, double_sided=True)
    for name, rgb in (("book red", (0.36, 0.08, 0.06)), ("book blue", (0.07, 0.13, 0.24)), ("book cream", (0.70, 0.64, 0.52)), ("book green", (0.10, 0.20, 0.14)), ("book grey", (0.32, 0.31, 0.30))):
        plain(name, *rgb, 0.7)
    plain("glass", 1, 1, 1, 0.0, transmission=1.0)
    # Lamps: flux over the area of their emitting shapes.
    ball = lambda r: 4 * np.pi * r * r
    for name, flux, area, colour in (("bulb dining", 806, ball(0.04), WARM), ("bulb floor", 1055, ball(0.045), WARM), ("bulb bed", 470, ball(0.03), WARM),
                                     ("strip", 900, 0.018 * 1.9, NEUTRAL), ("globe hall", 1200, 0.10, WARM), ("globe bath", 1500, 0.10, NEUTRAL)):
        plain(name, 0.7, 0.7, 0.7, 0.5, emission=lamp(flux, area, colour))
