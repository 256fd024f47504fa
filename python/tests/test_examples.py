"""The worked examples run, print what they find, and write their pictures."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import common

EXAMPLES = common.ROOT / "python/examples"


class Examples(unittest.TestCase):
    def run_example(self, name, words, pictures):
        with tempfile.TemporaryDirectory() as folder:
            filled = [folder if w == "FOLDER" else str(w) for w in words]
            done = subprocess.run([sys.executable, EXAMPLES / name, *filled], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(p.name for p in Path(folder).iterdir()), sorted(pictures))
            return done.stdout

    def test_picture_and_lux(self):
        said = self.run_example("picture_and_lux.py", [common.sample_room(), "FOLDER", "--lighting", common.NIGHT,
                                                       "--camera", "Sofa corner", "--camera", "Window side"],
                                ["picture_0.png", "picture_1.png"])
        self.assertIn("Ceiling lamp: 1055 lm, Living room", said)
        self.assertRegex(said, r"Sofa corner: \d+\.\d cd/m² on average")
        self.assertRegex(said, r"0\.75 m above the floor: (\d+, ){7}\d+ lx")

    def test_room_of_arrays(self):
        said = self.run_example("room_of_arrays.py", ["FOLDER"], ["all_lamps.png", "evening.png"])
        found = re.search(r"in the evening: (\S+) of (\S+) cd/m²", said)
        self.assertLess(float(found.group(1)), float(found.group(2)))

    def test_best_place(self):
        said = self.run_example("best_place.py", ["FOLDER"], ["best.png"])
        self.assertIn("best: 50% along the desk", said)


if __name__ == "__main__":
    unittest.main()
