#!/usr/bin/env python3
"""Opens a home, takes pictures of it and measures how much light falls into it.

    python3 picture_and_lux.py HOME FOLDER [--lighting FILE] [--camera NAME ...]

HOME: .sh3d, .glb or any other file that roomlight opens.
"""

import argparse
from pathlib import Path

import numpy as np

import roomlight


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("home")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lighting")
    parser.add_argument("--camera", action="append", default=[])
    wish = parser.parse_args()
    wish.folder.mkdir(parents=True, exist_ok=True)

    scene = roomlight.open(wish.home, wish.lighting)
    for lamp in scene.lamps:
        print(f"{lamp.name}: {lamp.flux:.0f} lm, {lamp.room}")

    # Light is found once for all pictures.
    renderer = roomlight.Renderer(scene, wish.camera, quality="draft", width=320, height=180)
    for number, picture in enumerate(renderer):
        picture.save(wish.folder / f"picture_{number}.png")
        luminance = picture.pixels @ np.array([0.2126, 0.7152, 0.0722], np.float32)
        print(f"{picture.camera}: {luminance.mean():.1f} cd/m² on average, at most {luminance.max():.0f}")

    # A row of light meters across the first room, at the height of a table.
    if scene.rooms:
        floor = np.array(scene.rooms[0].floor)
        x = np.linspace(floor[:, 0].min() + 0.5, floor[:, 0].max() - 0.5, 8)
        z = np.full(8, (floor[:, 1].min() + floor[:, 1].max()) / 2)
        lux = roomlight.illuminance(scene, np.stack([x, np.full(8, 0.75), z], axis=1), quality="draft")
        print(f"{scene.rooms[0].name}, 0.75 m above the floor:", ", ".join(f"{e:.0f}" for e in lux), "lx")


if __name__ == "__main__":
    main()
