"""A flat for a family of four, 111 m2, its living side to the south; fourteen lamps."""
import arrangements as put
from home import Home


def draw(pieces):
    h = Home("family_flat", "A family flat", pieces, north=180, day=(2026, 5, 9, 14, 30))
    h.room("Living room", (0, 0), (560, 460), floor="oak", walls=0xEEEBE3)
    h.room("Kitchen", (560, 0), (900, 460), floor="oak", walls=0xEEEBE3)
    h.room("Bedroom", (900, 0), (1260, 460), floor="oak", walls=0xD5DAD6)
    h.room("Hall", (0, 460), (1060, 610), floor="oak", walls=0xF1EBDF)
    h.room("Bathroom", (1060, 460), (1260, 760), floor="slate tiles", walls="white tiles")
    h.room("Anna's room", (0, 610), (420, 1000), floor="pine", walls=0xEBDFD6)
    h.room("Ben's room", (420, 610), (760, 1000), floor="pine", walls=0xD6DFE6)
    h.room("Study", (760, 610), (1060, 1000), floor="oak", walls=0xEDEAE4)
    h.flows((560, 150), (560, 460))
    h.build()
    openings(h)
    living(h)
    kitchen(h)
    bedroom(h)
    hall_and_bath(h)
    children(h)
    study(h)
    h.view("Living room", (520, 425, 150), (120, 90, 80))
    h.view("Kitchen", (440, 430, 150), (840, 150, 85))
    h.view("Anna's room", (385, 640, 150), (100, 930, 75))
    return h


def openings(h):
    h.window("scopia:window_4x1", 180, 0, "Living room", elevation=3)
    h.window("scopia:window_3x1", 430, 0, "Living room", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 700, 0, "Kitchen")
    h.window("scopia:window_3x1", 1080, 0, "Bedroom", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 1260, 600, "Bathroom", width=80, height=80, elevation=130)
    h.window("scopia:window_2x1_medium_with_large_pane", 0, 800, "Anna's room", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 590, 1000, "Ben's room", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 910, 1000, "Study", width=150)
    h.door("kator:exterior-door-02", 0, 535, "Hall")
    h.door("scopia:double_door", 380, 460, "Living room")
    h.door("scopia:door", 980, 460, "Bedroom")
    h.door("scopia:door", 1060, 535, "Bathroom")
    h.door("scopia:door", 340, 610, "Anna's room", mirrored=True)
    h.door("scopia:door", 500, 610, "Ben's room")
    h.door("scopia:door", 840, 610, "Study")
    put.curtains(h, 180, 15, "S", 250)
    put.curtains(h, 430, 15, "S", 188)
    put.curtains(h, 1080, 15, "S", 188)
    put.curtains(h, 15, 800, "E", 150, colour=0xC9A08E)


def living(h):
    h.put("own:rug lattice", 200, 235, "E", width=260, depth=200)
    h.stand("scopia:beige_sofa", 17, 240, "E")
    table = h.put("scopia:saloon_table", 170, 240, "E", elevation=1.2)
    h.on(table, "ccby:tulip", -40, 0)
    h.on(table, "ccby:chessboard", 35, 0, facing=25)
    h.put("kator:mid-century-chair", 300, 130, 60, colour=0x5E7480)
    h.lamp(h.put("scopia:living_lamp", 48, 395, 270), "Sofa lamp", 800)
    h.put("own:picture hills", 16.4, 190, "E", elevation=125, width=60, height=80)
    h.put("own:picture brush", 16.4, 280, "E", elevation=125, width=60, height=80)
    stand = h.stand("ccby:tvStand", 170, 453, "N")
    h.on(stand, "cc0:led_tv", 0, -4, scale=1.35)
    h.lamp(h.on(stand, "ccby:lamp", 55, 0), "Television lamp", 400)
    h.stand("ccby:piano", 553, 75, "W")
    h.put("cc0:pianoBench", 470, 75, "W")
    h.put("ccby:yuccaPlant", 305, 50, scale=0.8)
    h.put("cc0:plant", 55, 60, scale=1.0)
    h.ceiling("scopia:saloon_lamp", 280, 235, "Living ceiling", 1400, facing="E", height=50)


