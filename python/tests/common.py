"""What the tests share. They run from the tree's root: PYTHONPATH=build/release/python python3 python/tests/test_bits.py"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

import roomlight

ROOT = Path(__file__).resolve().parents[2]
ROOM = ROOT / "build/samples/room.sh3d"
NIGHT = ROOT / "build/samples/room_night.json"
PROGRAM = os.environ.get("ROOMLIGHT", str(ROOT / "build/release/roomlight"))
SMALL = {"quality": "draft", "width": 96, "height": 54}

sys.path.insert(0, str(ROOT / "scripts"))


def sample_room():
    """The sample room, drawn where it is missing."""
    if not ROOM.exists():
        subprocess.run([ROOT / "scripts/make-samples", "room"], check=True, stdout=subprocess.DEVNULL)
    return ROOM


def rectangle(corner, u, v, material=0, dtype=(np.float32, np.uint32)):
    """Its front is on the side of u x v."""
    c, a, b = np.array(corner, float), np.array(u, float), np.array(v, float)
    vertices = np.stack([c, c + a, c + a + b, c + b]).astype(dtype[0])
    return roomlight.Mesh(vertices, np.array([[0, 1, 2], [0, 2, 3]], dtype[1]), material=material)


def cube(edge=3.0, **options):
    """Six sides, seen from within."""
    e = edge
    sides = [([0, 0, e], [e, 0, 0], [0, 0, -e]), ([0, e, 0], [e, 0, 0], [0, 0, e]), ([0, 0, 0], [e, 0, 0], [0, e, 0]),
             ([e, 0, e], [-e, 0, 0], [0, e, 0]), ([0, 0, e], [0, 0, -e], [0, e, 0]), ([e, 0, 0], [0, 0, e], [0, e, 0])]
    return [rectangle(*side, **options) for side in sides]


LAMPS = {"lamps": [
    {"name": "Left", "type": "point", "position": [0.8, 2.5, 1.5], "flux": "800 lm"},
    {"name": "Right", "type": "point", "position": [2.2, 2.5, 1.5], "flux": "400 lm", "temperature": "2700 K"}]}
CAMERA = roomlight.Camera(eye=(2.7, 1.6, 2.7), target=(1, 1, 0.5), vertical_fov=60, name="Corner")


def lit_cube(meshes=None, **options):
    return roomlight.Scene.from_arrays(cube() if meshes is None else meshes, cameras=[CAMERA], lighting=LAMPS, **options)
