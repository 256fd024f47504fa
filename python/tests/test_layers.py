"""Pictures in layers, mixed."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import common
import roomlight
from exr import read_exr
from roomlight import InputError


class MixesOfLayers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.picture = roomlight.render(common.lit_cube(), layers=True, **common.SMALL)
        cls.layers = cls.picture.layers()

    def test_layers_have_names_and_light(self):
        self.assertEqual(self.layers.names, ["Left", "Right"])
        self.assertEqual((len(self.layers), self.layers.width, self.layers.height), (2, 96, 54))
        left, right = self.layers.list
        self.assertEqual((left.kind, round(left.flux), round(right.kelvin)), ("lamp", 800, 2700))
        self.assertTrue(np.array_equal(self.layers["Right"], self.layers[-1]))
        self.assertEqual(len(self.layers[:]), 2)

    def test_layers_add_up_to_the_picture(self):
        np.testing.assert_allclose(sum(self.layers), self.picture.pixels, rtol=1e-5, atol=1e-5)
        np.testing.assert_allclose(self.layers.mix(), self.picture.pixels, rtol=1e-5, atol=1e-5)

    def test_dials(self):
        left, right = self.layers
        np.testing.assert_allclose(self.layers.mix({"Left": 0.25, "Right": False}), 0.25 * left, rtol=1e-5, atol=1e-7)
        np.testing.assert_allclose(self.layers.mix({"*": "off", "Right": "200%"}), 2 * right, rtol=1e-5, atol=1e-7)
        self.assertTrue(np.array_equal(self.layers.mix({"Left": "60%"}), self.layers.mix({"Left": 0.6})))
        gains = self.layers.gains({"Left": "50%"}, kelvin=None)
        np.testing.assert_allclose(gains, [[0.5] * 3, [1] * 3], rtol=1e-6)
        warm = self.layers.mix(kelvin=2000).mean(axis=(0, 1))
        self.assertGreater(warm[0], 2 * warm[2])

    def test_mixes_are_not_copied(self):
        mix = self.layers.mix()
        self.assertFalse(mix.flags.owndata or mix.flags.writeable)

    def test_dimmed_lamps_look_dimmed(self):
        dim = self.layers.display({"*": 0.1})
        self.assertLess(dim.mean(), 0.7 * self.layers.display().mean())
        self.assertGreater(self.layers.display({"*": 0.1}, exposure="mix").mean(), dim.mean())

    def test_saved_and_opened_again(self):
        with tempfile.TemporaryDirectory() as folder:
            self.picture.save(Path(folder) / "layers.exr")
            opened = roomlight.open_layers(Path(folder) / "layers.exr")
            self.assertEqual(opened.names, self.layers.names)
            opened.save(Path(folder) / "mix.exr", {"Left": "off"})
            channels = read_exr(Path(folder) / "mix.exr")[0]
            self.assertTrue(np.array_equal(channels["G"], opened.mix({"Left": "off"})[..., 1]))
            for kind in ("png", "jpg", "webp"):
                opened.save(Path(folder) / f"mix.{kind}", {"Left": "off"}, look="bright")
                self.assertGreater((Path(folder) / f"mix.{kind}").stat().st_size, 100)

    def test_lamps_of_a_room_together(self):
        scene = roomlight.open(common.sample_room(), common.NIGHT)
        names = roomlight.render(scene, layers="room", **common.SMALL).layers().names
        self.assertIn("Living room", names)

    def test_messages(self):
        for what, make in (("no lamp|matches|unknown", lambda: self.layers.mix({"Middle": "off"})),
                           ("Left", lambda: self.layers.mix({"Left": "half"})),
                           ("layer 'Middle': there are Left, Right", lambda: self.layers["Middle"]),
                           ("the picture has no layers", lambda: roomlight.render(common.lit_cube(), **common.SMALL).layers()),
                           ("does not keep lamps apart", lambda: roomlight.render(common.lit_cube(), technique="cone",
                                                                                  layers=True)),
                           ("True, False or 'room'", lambda: roomlight.render(common.lit_cube(), layers="house")),
                           ("none.exr", lambda: roomlight.open_layers("none.exr"))):
            with self.subTest(what), self.assertRaisesRegex(InputError, what):
                make()
        with self.assertRaises(IndexError):
            self.layers[2]


if __name__ == "__main__":
    unittest.main()
