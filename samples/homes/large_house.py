"""A large house of 325 m2 on two storeys in an old garden: more than one and a half million triangles."""
import arrangements as put
from home import Home

UPPER = 300.0


def draw(pieces):
    h = Home("large_house", "A large house", pieces, north=175, latitude=47.56, longitude=7.59, zone="Europe/Zurich", day=(2026, 9, 12, 16, 0))
    h.wall_height = h.levels[0].height = 270.0
    ground_floor(h)
    salon(h)
    dining(h)
    kitchen(h)
    library(h)
    hall(h)
    garden(h)
    h.view("Salon", (655, 560, 155), (120, 130, 85))
    h.view("Dining room", (735, 70, 155), (1060, 520, 95))
    h.view("Library", (450, 690, 155), (90, 1080, 90))
    h.upstairs("Upper floor", UPPER)
    upper_floor(h)
    master(h)
    guests(h)
    gallery_and_bath(h)
    return h


def ground_floor(h):
    h.room("Salon", (0, 0), (700, 600), floor="oak", walls=0xEDE8DD)
    h.room("Dining room", (700, 0), (1150, 600), floor="oak", walls=0xDCE0DA)
    h.room("Kitchen", (1150, 0), (1550, 600), floor="terrazzo", walls=0xF3F0E8)
    h.room("Library", (0, 600), (500, 1120), floor="walnut", walls=0x8E9A92)
    h.room("Hall", (500, 600), (1050, 1120), floor="terrazzo", walls=0xF1ECE0)
    h.room("Music room", (1050, 600), (1550, 1120), floor="walnut", walls=0xE6DDD0)
    h.flows((700, 180), (700, 420))
    h.build()
    for x in (140, 400):
        h.window("scopia:window_4x3", x, 0, "Salon", elevation=3)
        put.curtains(h, x, 15, "S", 160)
    h.window("scopia:window_4x3", 610, 0, "Salon", elevation=3, width=110)
    h.window("scopia:window_4x3", 920, 0, "Dining room", elevation=3)
    h.window("scopia:window_4x3", 1350, 0, "Kitchen", elevation=3)
    h.window("scopia:window_2x4", 0, 300, "Salon")
    h.window("scopia:window_2x4", 0, 780, "Library")
    h.window("scopia:window_2x4", 0, 960, "Library")
    h.window("scopia:window_2x4", 1550, 860, "Music room")
    h.door("kator:exterior-door-07", 775, 1120, "Hall")
    h.door("scopia:double_door", 600, 600, "Salon")
    h.door("scopia:double_door", 850, 600, "Dining room")
    h.door("scopia:door", 1150, 480, "Kitchen")
    h.door("scopia:double_door", 500, 800, "Library")
    h.door("scopia:double_door", 1050, 850, "Music room")


def salon(h):
    h.put("own:rug lattice", 300, 290, "S", width=340, depth=240)
    h.put("ccby:cornerSofa", 270, 430, "N")
    table = h.put("scopia:saloon_table", 300, 270, "S", elevation=1.2)
    h.on(table, "ccby:tulips", -45, 0)
    h.on(table, "ccby:chessboard", 30, 0, facing=20)
    h.put("kator:mid-century-chair", 160, 140, 330, colour=0xA8763E)
    h.put("kator:mid-century-chair", 440, 140, 30, colour=0xA8763E)
    h.lamp(h.put("scopia:living_lamp", 60, 470, 225), "Salon floor lamp", 800)
    chest = h.stand("ccby:dresserWithDrawers", 692, 90, "W", width=140)
    h.lamp(h.on(chest, "scopia:table_lamp", -50, 0), "Salon table lamp", 470)
    h.on(chest, "ccby:white_lily", 30, 0)
    h.put("ccby:spatifilum", 60, 60, scale=1.2)
    h.put("own:picture hills", 300, 592.6, "N", elevation=130, width=80, height=100)
    h.put("own:picture forms", 180, 592.6, "N", elevation=130, width=60, height=80)
    h.ceiling("scopia:chandelier-lamp", 300, 270, "Salon chandelier", 1600, width=100, depth=100, height=110)


