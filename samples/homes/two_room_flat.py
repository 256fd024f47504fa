"""A two-room flat of 53 m2 on an upper floor: living room and bedroom to the south-east, kitchen, bathroom and hall."""
import arrangements as put
from home import Home


def draw(pieces):
    h = Home("two_room_flat", "A two-room flat", pieces, north=150, day=(2026, 3, 28, 11, 0), offset="+01:00")
    h.room("Living room", (0, 0), (500, 420), floor="walnut", walls=0xEDEAE4)
    h.room("Bedroom", (500, 0), (840, 420), floor="walnut", walls=0xD9E0DC)
    h.room("Kitchen", (0, 420), (300, 700), floor="terrazzo", walls=0xF3F0E8)
    h.room("Hall", (300, 420), (620, 700), floor="walnut", walls=0xEFE8DC)
    h.room("Bathroom", (620, 420), (840, 700), floor="white tiles", walls="metro tiles")
    h.build()
    openings(h)
    living(h)
    bedroom(h)
    kitchen(h)
    hall_and_bath(h)
    h.view("Living room", (460, 385, 150), (110, 110, 85))
    h.view("Bedroom", (530, 380, 150), (730, 90, 70))
    h.view("Kitchen", (265, 450, 150), (40, 660, 100))
    return h


def openings(h):
    h.window("scopia:window_4x1", 260, 0, "Living room", elevation=3)
    h.window("scopia:window_3x1", 670, 0, "Bedroom", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 0, 560, "Kitchen")
    h.door("scopia:glass_door", 400, 420, "Living room")
    h.door("scopia:door", 560, 420, "Bedroom")
    h.door("scopia:glass_door", 300, 600, "Kitchen")
    h.door("scopia:door", 620, 600, "Bathroom")
    h.door("kator:exterior-door-02", 430, 700, "Hall")
    put.curtains(h, 260, 15, "S", 250)
    put.curtains(h, 670, 15, "S", 188, colour=0x8FA3A0)


def living(h):
    h.put("own:rug wool", 190, 215, "E", width=260, depth=180)
    h.stand("ccby:sofa3", 17, 215, "E")
    h.lamp(h.put("scopia:living_lamp", 50, 75, 315), "Sofa lamp", 800)
    table = h.put("ccby:coffeeTable", 160, 215, "E", elevation=1.2)
    h.on(table, "cc0:orchids", -25, 0)
    h.on(table, "ccby:book", 30, 8, facing=120)
    h.put("scopia:armchair2", 270, 330, 150)
    stand = h.stand("ccby:dresserWithDrawers", 492, 170, "W", width=150, height=62)
    h.on(stand, "cc0:led_tv", 0, 0, scale=1.3)
    h.lamp(h.on(stand, "scopia:table_lamp", -58, 0), "Television lamp", 400)
    h.put("scopia:ficus", 455, 60, scale=1.75)
    h.stand("kator:full-bookcase", 120, 412, "N")
    h.stand("kator:full-bookcase", 212, 412, "N")
    h.put("own:picture forms", 16.4, 170, "E", elevation=125)
    h.put("own:picture brush", 16.4, 255, "E", elevation=125)
    h.ceiling("kator:hanging-restaurant-light", 250, 215, "Living ceiling", 1100, height=55)


def bedroom(h):
    left, right = put.bed(h, "cc0:bed3", 823, 205, "W", width=185, depth=215, height=100)
    h.lamp(h.on(left, "scopia:little_lamp1"), "Bedside lamp left", 400)
    h.lamp(h.on(right, "scopia:little_lamp1"), "Bedside lamp right", 400)
    h.put("own:rug terracotta", 590, 205, "E", width=190, depth=100)
    h.stand("ccby:wardrobe2", 720, 412, "N", width=200)
    h.stand("scopia:dressing-table", 508, 130, "E")
    h.put("own:picture field", 823.6, 205, "W", elevation=140)
    h.put("ccby:spatifilum", 545, 50, scale=0.7)
    h.ceiling("scopia:ceiling-lamp", 670, 210, "Bedroom ceiling", 1200)


def kitchen(h):
    fridge, sink, lower = put.row(h, 292, 685, "N", [("kator:fridge", {"height": 180}), ("ccby:kitchenSink", {}),
                                                     ("ccby:kitchenLowerCabinet", {"width": 105})])
    hob = h.on(lower, "scopia:induction-cooker-4-zones", 0, 2)
    h.on(hob, "ccby:boiler", -12, -6)
    h.on(lower, "scopia:toaster", 38, -12, facing=200)
    put.row(h, 228, 685, "N", [("ccby:kitchenUpperCabinet", {"width": 95}), ("ccby:hood", {"width": 105, "elevation": 165})])
    h.lamp(h.stand("kator:fluorescent-strip", 180, 675, "N", elevation=136.5), "Worktop light", 900, 3000)
    table = put.dining(h, "scopia:white_kitchen_table", 75, 480, "S", "ccby:chairWithCushion", 1, width=100)
    h.on(table, "scopia:apples", 20, 0)
    h.on(table, "kator:coffee-mug", -20, 12)
    h.ceiling("ccby:hangingLight", 110, 520, "Kitchen pendant", 806, height=90)


def hall_and_bath(h):
    h.stand("ccby:chest", 310, 505, "E", width=110, depth=38, height=80)
    h.put("own:picture fern", 307.4, 505, "E", elevation=120)
    h.put("scopia:doormat", 430, 655)
    h.stand("scopia:wall-hanger", 520, 685, "N", elevation=165)
    h.put("cc0:umbrellaFolded", 590, 668)
    h.ceiling("scopia:ceiling-lamp", 450, 560, "Hall ceiling", 900)
    h.stand("ccby:bath_jay_hardy", 825, 555, "W")
    h.stand("ccby:washbasin_jay_hardy", 690, 427, "S")
    h.stand("ccby:toilets_unit_jay_hardy", 740, 685, "N")
    h.stand("cc0:towel3", 627, 480, "E", elevation=110)
    h.put("kator:bathmat", 715, 560, "E")
    h.ceiling("scopia:ceiling-lamp", 720, 555, "Bathroom ceiling", 1000, 3000)
