#!/usr/bin/env python3
"""Looks for the place of a desk lamp that lights the desk best, and evenly.

    python3 best_place.py FOLDER
"""

import sys
from pathlib import Path
from typing import List, Tuple

import numpy as np

import roomlight
from roomlight import Camera, Material, Mesh, Scene

WIDTH, HEIGHT, DEPTH = 3.0, 2.5, 3.5  # of the room, m
DESK = (0.8, 0.74, 0.1, 1.4, 0.7)  # corner x, height, corner z, width, depth, m


def rectangle(corner: List[float], u: List[float], v: List[float], material: int) -> Mesh:
    """Its front is on the side of u x v."""
    c, a, b = np.array(corner), np.array(u), np.array(v)
    return Mesh(np.stack([c, c + a, c + a + b, c + b]), np.array([[0, 1, 2], [0, 2, 3]]), material=material)


def study(lamp: Tuple[float, float]) -> Scene:
    x, y, z, w, d = DESK
    walls = [
        rectangle([0, 0, DEPTH], [WIDTH, 0, 0], [0, 0, -DEPTH], 1),
        rectangle([0, HEIGHT, 0], [WIDTH, 0, 0], [0, 0, DEPTH], 0),
        rectangle([0, 0, 0], [WIDTH, 0, 0], [0, HEIGHT, 0], 0),
        rectangle([WIDTH, 0, DEPTH], [-WIDTH, 0, 0], [0, HEIGHT, 0], 0),
        rectangle([0, 0, DEPTH], [0, 0, -DEPTH], [0, HEIGHT, 0], 0),
        rectangle([WIDTH, 0, 0], [0, 0, DEPTH], [0, HEIGHT, 0], 0),
    ]
    desk = rectangle([x, y, z + d], [w, 0, 0], [0, 0, -d], 1)
    spot = {
        "name": "Desk lamp",
        "type": "point",
        "position": [x + lamp[0] * w, y + lamp[1], z + 0.15],
        "flux": "600 lm",
        "temperature": "3000 K",
    }
    return Scene.from_arrays(
        [*walls, desk],
        materials=[Material((0.75, 0.75, 0.72)), Material((0.4, 0.28, 0.18))],
        cameras=[Camera(eye=(2.7, 1.7, 3.2), target=(1.4, 0.8, 0.4), vertical_fov=60)],
        lighting={"lamps": [spot]},
    )


def on_desk(scene: Scene) -> "np.ndarray[tuple[int], np.dtype[np.float32]]":
    """Illuminance at 5 x 3 points of the desk, lx."""
    x, y, z, w, d = DESK
    grid = np.stack(np.meshgrid(np.linspace(0.1, 0.9, 5), np.linspace(0.15, 0.85, 3)), axis=-1).reshape(-1, 2)
    places = np.stack([x + w * grid[:, 0], np.full(len(grid), y + 0.005), z + d * grid[:, 1]], axis=1)
    return roomlight.illuminance(scene, places, quality="draft")


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    best, best_lux = (0.0, 0.0), 0.0
    for place in [(along, height) for along in (0.0, 0.25, 0.5) for height in (0.3, 0.45, 0.6)]:
        lux = on_desk(study(place))
        where = f"{place[0]:4.0%} along the desk, {place[1]:.2f} m above it"
        print(f"{where}: {lux.mean():4.0f} lx on average, {lux.min():4.0f} lx at least")
        if lux.min() > best_lux:
            best, best_lux = place, float(lux.min())
    print(f"best: {best[0]:.0%} along the desk, {best[1]:.2f} m above it")
    roomlight.render(study(best), quality="draft", width=320, height=180).save(folder / "best.png")


if __name__ == "__main__":
    main()
