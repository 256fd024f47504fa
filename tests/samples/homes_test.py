#!/usr/bin/env python3
"""The six homes of Sweet Home 3D: draws them and checks what roomlight makes of them.  homes_test.py ROOMLIGHT samples/homes"""
import hashlib
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

ROOMLIGHT, SAMPLE = sys.argv[1], pathlib.Path(sys.argv[2])
FURNITURE = pathlib.Path("/usr/share/sweethome3d/furniture")
# Rooms and lamps of each.
HOMES = {"room": (1, 3), "studio": (2, 5), "two_room_flat": (5, 10), "family_flat": (8, 14), "house": (9, 14), "large_house": (12, 22)}


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True)


@unittest.skipUnless(FURNITURE.is_dir(), f"{FURNITURE} is missing: install sweethome3d-furniture (scripts/setup --samples)")
class Homes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="roomlight-homes-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run(sys.executable, SAMPLE / "make.py", cls.folder)
        cls.xml, cls.info = {}, {}
        for name in HOMES:
            with zipfile.ZipFile(cls.folder / f"{name}.sh3d") as archive:
                cls.xml[name] = ElementTree.fromstring(archive.read("Home.xml"))
            cls.info[name] = json.loads(run(ROOMLIGHT, "info", cls.folder / f"{name}.sh3d", "--json").stdout)

    def each(self):
        return [(name, self.xml[name], self.info[name]) for name in HOMES]

    def test_every_model_is_there(self):
        for name, xml, info in self.each():
            with zipfile.ZipFile(self.folder / f"{name}.sh3d") as archive:
                entries = set(archive.namelist())
            named = {e.get(key) for e in xml.iter() for key in ("model", "icon", "image") if e.get(key)}
            self.assertLessEqual(named, entries)
            wrong = r"stands? as a box|not drawn|stay dark|daylight|joined|cut-out|left out"
            self.assertEqual([w for w in info["warnings"] if re.search(wrong, w)], [], name)

    def test_rooms_lamps_and_views_have_names_of_their_own(self):
        for name, xml, info in self.each():
            rooms = [r.get("name") for r in xml.iter("room")]
            lamps = [p.get("name") for p in xml.iter("light")]
            self.assertEqual((len(rooms), len(lamps)), HOMES[name], name)
            self.assertEqual((len(set(rooms)), len(set(lamps))), HOMES[name], name)
            views = [c.get("name") for c in xml if c.get("attribute") == "storedCamera"]
            self.assertEqual(len(set(views)), 3)
            self.assertLessEqual(set(views), {c["name"] for c in info["cameras"]})

    def test_lamps_shine_and_are_off_by_day(self):
        for name, xml, info in self.each():
            self.assertTrue(all(0 < float(p.get("power")) <= 1 for p in xml.iter("light")))
            sources = sum(len(p.findall("lightSource")) for p in xml.iter("light"))
            self.assertEqual(info["emissiveMaterials"] + len(info["lamps"]), sources)
            day = json.loads((self.folder / f"{name}_day.json").read_text())
            self.assertEqual((day["scene"]["lamps"], day["scene"]["emission"]), ("off", "off"))

    def test_walls_are_joined_both_ways(self):
        for _, xml, _ in self.each():
            walls = {w.get("id"): w for w in xml.iter("wall")}
            for wall in walls.values():
                for key in ("wallAtStart", "wallAtEnd"):
                    if wall.get(key):
                        other = walls[wall.get(key)]
                        self.assertIn(wall.get("id"), (other.get("wallAtStart"), other.get("wallAtEnd")))

    def test_no_view_stands_in_furniture_or_walls(self):
        for _, xml, _ in self.each():
            elevations = {e.get("id"): float(e.get("elevation")) for e in xml.iter("level")}
            for view in (c for c in xml if c.get("attribute") == "storedCamera"):
                x, y, z = (float(view.get(k)) for k in "xyz")
                for piece in (p for p in xml if p.get("model") and not p.get("staircaseCutOutShape")):
                    low = float(piece.get("elevation")) + elevations.get(piece.get("level"), 0)
                    a = float(piece.get("angle"))
                    dx, dy = x - float(piece.get("x")), y - float(piece.get("y"))
                    across, along = abs(dx * math.cos(a) + dy * math.sin(a)), abs(dy * math.cos(a) - dx * math.sin(a))
                    width, depth, height = (float(piece.get(k)) for k in ("width", "depth", "height"))
                    inside = low < z < low + height and across < width / 2 and along < depth / 2
                    self.assertFalse(inside, f"{view.get('name')} stands in {piece.get('name')}")

    def test_the_large_house_is_large(self):
        self.assertGreater(self.info["large_house"]["triangles"], 1_500_000)

    def test_every_piece_has_its_credit(self):
        credits = (self.folder / "CREDITS.md").read_text()
        for _, xml, _ in self.each():
            for piece in (p for p in xml if p.get("catalogId") and not p.get("catalogId").startswith("roomlight#")):
                line = next((l for l in credits.splitlines() if f"`{piece.get('catalogId')}`" in l), "")
                self.assertRegex(line, r"\| CC(0|-BY-3\.0(-US)?) \|")
                self.assertIn(piece.get("creator"), line)

    def test_lighting_files_are_accepted(self):
        for light in ("day", "night"):
            picture = self.folder / f"{light}.png"
            run(ROOMLIGHT, "render", self.folder / "room.sh3d", "--lighting", self.folder / f"room_{light}.json", "--camera", "Sofa corner",
                "--technique", "path", "--samples", "1", "--size", "32x18", "-o", picture, "--quiet")
            self.assertTrue(picture.exists())

    def test_is_the_same_every_time(self):
        again = self.folder / "again"
        run(sys.executable, SAMPLE / "make.py", again, "room")
        digest = lambda path: hashlib.sha256(path.read_bytes()).hexdigest()
        self.assertEqual(digest(again / "room.sh3d"), digest(self.folder / "room.sh3d"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
