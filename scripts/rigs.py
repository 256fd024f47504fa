"""What pictures are measured on: rooms of the test scenes, whose lights scripts/convert_lights.py converts, and the six sample homes, where
they are drawn; each by day and by night."""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HOMES = ("room", "studio", "two_room_flat", "family_flat", "house", "large_house")


class Rig:
    """A scene, its light and, of homes, the first of the views that have names."""

    def __init__(self, name, scene, lighting, options=()):
        self.name, self.scene, self.lighting, self.options = name, scene, lighting, options


def rigs(scenes, converted, only=""):
    """`converted`: the folder of converted lights. Homes are called home_NAME_day and home_NAME_night. `only`: a regular expression."""
    found = [Rig(f.stem, scenes / f.stem.rsplit("_", 1)[0] / "scene.glb", f) for f in sorted(converted.glob("*.json"))]
    samples = ROOT / "build/samples"
    for home in HOMES:
        if (samples / f"{home}.sh3d").exists():
            found += [Rig(f"home_{home}_{light}", samples / f"{home}.sh3d", samples / f"{home}_{light}.json", ("--camera", 2)) for light in ("day", "night")]
    return [r for r in found if re.search(only, r.name)]