def kitchen(h):
    units = put.row(h, 893, 20, "W", [("ccby:kitchenDrawersCabinet", {}), ("ccby:kitchenSink", {}), ("ccby:kitchenLowerCabinet", {"width": 105}),
                                      ("cc0:largeFridge", {})])
    hob = h.on(units[2], "scopia:induction-cooker-4-zones", 0, 2)
    h.on(hob, "ccby:largePan", 10, -8, scale=0.8)
    h.on(units[0], "scopia:coffee_machine", 0, -6, scale=0.8)
    h.on(units[2], "scopia:kitchenKnifeStandSet", -42, -18)
    put.row(h, 893, 64, "W", [("ccby:kitchenUpperCabinet", {"width": 98}), ("ccby:hood", {"width": 105, "elevation": 165})])
    h.lamp(h.stand("kator:fluorescent-strip", 885, 113, "W", elevation=136.5), "Worktop light", 900, 3000)
    table = put.dining(h, "cc0:table", 690, 265, "E", "cc0:osakaChair", 3, width=190, depth=90)
    h.on(table, "scopia:bowlWithFruits", 0, 0)
    h.on(table, "cc0:caffe_final", -50, 25)
    h.on(table, "kator:newspaper", -55, -8, facing=75)
    h.on(table, "ccby:coffeePress", 45, -10)
    h.ceiling("ccby:hangingLight", 690, 265, "Dining pendant", 1055, height=105)
    h.put("own:picture forms", 640, 452.6, "N", elevation=120)


def bedroom(h):
    left, right = put.bed(h, "ccby:lettoCloud", 1243, 215, "W")
    h.lamp(h.on(left, "scopia:little_lamp2"), "Bedside lamp left", 400)
    h.lamp(h.on(right, "scopia:little_lamp2"), "Bedside lamp right", 400)
    h.put("own:rug wool", 990, 215, "E", width=200, depth=110)
    h.stand("scopia:wardrobe1", 1140, 452, "N", width=210)
    h.stand("ccby:dresserWithDrawers", 907, 220, "E", width=140, depth=45)
    h.put("own:picture field", 1243.6, 215, "W", elevation=140)
    h.put("scopia:ficus", 1225, 50, scale=1.5)
    h.ceiling("scopia:ceiling-lamp", 1080, 230, "Bedroom ceiling", 1200)


def hall_and_bath(h):
    h.put("scopia:doormat", 60, 535, "E", width=80, depth=50)
    h.stand("ccby:chest", 160, 603, "N", width=120, depth=38, height=85)
    h.put("own:picture fern", 160, 602.6, "N", elevation=125)
    h.stand("scopia:wall-hanger", 80, 467, "S", elevation=165)
    h.put("cc0:umbrellaFolded", 40, 480)
    h.stand("cc0:bookcase", 660, 603, "N", depth=30)
    h.ceiling("scopia:ceiling-lamp", 500, 535, "Hall ceiling", 1400)
    h.stand("ccby:bath_jay_hardy", 1160, 745, "N")
    h.stand("ccby:washbasin_jay_hardy", 1245, 520, "W")
    h.stand("ccby:toilets_unit_jay_hardy", 1125, 467, "S")
    h.stand("ccby:bathroomRadiator", 1067, 625, "E", elevation=70)
    h.put("kator:bathmat", 1160, 640)
    h.ceiling("scopia:ceiling-lamp", 1160, 600, "Bath ceiling", 1200, 3000)


def children(h):
    h.stand("ccby:juniorBed", 70, 985, "N")
    h.put("own:rug terracotta", 215, 810, "E", width=180, depth=130)
    desk = h.stand("scopia:kids_desk_table", 215, 985, "N")
    h.put("scopia:kids_desk_chair", 215, 900, "S")
    h.lamp(h.on(desk, "scopia:desk_lamp2", 35, -5, facing=200), "Anna's desk lamp", 470, 3000)
    h.on(desk, "ccby:book", -20, 5)
    h.stand("cc0:verticalShelves", 413, 930, "W")
    h.put("cc0:teddyBear", 75, 930, 150, elevation=45)
    h.put("cc0:caballito", 190, 770, 210)
    h.put("scopia:doll-house", 340, 800, "W", elevation=0)
    h.put("ccby:toyTrain", 255, 840, 40, elevation=1.2)
    h.put("own:picture forms", 70, 983.6, "N", elevation=120)
    h.ceiling("ccby:hangingLight", 215, 790, "Anna's ceiling", 1055, height=80, colour=0xD98C6A)

    h.stand("ccby:bunkBed", 752, 880, "W")
    h.put("own:rug indigo", 575, 830, width=180, depth=130)
    h.put("ccby:carrito-de-madera", 560, 800, 60, elevation=1.2)
    h.put("cc0:basketball", 460, 960)
    h.stand("cc0:shelves", 427, 800, "E")
    h.put("scopia:puff", 480, 890, 300, scale=0.9)
    h.ceiling("scopia:ceiling-lamp", 590, 800, "Ben's ceiling", 1200)


def study(h):
    desk = h.stand("ccby:officeTable", 1052, 800, "W", width=170)
    h.put("kator:office-chair", 945, 800, 300, colour=0x3C444A)
    h.on(desk, "ccby:laptop", 0, 5)
    h.lamp(h.on(desk, "scopia:desk_lamp1", -60, -15, facing=60), "Study desk lamp", 600, 3000)
    h.on(desk, "scopia:penbox", 50, -18)
    h.stand("kator:full-bookcase", 767, 860, "E")
    h.stand("kator:full-bookcase", 767, 951, "E")
    h.put("scopia:maceta", 1010, 955, scale=0.9)
