#!/usr/bin/env python3
"""The sample home: draws it and checks what roomlight makes of it.  flat_test.py ROOMLIGHT samples/flat"""
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOMLIGHT, SAMPLE = sys.argv[1], pathlib.Path(sys.argv[2])


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True)


class Flat(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="roomlight-flat-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run(sys.executable, SAMPLE / "generate.py", cls.folder)
        for light in SAMPLE.glob("*.json"):
            shutil.copy(light, cls.folder)
        cls.file = cls.folder / "flat.glb"
        cls.info = json.loads(run(ROOMLIGHT, "info", cls.file, "--json").stdout)

    def test_is_read_without_warnings(self):
        self.assertEqual(self.info["warnings"], [])

    def test_has_rooms_with_cameras_and_lamps(self):
        cameras = {c["name"] for c in self.info["cameras"]}
        self.assertLessEqual({"living", "kitchen", "bedroom", "bath", "hall", "plan"}, cameras)
        self.assertGreaterEqual(len(self.info["lamps"]), 2)
        self.assertGreaterEqual(self.info["emissiveMaterials"], 5)

    def test_has_the_detail_and_size_of_a_home(self):
        self.assertGreater(self.info["triangles"], 300_000)
        self.assertLess(self.info["triangles"], 1_500_000)
        low, high = self.info["boundsM"]["low"], self.info["boundsM"]["high"]
        self.assertTrue(all(h - l < limit for l, h, limit in zip(low, high, (14, 3.2, 10))), (low, high))

    def test_triangles_run_counter_clockwise_about_their_normals(self):
        data = self.file.read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        document, blob = json.loads(data[20:20 + length]), data[28 + length:]

        def array(index):
            accessor = document["accessors"][index]
            kind, width = {5126: (np.float32, 3), 5125: (np.uint32, 1)}[accessor["componentType"]]
            start = document["bufferViews"][accessor["bufferView"]]["byteOffset"]
            return np.frombuffer(blob, kind, accessor["count"] * width, start).reshape(-1, width)

        for mesh in document["meshes"]:
            for primitive in mesh["primitives"]:
                p, n = array(primitive["attributes"]["POSITION"]), array(primitive["attributes"]["NORMAL"])
                t = array(primitive["indices"]).reshape(-1, 3)
                face = np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]])
                size = np.linalg.norm(face, axis=1)
                against = (face * n[t].sum(1)).sum(1) < -0.2 * size
                name = f"{mesh['name']}, {document['materials'][primitive['material']]['name']}"
                with self.subTest(name):
                    self.assertLess((against & (size > 1e-8)).mean(), 0.05)
                    self.assertLess(np.abs(np.linalg.norm(n, axis=1) - 1).max(), 1e-3)

    def test_lighting_files_are_accepted(self):
        for light in ("day", "evening"):
            picture = self.folder / f"{light}.png"
            run(ROOMLIGHT, "render", self.file, "--lighting", self.folder / f"{light}.json", "--technique", "path", "--samples", "1", "--size", "32x18", "-o", picture, "--quiet")
            self.assertTrue(picture.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
