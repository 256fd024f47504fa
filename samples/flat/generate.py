#!/usr/bin/env python3
"""Draws the sample flat:  samples/flat/generate.py FOLDER  writes FOLDER/flat.glb, FOLDER/day.hdr and FOLDER/evening.hdr.

Living room with kitchen, bedroom, bath and hall, furnished; nothing is loaded, everything is modelled here."""
import pathlib
import sys

import bath
import decor
import furniture_bedroom as bedroom
import furniture_dining as dining
import furniture_living as living
import kitchen
import lamps
import materials
import outside
import rooms
from furniture_living import placed
from glb import Glb


def furnish_living(put):
    x, z = 3.72, 1.75
    put("sofa", living.sofa(), x, 0, z, 90)
    put("rug", decor.rug(2.5, 3.3), 5.0, 0, 1.75)
    put("coffee tables", living.coffee_tables(), 4.98, 0, 1.55)
    put("magazines", decor.magazines(), 4.86, 0.343, 1.42)
    put("table vase", decor.branches(0.20, 0.42), 5.34, 0.423, 2.01)
    put("candles", decor.candles(), 5.02, 0.343, 1.70)
    put("armchair", living.armchair(), 4.70, 0, 3.58, 202)
    put("slatted panel", living.slatted_panel(2.75), rooms.LIVING_X, 0, 1.47, -90)
    put("television bench", living.media_bench(), rooms.LIVING_X - 0.25, 0, 1.47, -90)
    put("television", living.television(), rooms.LIVING_X - 0.085, 0.74, 1.47, -90)
    put("bench vase", decor.vase(0.24, "stoneware dark"), rooms.LIVING_X - 0.22, 0.48, 0.58)
    put("bench books", decor.magazines(), rooms.LIVING_X - 0.24, 0.48, 2.30, 90)
    put("fig tree", decor.fig_tree(), 6.34, 0, 0.42)
    put("floor lamp", lamps.floor_lamp(), 3.62, 0, 0.42)
    put("console", living.console(1.5, 0.72, 0.30), 3.06, 0, z, -90)
    put("console lamp", lamps.table_lamp(small=False), 3.06, 0.72, 2.28)
    put("console vase", decor.vase(0.30, "ceramic"), 3.06, 0.72, 1.22)
    put("console books", decor.magazines(), 3.06, 0.72, 1.68, 90)
    put("console basket", living.basket(0.15, 0.22), 3.06, 0.23, 1.40)
    put("basket", living.basket(), 4.40, 0, 4.92)
    put("palm", decor.palm(1.15), 4.05, 0, 4.90)
    put("picture field", decor.framed(0.72, 0.96, "picture field", "frame"), 4.28, 1.62, rooms.LIVING_Z, 180)
    put("bookshelf", living.bookshelf(), 0.18, 0, 0.68, 90)
    put("shelf plant", decor.trailing(), 0.18, 2.013, 1.02, 90)
    put("curtains living", decor.curtain_pair(2.2, 2.40, 0.42, seed=1), 2.0, 2.44, 0.11)
    put("curtains balcony", decor.curtain_pair(1.9, 2.40, 0.42, seed=5), 5.1, 2.44, 0.11)
    put("curtains west", decor.curtain_pair(1.4, 2.40, 0.30, seed=9), 0.11, 2.44, 2.35, 90)


def furnish_dining(put):
    x, z = 1.62, 2.42
    put("dining table", dining.dining_table(), x, 0, z)
    for k, (dx, dz, turn) in enumerate(((-0.46, 0.66, 180), (0.44, 0.74, 171), (-0.46, -0.64, 0), (0.44, -0.62, 5))):
        put(f"chair {k + 1}", dining.chair(), x + dx, 0, z + dz, turn)
        put(f"setting {k + 1}", dining.place_setting(), x + (-0.46 if k % 2 == 0 else 0.44), 0.74, z + (0.26 if k < 2 else -0.26), 0 if k < 2 else 180)
    for k, dx in enumerate((-0.45, 0.45)):
        put(f"pendant {k + 1}", lamps.pendant(1.08), x + dx, rooms.HEIGHT, z)
    put("fruit bowl", dining.bowl_of_fruit(), x, 0.741, z)
    put("picture forms", decor.framed(0.50, 0.68, "picture forms", "frame", 0.07), 0, 1.60, 3.62, 90)
    put("picture fern", decor.framed(0.50, 0.68, "picture fern", "frame", 0.07), 0, 1.60, 4.24, 90)


def furnish_kitchen(put):
    back, right = rooms.LIVING_Z - 0.001, 3.03

    def stand(name, parts, x, y, z, turn=0):
        """Places parts in the kitchen's own frame: x from its left end, z away from the wall."""
        put(name, placed(parts, x, y, z, turn), right, 0, back, 180)

    stand("kitchen", kitchen.run(), 0, 0, 0)
    put("fridge", kitchen.tall_unit(), right + 0.63, 0, back, 180)
    stand("pots", kitchen.pots(), 1.98, kitchen.TOP + 0.006, 0.22)
    stand("kettle", kitchen.kettle(), 1.55, kitchen.TOP, 0.32, 140)
    stand("cutting boards", kitchen.boards(), 1.30, kitchen.TOP, 0.012)
    stand("jars", kitchen.jars(), 2.50, kitchen.TOP, 0.16)
    stand("herbs", decor.herbs(), 0.42, kitchen.TOP, 0.18)
    stand("herbs 2", decor.herbs(5, "stoneware"), 0.25, kitchen.TOP, 0.20)


