#!/usr/bin/env python3
"""Writes the IES files of the sample catalogue: simple distributions by formula, invented for roomlight; of no manufacturer."""
import math
import pathlib

STEP = 5  # degrees


def flux(candela):
    """Integral over the sphere of values every STEP degrees from the nadir, straight between them, in candela."""
    total = 0.0
    for i in range(len(candela) - 1):
        n = 50
        for k in range(n):
            t = (k + 0.5) / n
            gamma = math.radians((i + t) * STEP)
            total += (candela[i] * (1 - t) + candela[i + 1] * t) * 2 * math.pi * math.sin(gamma) * math.radians(STEP) / n
    return total


def write(name, title, lumens, watts, diameter, shape):
    gammas = list(range(0, 181, STEP))
    raw = [max(0.0, shape(math.radians(g))) for g in gammas]
    scale = lumens / flux(raw)
    values = [f"{v * scale:.2f}" for v in raw]
    lines = ["IESNA:LM-63-2002", "[TEST] computed, not measured", "[MANUFAC] roomlight samples", f"[LUMINAIRE] {title}", "TILT=NONE",
             f"1 -1 1 {len(gammas)} 1 1 2 {-diameter:g} {-diameter:g} 0", f"1 1 {watts:g}",
             " ".join(str(g) for g in gammas), "0"]
    lines += [" ".join(values[i:i + 10]) for i in range(0, len(values), 10)]
    pathlib.Path(__file__).with_name("luminaires").joinpath(name).write_text("\n".join(lines) + "\n")


def beam(degrees):
    """cos^n with half of the peak at half of the beam."""
    n = math.log(0.5) / math.log(math.cos(math.radians(degrees / 2)))
    return lambda g: math.cos(g) ** n if g < math.pi / 2 else 0.0


write("downlight_60.ies", "Recessed downlight, beam 60 degrees", 650, 7, 0.08, beam(60))
write("spot_36.ies", "Spot on the ceiling, beam 36 degrees", 480, 6, 0.05, beam(36))
write("panel.ies", "Ceiling panel, Lambertian", 1800, 18, 0.3, lambda g: math.cos(g))
write("wall_up_down.ies", "Wall luminaire, up and down", 700, 8, 0.08, lambda g: 0.05 + abs(math.cos(g)) ** 3)
