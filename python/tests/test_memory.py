"""Memory stays flat over many opens and renders: the short form of scripts/measure_python."""

import subprocess
import sys
import unittest

import common

MOST_MB = 2.0  # allocated more at the end than after the tenth


class MemoryIsFlat(unittest.TestCase):
    def test_thirty_opens_and_renders(self):
        said = subprocess.run([sys.executable, common.ROOT / "scripts/measure_python", "--times", "30", "--every", "10"],
                              capture_output=True, text=True, check=True, cwd=common.ROOT).stdout
        rows = [line.split() for line in said.splitlines() if line.strip()[:1].isdigit()]
        self.assertEqual([int(r[0]) for r in rows], [10, 20, 30])
        self.assertLess(float(rows[-1][2]) - float(rows[0][2]), MOST_MB, said)


if __name__ == "__main__":
    unittest.main()
