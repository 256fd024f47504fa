#!/usr/bin/env python3
"""Draws the sample flat and writes it as glTF:  samples/flat/generate.py OUT.glb

Living room with kitchen, bedroom, bath and hall, furnished; nothing is loaded, everything is modelled here."""
import sys

import fittings as fit
import furniture as fur
import materials
import rooms
from furniture import placed
from glb import Glb
from shapes import box


def living(put):
    put("sofa", fur.sofa(), 3.75, 0, 1.95, 90)
    put("coffee table", fur.round_table(0.42, 0.38), 4.85, 0, 1.75)
    put("bowl", fur.vase(0.18), 4.75, 0.38, 1.66)
    put("books on the table", [("book cream", box(0.24, 0.03, 0.17).turned(20).at(0.12, 0.015, 0.1)), ("book blue", box(0.21, 0.022, 0.15).turned(8).at(0.12, 0.041, 0.1))], 4.85, 0.38, 1.75)
    rug = box(2.2, 0.014, 2.9, 0.006)
    rug.uv = rug.uv / [2.2, 2.9] + 0.5
    put("rug", [("rug", rug)], 4.75, 0.007, 1.95)
    put("television bench", fur.sideboard(1.8, 0.46, 0.40), 5.97, 0, 1.75, -90)
    put("television", fur.television(), 6.02, 0.46, 1.75, -90)
    put("armchair", fur.armchair(), 4.95, 0, 3.35, 196)
    put("floor lamp", fur.floor_lamp(), 3.55, 0, 0.50)
    put("plant", fur.plant(1.35), 5.80, 0, 0.36)
    put("bookshelf", fur.bookshelf(), 0.17, 0, 0.72, 90)
    put("picture", fur.framed(0.7, 0.9, "picture hills"), 6.19, 1.62, 0.47, -90)
    put("pictures", placed(fur.framed(0.42, 0.56, "picture forms"), 0, 0, 0) + placed(fur.framed(0.42, 0.56, "picture strokes"), 0.62, 0, 0), 0.004, 1.58, 3.75, 90)
    put("curtains living", fur.curtain_pair(2.2, 2.36, 0.42), 2.0, 2.42, 0.10)
    put("curtains balcony", fur.curtain_pair(1.8, 2.36, 0.42), 4.85, 2.42, 0.10)
    put("curtains west", fur.curtain_pair(1.4, 2.36, 0.36), 0.10, 2.42, 2.1, 90)


def dining(put):
    x, z = 1.85, 2.35
    put("dining table", fur.dining_table(), x, 0, z)
    for k, (dx, dz, turn) in enumerate(((-0.42, 0.60, 180), (0.42, 0.66, 174), (-0.42, -0.60, 0), (0.42, -0.58, 4))):
        put(f"chair {k + 1}", fur.chair(), x + dx, 0, z + dz, turn)
    put("pendant", fur.pendant(0.95), x, 2.6, z)
    put("fruit bowl", fur.bowl_of_fruit(), x - 0.1, 0.741, z)


def kitchen(put):
    put("kitchen", fit.kitchen_run(3.0), 1.85, 0, 4.795, 180)
    put("fridge", fit.tall_unit(), 3.67, 0, 4.795, 180)
    put("kettle", fit.kettle(), 2.75, 0.896, 4.55)
    put("board", [("oak", box(0.26, 0.40, 0.018, 0.006).turned(-12, 0).at(0, 0.20, 0.06))], 3.02, 0.896, 4.79, 180)
    put("jars", placed(fit.bottles(), 0, 0, 0), 0.50, 0.896, 4.56)


def bedroom(put):
    put("bed", fur.bed(), 8.82, 0, 1.95, -90)
    for k, z in enumerate((0.80, 3.10)):
        put(f"nightstand {k + 1}", fur.nightstand(), 9.68, 0, z, -90)
        put(f"bedside lamp {k + 1}", fur.table_lamp(), 9.70, 0.48, z, -90)
    put("wardrobe", fur.wardrobe(), 8.25, 0, 3.69, 180)
    put("bedroom picture", fur.framed(1.1, 0.7, "picture strokes"), 9.895, 1.72, 1.95, -90)
    put("bedroom rug", [("blanket", box(1.1, 0.016, 2.2, 0.007))], 7.75, 0.008, 1.95)
    put("curtains bedroom", fur.curtain_pair(1.8, 2.36, 0.42), 8.1, 2.42, 0.10)
    put("bedroom bench", fur.sideboard(1.0, 0.75, 0.40, 2, "oak", "front white"), 6.52, 0, 1.20, 90)
    put("bedroom mirror", fit.mirror(0.6, 0.8), 6.305, 1.45, 1.20, 90)
    put("bedroom vase", fur.vase(0.24), 6.50, 0.75, 0.95)
    put("bedroom plant", fur.plant(0.9, 30, 9), 6.62, 0, 0.40)


def bath(put):
    put("bathtub", fit.bathtub(), 7.95, 0, 6.585, 180)
    put("basin", fit.basin_unit(), 7.75, 0, 4.11)
    put("bath mirror", fit.mirror(0.8, 0.85), 7.75, 1.52, 4.11)
    put("toilet", fit.toilet(), 6.82, 0, 4.115)
    put("towel", fit.towel(), 8.885, 1.25, 4.75, -90)
    put("bottles", fit.bottles(), 8.0, 0.797, 4.24)
    put("bath lamp", [("globe bath" if m == "globe hall" else m, s) for m, s in fit.ceiling_lamp()], 7.6, 2.6, 5.3)
    put("bath mat", [("towel", box(0.8, 0.02, 0.5, 0.009))], 7.75, 0.01, 5.25)


def hall(put):
    put("hall wardrobe", fur.wardrobe(1.2, 2.2, 0.5, 2), 4.17, 0, 5.75, 90)
    put("hall mirror", fit.mirror(0.5, 1.3), 6.195, 1.35, 5.08, -90)
    put("hall lamp", fit.ceiling_lamp(), 5.1, 2.6, 5.75)
    put("hall rug", [("blanket", box(0.75, 0.012, 1.2, 0.005))], 5.15, 0.006, 5.75)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    glb = Glb()
    materials.define(glb)

    def textured(parts):
        for material, shape in parts:
            shape.uv = shape.uv / materials.SIZE.get(material, 1.0)
        return parts

    def put(name, parts, x=0.0, y=0.0, z=0.0, turn=0.0):
        glb.add(name, textured(placed(parts, x, y, z, turn)))

    glb.camera("living", (5.95, 1.50, 4.55), (2.5, 0.80, 0.6), 52)
    glb.camera("kitchen", (5.55, 1.55, 0.65), (1.7, 0.95, 4.0), 48)
    glb.camera("bedroom", (6.42, 1.45, 3.20), (9.2, 0.75, 1.35), 55)
    glb.camera("bath", (6.50, 1.55, 6.15), (8.3, 0.95, 4.4), 62)
    for name, parts in rooms.shell():
        put(name, parts)
    for room in (living, dining, kitchen, bedroom, bath, hall):
        room(put)
    glb.save(sys.argv[1])


if __name__ == "__main__":
    main()
