#!/usr/bin/env python3
"""Makes a room of NumPy arrays, renders the light of each lamp apart, and mixes lamps without rendering again.

    python3 room_of_arrays.py FOLDER
"""

import sys
from pathlib import Path
from typing import Dict, Tuple, Union

import numpy as np
import numpy.typing as npt

import roomlight
from roomlight import Camera, Material, Mesh, Scene


def box(low: Tuple[float, float, float], high: Tuple[float, float, float], inside: bool = False) -> Mesh:
    """A box as trimesh and Open3D hold one: eight vertices, twelve faces. `inside`: it is seen from there."""
    corners: npt.NDArray[np.float64] = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    sides = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    faces = np.concatenate([sides[:, [0, 1, 2]], sides[:, [0, 2, 3]]])
    return Mesh(corners, faces[:, ::-1] if inside else faces)


def room() -> Scene:
    meshes = {
        "walls": box((0, 0, 0), (4, 2.6, 5), inside=True),
        "table": box((1.2, 0.7, 1.2), (2.8, 0.75, 2.2)),
        "sofa": box((0.2, 0, 3.2), (1.1, 0.8, 4.8)),
    }
    for number, mesh in enumerate(meshes.values()):
        mesh.material = number
    for name, mesh in meshes.items():
        mesh.name = name
    lamps = [
        {"type": "point", "name": "Ceiling", "position": [2, 2.3, 2.5], "flux": "1100 lm", "temperature": "3000 K"},
        {"type": "point", "name": "Table", "position": [2, 1.1, 1.7], "flux": "470 lm", "temperature": "2700 K"},
        {"type": "point", "name": "Reading", "position": [0.5, 1.5, 4], "flux": "400 lm", "temperature": "2700 K"},
    ]
    return Scene.from_arrays(
        list(meshes.values()),
        materials=[Material((0.8, 0.78, 0.75)), Material((0.35, 0.22, 0.12), roughness=0.4), Material((0.2, 0.3, 0.4))],
        cameras=[Camera(eye=(3.7, 1.6, 4.7), target=(1.4, 0.9, 1.5), vertical_fov=60, name="Door")],
        lighting={"lamps": lamps},
    )


def main() -> None:
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    scene = room()
    print(scene)

    picture = roomlight.render(scene, quality="draft", width=320, height=180, layers=True)
    picture.save(folder / "all_lamps.png")
    layers = picture.layers()
    for info, light in zip(layers.list, layers):
        print(f"{info.name}: {light.mean():.2f} cd/m² on average")

    evening: Dict[str, Union[str, float]] = {"Ceiling": "off", "Table": 0.6, "Reading": "100%,2200K"}
    layers.save(folder / "evening.png", evening)
    mixed = layers.mix(evening)
    print(f"in the evening: {mixed.mean():.2f} of {picture.pixels.mean():.2f} cd/m²")


if __name__ == "__main__":
    main()