def dining(h):
    table = put.dining(h, "cc0:table", 930, 300, "E", "cc0:antiqueChair", 4, ends=2, width=260)
    for k in (-1.5, -0.5, 0.5, 1.5):
        put.place_setting(h, table, k * 62, 28, "W")
        put.place_setting(h, table, k * 62, -28, "E")
    h.on(table, "scopia:calla_lily_with_roses", 0, 0)
    h.stand("ccby:chest", 1142, 280, "W")
    h.put("own:picture field", 1142.6, 280, "W", elevation=125, width=70, height=90)
    h.ceiling("scopia:saloon_lamp", 930, 300, "Dining pendant", 1500, height=90)


def kitchen(h):
    units = put.row(h, 1533, 90, "W", [("cc0:refrigerator", {"depth": 75}), ("ccby:kitchenDrawersCabinet", {}), ("ccby:kitchenSink", {}),
                                       ("ccby:largeStove", {}), ("ccby:kitchenLowerCabinet", {})])
    h.on(units[3], "ccby:largePan", -25, -10)
    h.on(units[4], "cc0:kitchenaid", 0, -8)
    h.on(units[1], "ccby:kitchenblender", 0, -8)
    put.row(h, 1533, 180, "W", [("ccby:kitchenUpperCabinet", {"width": 140}), ("ccby:hood", {"elevation": 165})])
    island = h.put("ccby:kitchenIsland", 1350, 320, "W", width=160, depth=85)
    h.on(island, "scopia:bowlWithFruits", 40, 0)
    h.on(island, "ccby:choppingBoard", -30, 5)
    for y in (275, 365):
        h.put("cc0:stool", 1275, y, "E")
    h.ceiling("ccby:hangingLight", 1350, 285, "Island pendant left", 806, height=100)
    h.ceiling("ccby:hangingLight", 1350, 365, "Island pendant right", 806, height=100)
    h.lamp(h.stand("kator:fluorescent-strip", 1525, 250, "W", elevation=136.5), "Worktop light", 900, 3000)


def library(h):
    put.row(h, 485, 1103, "N", [("kator:full-bookcase", {})] * 5)
    put.row(h, 140, 607, "S", [("kator:full-bookcase", {})] * 3)
    h.put("own:rug terracotta", 240, 870, "S", width=260, depth=180)
    h.put("cc0:winchesterArmchair", 340, 960, 120)
    h.put("cc0:winchesterArmchair", 170, 990, 200)
    small = h.put("ccby:cafe_set_mota_table", 255, 1010, height=55, elevation=0)
    h.on(small, "ccby:book", 0, 8, facing=30)
    desk = h.put("ccby:officeTable", 110, 800, "E")
    h.lamp(h.on(desk, "cc0:desklamp", 60, -10), "Library desk lamp", 470)
    h.on(desk, "ccby:book", -20, 5, facing=290)
    h.lamp(h.put("scopia:living_lamp", 445, 1030, 90), "Library floor lamp", 800)
    h.ceiling("cc0:lamp2", 250, 860, "Library ceiling", 1500)


def hall(h):
    h.put("cc0:spiralStaircase", 930, 720, "S", height=UPPER * 356.16 / 264.15)
    h.put("kator:oriental-rug", 700, 900)
    chest = h.stand("ccby:chest", 640, 1103, "N")
    h.on(chest, "ccby:tulip", 30, 0)
    h.lamp(h.on(chest, "ccby:lamp", -45, 0), "Hall table lamp", 400)
    h.ceiling("scopia:ceiling-lamp", 775, 860, "Hall ceiling", 1500)
    h.put("cc0:pianoAQueue", 1290, 830, 30)
    h.put("ccby:yuccaPlant", 1480, 1050)
    h.put("cc0:winchesterSofa", 1300, 1050, "N")
    h.ceiling("scopia:ceiling-lamp", 1300, 860, "Music room ceiling", 1500)


