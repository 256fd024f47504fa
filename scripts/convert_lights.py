#!/usr/bin/env python3
"""Turns the lights.json beside test scenes into lighting files that roomlight reads (docs/reference/lighting.md).

    scripts/convert_lights.py SCENES_DIR OUT_DIR

writes OUT_DIR/<scene>_day.json and <scene>_night.json for every folder of SCENES_DIR that holds scene.glb and lights.json;
a rig without lamps is left out, and said. Rules, the same for all scenes:

day    what the scene file itself emits stays (emissive windows, its own lamps and suns); the environment picture becomes
       the sky; a sun that lights.json lists is added where the file holds no directional light of its own.
night  all of the scene's own light is switched off, the suggested lamps are on. A suggested lamp that bears the name of a
       lamp in the scene file stands for it: it takes that lamp's aim, cones and colour where lights.json gives none.

Positions are those of the scene file, so the files go with renderings at one metre a unit. Flux is used where it is given,
except of spots, whose candela is what their maker set.

Pictures in "kilonit" hold thousands of cd/m2. For "author's units", which have no size, the same factor of 1000 is used.
"""
import json
import math
import struct
import sys
from pathlib import Path

KILONIT = "1000 cd/m2"


def glb_json(path):
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length])


def axis_of(node):
    """-z of the node, unit. Of the node alone: parents that turn it are not followed."""
    if "matrix" in node:
        axis = [-v for v in node["matrix"][8:11]]
    else:
        x, y, z, w = node.get("rotation", [0, 0, 0, 1])
        axis = [-2 * (x * z + y * w), -2 * (y * z - x * w), -(1 - 2 * (x * x + y * y))]
    size = math.hypot(*axis)
    return [round(v / size, 6) + 0.0 for v in axis]


def punctual_lights(gltf):
    """Lights that nodes of the scene file hold, each with its name and the axis of its node."""
    lights = gltf.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    found = []
    for node in gltf.get("nodes", []):
        index = node.get("extensions", {}).get("KHR_lights_punctual", {}).get("light")
        if index is not None:
            light = lights[index]
            found.append({**light, "name": light.get("name") or node.get("name", ""), "axis": axis_of(node)})
    return found


def lamp(source, own):
    """`own`: the scene file's lamp of the same name, or {}."""
    out = {"name": source["name"], "type": source.get("type", "point"), "position": source["position"]}
    if out["type"] == "spot":
        out["direction"] = source.get("direction", own.get("axis", [0, -1, 0]))
        cones = own.get("spot", {})
        for key, name in (("innerCone", "innerConeAngle"), ("outerCone", "outerConeAngle")):
            if name in cones:
                out[key] = round(math.degrees(cones[name]), 3)
    if "lumens" in source and (out["type"] == "point" or "candela" not in source):
        out["flux"] = f"{source['lumens']} lm"
    else:
        out["intensity"] = f"{source['candela']} cd"
    if "kelvin" in source:
        out["temperature"] = f"{source['kelvin']} K"
    elif "color" in own:
        out["color"] = own["color"]
    return out


def day_rig(folder, lights, gltf):
    rig = {}
    environment = lights.get("environment")
    if environment:
        rig["sky"] = {"image": str((folder / environment["file"]).resolve()), "unit": KILONIT}
    suns = [{"name": s["name"], "direction": s["direction_to_light"], "illuminance": f"{s['lux']} lx"}
            for s in lights.get("day", []) if isinstance(s, dict) and "direction_to_light" in s]
    if suns and not any(light.get("type") == "directional" for light in punctual_lights(gltf)):
        rig["sun"] = suns
    return rig


def night_rig(lights, gltf):
    own = {light["name"]: light for light in punctual_lights(gltf)}
    lamps = [lamp(s, own.get(s["name"], {})) for s in lights.get("night_rig_suggested_by_converter", [])]
    return {"scene": {"lamps": "off", "suns": "off", "sky": "off", "emission": "off"}, "lamps": lamps} if lamps else None


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    scenes, out = Path(sys.argv[1]), Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    for source in sorted(scenes.glob("*/lights.json")):
        folder = source.parent
        lights = json.loads(source.read_text())
        gltf = glb_json(folder / "scene.glb")
        for name, rig in (("day", day_rig(folder, lights, gltf)), ("night", night_rig(lights, gltf))):
            if rig is None:
                print(f"{folder.name}: no {name} lamps suggested, no file")
                continue
            (out / f"{folder.name}_{name}.json").write_text(json.dumps(rig, indent=2) + "\n")


if __name__ == "__main__":
    main()