def furnish_bedroom(put, glb):
    (x0, x1), z = rooms.BED_X, 1.95
    put("bed", bedroom.bed(), x1 - 1.13, 0, z, -90)
    put("bedroom rug", decor.rug(1.9, 2.9), x1 - 1.65, 0, z)
    for k, dz in enumerate((-1.15, 1.15)):
        put(f"nightstand {k + 1}", bedroom.nightstand(), x1 - 0.22, 0, z + dz, -90)
        at = (x1 - 0.20, 0.48, z + dz + 0.07 * (1 - 2 * k))
        put(f"bedside lamp {k + 1}", lamps.table_lamp(), *at)
        glb.point_light(f"bedside bulb {k + 1}", (at[0], at[1] + 0.27, at[2]), 330, materials.WARM)
    put("bench", bedroom.bench(), x1 - 2.48, 0, z, 90)
    put("wardrobe", bedroom.wardrobe(), 9.55, 0, rooms.BED_Z - 0.30, 180)
    put("picture hills", decor.framed(1.25, 0.80, "picture hills", "frame", 0.06), x1 - 0.004, 1.62, z, -90)
    put("dresser", bedroom.dresser(), x0 + 0.24, 0, 1.35, 90)
    put("round mirror", bedroom.round_mirror(), x0, 1.48, 1.45, 90)
    put("dresser vase", decor.branches(0.24, 0.55, 7), x0 + 0.22, 0.792, 0.98)
    put("dresser books", decor.magazines(), x0 + 0.24, 0.792, 1.62, 90)
    put("bedroom palm", decor.palm(1.0, 34, 9), 7.30, 0, 0.40)
    put("curtains bedroom", decor.curtain_pair(2.0, 2.40, 0.46, seed=13), 8.9, 2.44, 0.11)
    put("ceiling lamp bedroom", lamps.globe_lamp(), 8.7, rooms.HEIGHT, z)


def furnish_bath(put):
    (x0, x1), (z0, z1) = rooms.BATH_X, rooms.BATH_Z
    put("bathtub", bath.bathtub(), x1 - 0.56, 0, 5.78, 90)
    put("tub filler", bath.tub_filler(), x1 - 0.085, 0, 5.20, -90)
    put("basin", bath.basin_unit(), 7.85, 0, z0 + 0.011)
    put("bath mirror", bath.wall_mirror(0.95, 0.82), 7.85, 1.70, z0)
    put("mirror lamp", lamps.mirror_lamp(), 7.85, 2.20, z0)
    put("bottles", bath.bottles(), 8.12, 0.79, z0 + 0.15)
    put("bath herbs", decor.herbs(3, "stoneware"), 7.48, 0.79, z0 + 0.16)
    put("toilet", bath.toilet(), 7.95, 0, z1 - 0.011, 180)
    put("picture brush", decor.framed(0.40, 0.54, "picture brush", "frame black", 0.05), 7.95, 1.72, z1, 180)
    put("towel ladder", bath.ladder(), 8.85, 0, z0 + 0.01)
    put("towel", bath.towel_rail(), x0 + 0.010, 1.10, 4.95, 90)
    put("stool", bath.stool_with_towel(), 8.55, 0, 6.45)
    put("bath mat", decor.rug(0.55, 0.90, "bath mat", False), 8.45, 0, 5.55)
    put("bath palm", decor.palm(0.85, 30, 4), 9.44, 0, 4.40)
    put("bath lamp", lamps.globe_lamp(), 8.3, rooms.HEIGHT, 5.5)


def furnish_hall(put):
    (x0, _), (z0, z1) = rooms.HALL_X, rooms.HALL_Z
    put("hall wardrobe", bedroom.wardrobe(1.5, 2.3, 0.5, 3), x0 + 0.25, 0, (z0 + z1) / 2, 90)
    put("hall console", living.console(0.95, 0.80, 0.28), 6.20, 0, z1 - 0.15, 180)
    put("hall mirror", bedroom.round_mirror(0.34), 6.20, 1.50, z1, 180)
    put("hall vase", decor.branches(0.22, 0.45, 11), 6.42, 0.80, z1 - 0.15)
    put("hall rug", decor.rug(0.80, 1.6), 5.55, 0, 6.15, 90)
    put("hall lamp", lamps.globe_lamp(), 5.3, rooms.HEIGHT, 6.1)
    put("hall picture", decor.framed(0.36, 0.48, "picture brush", "frame", 0.04), rooms.LIVING_X, 1.6, 5.52, -90)


def cameras(glb):
    glb.camera("living", (6.62, 1.38, 3.05), (2.4, 0.80, 1.80), 50)
    glb.camera("sofa", (2.55, 1.40, 4.10), (5.7, 0.75, 0.9), 50)
    glb.camera("kitchen", (3.62, 1.50, 2.35), (1.2, 1.00, 4.75), 52)
    glb.camera("bedroom", (7.06, 1.42, 3.28), (10.0, 0.76, 1.35), 54)
    glb.camera("bath", (7.06, 1.48, 6.72), (8.75, 0.88, 4.75), 62)
    glb.camera("hall", (5.62, 1.50, 6.82), (5.30, 1.12, 3.0), 60)
    glb.plan_camera("plan", (5.45, 2.3, 2.75), 17.4)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    glb = Glb()
    materials.define(glb)

    def put(name, parts, x=0.0, y=0.0, z=0.0, turn=0.0):
        parts = placed(parts, x, y, z, turn)
        for material, shape in parts:
            shape.uv = shape.uv / materials.SIZE.get(material, 1.0)
        glb.add(name, parts)

    cameras(glb)
    for name, parts in rooms.shell():
        put(name, parts)
    for furnish in (furnish_living, furnish_dining, furnish_kitchen, furnish_bath, furnish_hall):
        furnish(put)
    furnish_bedroom(put, glb)
    glb.save(folder / "flat.glb")
    outside.write_skies(folder)


if __name__ == "__main__":
    main()
