"""Meters, and lighting proposals."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import common
import roomlight
from roomlight import InputError

STUDY = """
version = 1
catalogue = "{catalogue}"
objectives = ["targetMiss", "energy"]
[[zone]]
room = "Living room"
mean = "100 lx"
spacing = 0.8
[[place]]
on = "ceiling"
room = "Living room"
luminaires = ["Downlight 60"]
spacing = 1.6
[search]
evaluations = 500
certify = 0
"""


class Reports(unittest.TestCase):
    def test_a_report_is_that_of_the_program(self):
        room = common.sample_room()
        scene = roomlight.open(room, common.NIGHT)
        report = roomlight.measure(scene, quality="draft")
        said = subprocess.run([common.PROGRAM, "measure", room, "--lighting", common.NIGHT, "--quality", "draft", "--quiet"],
                              capture_output=True, text=True, check=True).stdout
        self.assertEqual(report.table().strip(), said.strip())
        self.assertEqual(str(report), report.table())
        self.assertIn("Living room", str(report.json()))
        self.assertGreater(len(report.csv().splitlines()), 30)
        self.assertTrue(report.html().startswith("<!doctype html>"))

    def test_a_meter_file_as_a_dict(self):
        wish = {"points": [{"name": "Desk", "position": [1.5, 0.8, 1.5], "target": "50 lx"}]}
        report = roomlight.measure(common.lit_cube(), wish, quality="draft")
        self.assertIn("Desk", report.csv())
        with self.assertRaisesRegex(InputError, "position"):
            roomlight.measure(common.lit_cube(), {"points": [{"name": "Desk"}]})

    def test_daylight_factors(self):
        scene = roomlight.open(common.sample_room(), light="day")
        self.assertIn("DF", roomlight.measure(scene, quality="draft", daylight_factor=True).table())


class MetersAnywhere(unittest.TestCase):
    def test_shapes(self):
        meters = roomlight.Meters(common.lit_cube(), quality="draft")
        places = np.array([[1.5, 0.5, 1.5], [1, 0.5, 1]])
        up = meters.illuminance(places)
        self.assertEqual((up.shape, up.dtype), ((2,), np.float32))
        self.assertTrue(np.array_equal(up, meters.illuminance(places.astype(np.float32), np.tile([0, 2, 0], (2, 1)))))
        self.assertEqual(meters.illuminance((1.5, 0.5, 1.5)).shape, (1,))
        readings = meters.read(places, (0, -1, 0))
        self.assertTrue((readings.lux < up).all())
        self.assertEqual(readings.standard_error.shape, (2,))

    def test_an_illuminance_of_the_report(self):
        scene = common.lit_cube()
        wish = {"points": [{"name": "Desk", "position": [1.5, 0.8, 1.5]}]}
        told = roomlight.measure(scene, wish, technique="path", tolerance=0.005).json()
        read = roomlight.illuminance(scene, [1.5, 0.8, 1.5], technique="path", tolerance=0.005)
        self.assertLess(abs(read[0] / told["points"][0]["illuminanceLux"] - 1), 0.03)

    def test_messages(self):
        meters = roomlight.Meters(common.lit_cube(), quality="draft")
        for what, make in ((r"positions: must have the shape \(n, 3\)", lambda: meters.read([[1, 2]])),
                           ("normals: there are 2, and 3 positions", lambda: meters.read(np.ones((3, 3)), np.ones((2, 3)))),
                           ("meter 1", lambda: meters.read(np.ones((2, 3)), [[0, 1, 0], [0, 0, 0]])),
                           ("tolerance: must be from", lambda: roomlight.Meters(common.lit_cube(), tolerance=2)),
                           ("technique", lambda: roomlight.Meters(common.lit_cube(), technique="magic"))):
            with self.subTest(what), self.assertRaisesRegex(InputError, what):
                make()


class Scenes(unittest.TestCase):
    def test_what_a_scene_tells(self):
        scene = roomlight.open(common.sample_room(), common.NIGHT)
        self.assertEqual([(l.name, l.room) for l in scene.lamps],
                         [(n, "Living room") for n in ("Sofa lamp", "Television lamp", "Ceiling lamp")])
        self.assertEqual(scene.rooms[0].name, "Living room")
        self.assertIn(scene.default_camera, [c.name for c in scene.cameras])
        self.assertEqual(scene.metres_per_unit, 1)
        self.assertIsNone(scene.added_lighting)
        self.assertTrue(scene.warnings)

    def test_light_that_was_added(self):
        scene = roomlight.Scene.from_arrays(common.cube(), light="night")
        self.assertTrue(scene.added_lighting)
        again = roomlight.Scene.from_arrays(common.cube(), lighting=scene.added_lighting)
        self.assertEqual(scene.lamps, again.lamps)

    def test_messages(self):
        for what, make in (("none.sh3d", lambda: roomlight.open("none.sh3d")),
                           ("up: write y or z", lambda: roomlight.open(common.sample_room(), up="x")),
                           ("quality", lambda: roomlight.render(common.lit_cube(), quality="superb")),
                           ("Middle", lambda: roomlight.render(common.lit_cube(), "Middle")),
                           ("unknown", lambda: roomlight.render(common.lit_cube(), settings={"sample": 3})),
                           ("camera: is the view's to say", lambda: roomlight.render(common.lit_cube(), "a", view=roomlight.View()))):
            with self.subTest(what), self.assertRaisesRegex(InputError, what):
                make()
        with self.assertRaisesRegex(TypeError, "width: 'wide'"):
            roomlight.render(common.lit_cube(), width="wide")

    def test_names_that_are_no_text(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.fsencode(folder) + b"/\xff.sh3d"
            os.symlink(common.sample_room(), name)
            self.assertTrue(roomlight.open(os.fsdecode(name)).lamps)


class Proposals(unittest.TestCase):
    def test_designs(self):
        with tempfile.TemporaryDirectory() as folder:
            study = Path(folder) / "study.toml"
            study.write_text(STUDY.format(catalogue=common.ROOT / "samples/studies/catalogue.toml"))
            stages = set()
            designs = roomlight.optimise(common.sample_room(), study, Path(folder) / "out", quality="draft",
                                         progress=lambda stage, fraction: stages.add(stage))
            self.assertTrue(designs)
            self.assertEqual(set(designs[0].objectives), {"targetMiss", "energy"})
            for design in designs:
                self.assertTrue(roomlight.open(common.ROOM, design.lighting_files[0]).lamps or not design.fittings)
            self.assertIn("search", stages)
            with self.assertRaisesRegex(InputError, "none.toml"):
                roomlight.optimise(common.ROOM, Path(folder) / "none.toml", Path(folder) / "other")


if __name__ == "__main__":
    unittest.main()
