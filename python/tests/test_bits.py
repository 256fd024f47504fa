"""Pictures of the module are those of the program, bit by bit."""

import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import common
import roomlight
from exr import read_exr
from png import read_png

WORDS = ["--quality", "draft", "--size", "96x54", "--seed", "7", "--quiet"]
CHANNELS = ("R", "G", "B")


class BitsOfTheProgram(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.out = Path(cls.folder.name)
        cls.room = common.sample_room()

    def program(self, *words):
        subprocess.run([common.PROGRAM, *map(str, words)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def same(self, channels, pixels, prefix=""):
        for i, name in enumerate(CHANNELS):
            self.assertTrue(np.array_equal(channels[prefix + name].view(np.uint32), pixels[..., i].view(np.uint32)), name)

    def test_techniques_by_day(self):
        scene = roomlight.open(self.room)
        for technique in ("hybrid", "path"):
            with self.subTest(technique):
                few = ["--samples", "1"] if technique == "path" else []
                self.program("render", self.room, *WORDS, *few, "--technique", technique, "-o", self.out / "day.exr")
                picture = roomlight.render(scene, technique=technique, seed=7, samples=1 if few else 0, **common.SMALL)
                self.same(read_exr(self.out / "day.exr")[0], picture.pixels)

    def test_by_night_with_another_camera_and_settings(self):
        self.program("render", self.room, "--lighting", common.NIGHT, "--camera", "Sofa corner", *WORDS, "--threads", "1",
                     "-o", self.out / "night.exr", "-o", self.out / "night.png")
        scene = roomlight.open(self.room, common.NIGHT, cameras=["Sofa corner"])
        picture = roomlight.render(scene, "Sofa corner", settings={"seed": 7}, **common.SMALL)
        self.same(read_exr(self.out / "night.exr")[0], picture.pixels)
        self.assertTrue(np.array_equal(read_png(self.out / "night.png"), picture.display()))
        picture.save(self.out / "again.exr")
        self.same(read_exr(self.out / "again.exr")[0], picture.pixels)
        roomlight.write(picture.display(), self.out / "again.png")
        self.assertTrue(np.array_equal(read_png(self.out / "again.png"), picture.display()))

    def test_layers_and_mixes(self):
        self.program("render", self.room, "--lighting", common.NIGHT, *WORDS, "--layers", "-o", self.out / "layers.exr")
        self.program("mix", self.out / "layers.exr", "--lamp", "Sofa lamp=40%,2200K", "--lamp", "Ceiling*=off",
                     "-o", self.out / "mix.png")
        scene = roomlight.open(self.room, common.NIGHT)
        layers = roomlight.render(scene, seed=7, layers=True, **common.SMALL).layers()
        opened = roomlight.open_layers(self.out / "layers.exr")
        self.assertEqual(layers.list, opened.list)
        for mine, theirs in zip(layers, opened):
            self.assertTrue(np.array_equal(mine, theirs))
        dials = {"Sofa lamp": "40%,2200K", "Ceiling*": "off"}
        self.assertTrue(np.array_equal(read_png(self.out / "mix.png"), opened.display(dials)))
        self.assertTrue(np.array_equal(opened.mix(dials), layers.mix(dials)))

    def test_the_program_within_python(self):
        out = self.out / "within.exr"
        self.assertEqual(roomlight.main(["render", str(self.room), *WORDS, "-o", str(out)]), 0)
        picture = roomlight.render(roomlight.open(self.room), seed=7, **common.SMALL)
        self.same(read_exr(out)[0], picture.pixels)
        self.assertEqual(roomlight.main(["render", str(self.out / "none.sh3d"), "-o", str(out)]), 2)


if __name__ == "__main__":
    unittest.main()
