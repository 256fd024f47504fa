"""Writes a scene as one binary glTF 2.0 file."""
import json
import struct
import zlib

import numpy as np


def png(pixels):
    """PNG bytes of an array of height x width x 3 values 0..255."""
    h, w, _ = pixels.shape
    rows = np.zeros((h, 1 + 3 * w), np.uint8)
    rows[:, 1:] = np.clip(pixels, 0, 255).astype(np.uint8).reshape(h, 3 * w)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b""))


class Glb:
    """Collects materials, meshes, nodes and cameras; save() writes them."""

    def __init__(self):
        self.blob = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "roomlight samples/flat"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "cameras": [],
                     "textures": [], "images": [], "samplers": [{"magFilter": 9729, "minFilter": 9987}], "extensionsUsed": []}
        self.material_index = {}

    def _view(self, data):
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)})
        self.blob += data
        return len(self.json["bufferViews"]) - 1

    def _accessor(self, array, kind, component, bounds=False):
        entry = {"bufferView": self._view(array.tobytes()), "componentType": component, "count": len(array), "type": kind}
        if bounds:
            entry["min"] = [float(v) for v in array.min(0)]
            entry["max"] = [float(v) for v in array.max(0)]
        self.json["accessors"].append(entry)
        return len(self.json["accessors"]) - 1

    def texture(self, pixels, name):
        self.json["images"].append({"name": name, "mimeType": "image/png", "bufferView": self._view(png(pixels))})
        self.json["textures"].append({"source": len(self.json["images"]) - 1, "sampler": 0})
        return len(self.json["textures"]) - 1

    def _use(self, extension):
        if extension not in self.json["extensionsUsed"]:
            self.json["extensionsUsed"].append(extension)

    def material(self, name, color, roughness=0.6, metallic=0.0, emission=None, transmission=0.0, texture=None, normal=None, double_sided=False):
        """Adds a material; color is linear, emission is luminance in cd/m2 per channel."""
        pbr = {"baseColorFactor": [*map(float, color), 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
        entry = {"name": name, "pbrMetallicRoughness": pbr, "doubleSided": double_sided}
        if normal is not None:
            entry["normalTexture"] = {"index": normal}
        if emission is not None:
            strength = max(emission)
            entry["emissiveFactor"] = [e / strength for e in emission]
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
            self._use("KHR_materials_emissive_strength")
        if transmission:
            entry.setdefault("extensions", {})["KHR_materials_transmission"] = {"transmissionFactor": transmission}
            self._use("KHR_materials_transmission")
        self.json["materials"].append(entry)
        self.material_index[name] = len(self.json["materials"]) - 1

    def add(self, name, shapes):
        """A node with one mesh: a primitive for each material among `shapes` (pairs of material name and Shape)."""
        groups = {}
        for material, shape in shapes:
            groups.setdefault(material, []).append(shape)
        primitives = []
        for material, parts in groups.items():
            offsets = np.cumsum([0] + [len(p.positions) for p in parts[:-1]])
            indices = np.concatenate([p.triangles + o for p, o in zip(parts, offsets)]).astype(np.uint32)
            attributes = {
                "POSITION": self._accessor(np.concatenate([p.positions for p in parts]).astype(np.float32), "VEC3", 5126, True),
                "NORMAL": self._accessor(np.concatenate([p.normals for p in parts]).astype(np.float32), "VEC3", 5126),
                "TEXCOORD_0": self._accessor(np.concatenate([p.uv for p in parts]).astype(np.float32), "VEC2", 5126)}
            primitives.append({"attributes": attributes, "indices": self._accessor(indices.reshape(-1, 1), "SCALAR", 5125),
                               "material": self.material_index[material]})
        self.json["meshes"].append({"name": name, "primitives": primitives})
        self._node(name, mesh=len(self.json["meshes"]) - 1)

    def _node(self, name, **what):
        self.json["nodes"].append({"name": name, **what})
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def camera(self, name, eye, target, yfov_deg=50):
        eye, target = np.array(eye, float), np.array(target, float)
        z = (eye - target) / np.linalg.norm(eye - target)
        x = np.cross([0, 1, 0], z)
        x /= np.linalg.norm(x)
        matrix = [*x, 0, *np.cross(z, x), 0, *z, 0, *eye, 1]
        self.json["cameras"].append({"name": name, "type": "perspective",
                                     "perspective": {"yfov": float(np.radians(yfov_deg)), "aspectRatio": 16 / 9, "znear": 0.05}})
        self._node(name, camera=len(self.json["cameras"]) - 1, matrix=[float(v) for v in matrix])

    def plan_camera(self, name, centre, width):
        """Looks straight down from `centre`, -z at the top of the picture; `width` is what a 16:9 picture shows."""
        half = width / 2
        self.json["cameras"].append({"name": name, "type": "orthographic",
                                     "orthographic": {"xmag": half, "ymag": half * 9 / 16, "znear": 0.0, "zfar": 100.0}})
        self._node(name, camera=len(self.json["cameras"]) - 1, matrix=[1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, *centre, 1])

    def point_light(self, name, position, flux_lm, colour):
        """Shines alike in all directions; `colour` counts up to scale."""
        weight = float(np.dot(colour, [0.2126, 0.7152, 0.0722]))
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        # The colour's components must not exceed 1, so the luminance that it takes away goes into the intensity.
        peak = max(colour)
        lights.append({"name": name, "type": "point", "color": [c / peak for c in colour], "intensity": flux_lm / (4 * np.pi) * peak / weight})
        self._use("KHR_lights_punctual")
        self._node(name, translation=list(position), extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def save(self, path):
        self.blob += b"\0" * (-len(self.blob) % 4)
        document = {k: v for k, v in self.json.items() if v != []}
        document["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as out:
            out.write(struct.pack("<III", 0x46546C67, 2, 12 + 8 + len(text) + 8 + len(self.blob)))
            out.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            out.write(struct.pack("<II", len(self.blob), 0x004E4942) + self.blob)
