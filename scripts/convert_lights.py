#!/usr/bin/env python3
"""Turns the lights.json beside test scenes into lighting files that roomlight reads (docs/formats/lighting.md).

    scripts/convert_lights.py SCENES_DIR OUT_DIR

writes OUT_DIR/<scene>_day.json and <scene>_night.json for every folder of SCENES_DIR that holds scene.glb and lights.json;
a rig without lamps is left out, and said. Rules, the same for all scenes:

day    what the scene file itself emits stays (emissive windows, its own lamps and suns); the environment picture becomes
       the sky; a sun that lights.json lists is added where the file holds no directional light of its own.
night  all of the scene's own light is switched off, the suggested lamps are on.

Pictures in "kilonit" hold thousands of cd/m2. For "author's units", which have no size, the same factor of 1000 is used.
"""
import json
import struct
import sys
from pathlib import Path

KILONIT = "1000 cd/m2"


def glb_json(path):
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


def has_directional_light(gltf):
    lights = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    used = {n.get("extensions", {}).get("KHR_lights_punctual", {}).get("light") for n in gltf.get("nodes", [])}
    return any(lights[i].get("type") == "directional" for i in used if i is not None)


def lamp(source):
    out = {"name": source["name"], "type": source.get("type", "point"), "position": source["position"]}
    if out["type"] == "spot":
        out["direction"] = source.get("direction", [0, -1, 0])
    if "lumens" in source and out["type"] == "point":
        out["flux"] = f"{source['lumens']} lm"
    else:
        out["intensity"] = f"{source['candela']} cd"
    if "kelvin" in source:
        out["temperature"] = f"{source['kelvin']} K"
    return out


def day_rig(folder, lights, gltf):
    rig = {}
    environment = lights.get("environment")
    if environment:
        rig["sky"] = {"image": str((folder / environment["file"]).resolve()), "unit": KILONIT}
    suns = [{"name": s["name"], "direction": s["direction_to_light"], "illuminance": f"{s['lux']} lx"}
            for s in lights.get("day", []) if isinstance(s, dict) and "direction_to_light" in s]
    if suns and not has_directional_light(gltf):
        rig["sun"] = suns
    return rig


def night_rig(lights):
    lamps = [lamp(s) for s in lights.get("night_rig_suggested_by_converter", [])]
    return {"scene": {"lamps": "off", "suns": "off", "sky": "off", "emission": "off"}, "lamps": lamps} if lamps else None


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    scenes, out = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    for source in sorted(scenes.glob("*/lights.json")):
        folder = source.parent
        lights = json.loads(source.read_text())
        for name, rig in (("day", day_rig(folder, lights, glb_json(folder / "scene.glb"))), ("night", night_rig(lights))):
            if rig is None:
                print(f"{folder.name}: no {name} lamps suggested, no file")
                continue
            (out / f"{folder.name}_{name}.json").write_text(json.dumps(rig, indent=2) + "\n")


if __name__ == "__main__":
    main()