def upper_floor(h):
    h.room("Master bedroom", (0, 0), (600, 560), floor="grey carpet", walls=0xDDD9D0)
    h.room("Guest room", (600, 0), (1080, 560), floor="oak", walls=0xE4E0D4)
    h.room("Garden room", (1080, 0), (1550, 560), floor="oak", walls=0xE9EAE2)
    h.room("Gallery", (500, 560), (1100, 1120), floor="oak", walls=0xF1ECE0)
    h.room("Bathroom", (0, 560), (500, 1120), floor="slate tiles", walls="white tiles")
    h.room("Dressing room", (1100, 560), (1550, 1120), floor="oak", walls=0xEDE9E0)
    h.build()
    for x, room in ((170, "Master bedroom"), (430, "Master bedroom"), (840, "Guest room"), (1300, "Garden room")):
        h.window("scopia:window_4x3", x, 0, room, elevation=3)
        put.curtains(h, x, 15, "S", 160)
    h.window("scopia:window_2x1_medium_with_large_pane", 0, 840, "Bathroom", width=120)
    h.window("scopia:window_2x4", 800, 1120, "Gallery")
    h.door("scopia:door", 550, 560, "Master bedroom")
    h.door("scopia:door", 700, 560, "Guest room")
    h.door("scopia:door", 500, 800, "Bathroom")
    h.door("scopia:door", 1100, 800, "Dressing room")
    h.door("scopia:door", 1080, 300, "Garden room")


def master(h):
    left, right = put.bed(h, "cc0:bed3", 17, 290, "E")
    h.lamp(h.on(left, "scopia:little_lamp1"), "Master bedside left", 400)
    h.lamp(h.on(right, "scopia:little_lamp1"), "Master bedside right", 400)
    h.put("own:rug wool", 330, 290, "E", width=220, depth=140)
    h.stand("ccby:dresserWithDrawers", 592, 250, "W")
    h.put("ccby:mediumIndoorPlant", 545, 70)
    h.stand("scopia:wardrobe1", 250, 552, "N")
    h.ceiling("scopia:ceiling-lamp", 300, 280, "Master ceiling", 1400)


def guests(h):
    left, right = put.bed(h, "cc0:bed2", 1072, 150, "W")
    h.lamp(h.on(right, "scopia:little_lamp2"), "Guest bedside", 400)
    h.stand("ccby:wardrobe2", 900, 552, "N")
    h.ceiling("scopia:ceiling-lamp", 840, 300, "Guest ceiling", 1200)
    h.put("cc0:L_shaped_sofa", 1330, 330, "N")
    h.put("cc0:decorativePlant", 1500, 70)
    h.lamp(h.put("scopia:little_lamp3", 1130, 480, scale=1.9), "Garden room lamp", 800)


def gallery_and_bath(h):
    h.stand("kator:mid-century-sofa", 760, 1103, "N")
    h.ceiling("scopia:ceiling-lamp", 720, 850, "Gallery ceiling", 1400)
    h.put("scopia:islandBath", 200, 840, "E")
    h.stand("scopia:double_vanity", 250, 567, "S", height=200)
    h.stand("ccby:toilets_unit_jay_hardy", 440, 1103, "N")
    h.ceiling("scopia:ceiling-lamp", 250, 840, "Bathroom ceiling", 1400, 3000)
    put.row(h, 1533, 620, "W", [("ccby:wardrobe2", {})] * 2)
    h.ceiling("scopia:ceiling-lamp", 1320, 840, "Dressing room ceiling", 1200)


def garden(h):
    for k in range(14):
        h.put("scopia:hedgeTextured", -500 + 155 * k, -780)
    h.put("scopia:copperBeech", -250, -520)
    h.put("scopia:japaneseMaple", 750, -560, scale=0.8)
    h.put("scopia:sycamoreMaple", 1700, -560, scale=0.7)
    h.put("scopia:poplar", -420, 500)
    for x in (-60, 240, 560):
        h.put("scopia:bush", x + 30, -330, scale=0.7)
    h.put("cc0:relaxChair", 1000, -200, 160)
    h.put("ccby:poolLounge", 1150, -220, 190)
