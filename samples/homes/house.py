"""A house on two storeys, 124 m2: living, kitchen and office below, bedrooms above, a garden around it."""
import arrangements as put
from home import Home

UPPER = 290.0


def draw(pieces):
    h = Home("house", "A two-storey house", pieces, north=190, latitude=50.94, longitude=6.96, day=(2026, 6, 6, 17, 0))
    ground_floor(h)
    living(h)
    kitchen(h)
    hall(h)
    office(h)
    garden(h)
    h.view("Living room", (515, 420, 150), (90, 110, 80))
    h.view("Kitchen", (330, 425, 150), (840, 110, 90))
    h.upstairs("Upper floor", UPPER)
    upper_floor(h)
    bedroom(h)
    child(h)
    landing_and_bath(h)
    h.view("Bedroom", (360, 425, 150), (90, 90, 65))
    return h


def ground_floor(h):
    h.room("Living room", (0, 0), (560, 460), floor="oak", walls=0xF0ECE3)
    h.room("Kitchen", (560, 0), (900, 460), floor="sand tiles", walls=0xF0ECE3)
    h.room("Hall", (0, 460), (420, 760), floor="sand tiles", walls=0xF2EEE4)
    h.room("Cloakroom", (420, 460), (560, 760), floor="sand tiles", walls="white tiles")
    h.room("Office", (560, 460), (900, 760), floor="oak", walls=0xDDE2DE)
    h.flows((560, 120), (560, 460))
    h.build()
    h.window("scopia:window_4x1", 200, 0, "Living room", elevation=3)
    h.window("scopia:window_2x1_with_sliders", 450, 0, "Living room", elevation=3)
    h.window("scopia:window_3x1", 730, 0, "Kitchen", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 0, 330, "Living room", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 900, 610, "Office", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 490, 760, "Cloakroom", width=60, height=70, elevation=140)
    h.door("kator:exterior-door-07", 330, 760, "Hall")
    h.door("scopia:double_door", 330, 460, "Living room")
    h.door("scopia:door", 420, 690, "Cloakroom")
    h.door("scopia:door", 620, 460, "Office")
    put.curtains(h, 200, 15, "S", 250)


def living(h):
    h.put("own:rug lattice", 220, 250, "S", width=280, depth=200)
    h.put("cc0:winchesterSofa", 220, 395, "N")
    h.put("cc0:winchesterArmchair", 75, 220, 300)
    table = h.put("scopia:table_wood_and_iron", 220, 265, "S", elevation=1.2)
    h.on(table, "cc0:orchids", -30, 0)
    h.on(table, "ccby:book", 25, 8, facing=20)
    h.lamp(h.put("scopia:living_lamp", 60, 410, 240), "Sofa lamp", 800)
    h.stand("kator:full-bookcase", 553, 65, "W")
    h.put("ccby:yuccaPlant", 60, 60, scale=0.9)
    h.put("own:picture hills", 150, 452.6, "N", elevation=125, width=70, height=90)
    h.ceiling("cc0:lamp2", 220, 240, "Living ceiling", 1500)


def kitchen(h):
    units = put.row(h, 893, 20, "W", [("cc0:largeFridge", {"depth": 66}), ("ccby:kitchenDrawersCabinet", {}), ("ccby:kitchenSink", {}),
                                      ("ccby:kitchenLowerCabinet", {"width": 105}), ("ccby:kitchenDrawersCabinet", {})])
    hob = h.on(units[3], "scopia:induction-cooker-4-zones", 0, 2)
    h.on(hob, "ccby:boiler", -12, -8)
    h.on(units[4], "cc0:kitchenaid", 0, -8, facing=300)
    h.on(units[1], "ccby:utensilsPot", 5, -15)
    put.row(h, 893, 157, "W", [("ccby:kitchenUpperCabinet", {"width": 98}), ("ccby:hood", {"width": 105, "elevation": 165})])
    h.lamp(h.stand("kator:fluorescent-strip", 885, 205, "W", elevation=136.5), "Worktop light", 900, 3000)
    table = put.dining(h, "ccby:table", 690, 260, "E", "ccby:ella_chair_f", 2, ends=0)
    h.on(table, "scopia:bowlWithSalad", 0, 0)
    for right, front, facing in ((-38, 22, "W"), (38, 22, "W"), (-38, -22, "E"), (38, -22, "E")):
        put.place_setting(h, table, right, front, facing)
    h.ceiling("kator:hanging-restaurant-light", 690, 260, "Dining pendant", 1055, height=95)


def hall(h):
    h.put("cc0:spiralStaircase", 95, 560, "S", height=UPPER * 356.16 / 264.15, scale=0.98)
    h.stand("scopia:wall-hanger", 230, 745, "N", elevation=165)
    h.put("scopia:doormat", 330, 700, width=80, depth=50)
    h.ceiling("scopia:ceiling-lamp", 290, 610, "Hall ceiling", 1200)
    h.stand("scopia:small_lavatory", 490, 467, "S", elevation=55)
    h.stand("cc0:toiletsUnit", 525, 745, "N")
    h.ceiling("scopia:ceiling-lamp", 490, 600, "Cloakroom ceiling", 600, 3000)


def office(h):
    desk = h.stand("cc0:lbDesk", 795, 745, "N")
    h.put("kator:office-chair", 795, 640, 20, colour=0x40484E)
    h.on(desk, "ccby:laptop", 0, 5)
    h.lamp(h.on(desk, "scopia:desk_lamp1", -55, -12, facing=40), "Office desk lamp", 600, 3000)
    h.stand("kator:full-bookcase", 567, 650, "E")
    h.put("scopia:maceta", 860, 500, scale=0.9)


def upper_floor(h):
    h.room("Bedroom", (0, 0), (400, 460), floor="oak", walls=0xDFE3E0)
    h.room("Child's room", (400, 0), (900, 460), floor="pine", walls=0xEFE6D2)
    h.room("Landing", (0, 460), (520, 760), floor="oak", walls=0xF2EEE4)
    h.room("Bathroom", (520, 460), (900, 760), floor="slate tiles", walls="white tiles")
    h.build()
    h.window("scopia:window_3x1", 200, 0, "Bedroom", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 560, 0, "Child's room", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 760, 0, "Child's room", width=150)
    h.window("scopia:window_2x1_medium_with_large_pane", 900, 610, "Bathroom", width=100, height=110, elevation=100)
    h.window("scopia:window_2x1_medium_with_large_pane", 300, 760, "Landing")
    h.door("scopia:door", 330, 460, "Bedroom", mirrored=True)
    h.door("scopia:door", 460, 460, "Child's room")
    h.door("scopia:door", 520, 560, "Bathroom")
    put.curtains(h, 200, 15, "S", 188, colour=0x9DA8A0)


def bedroom(h):
    left, right = put.bed(h, "cc0:bedWithTexture", 17, 220, "E")
    h.lamp(h.on(left, "scopia:little_lamp1"), "Bedside lamp left", 400)
    h.lamp(h.on(right, "scopia:little_lamp1"), "Bedside lamp right", 400)
    h.stand("ccby:wardrobe2", 150, 452, "N", width=200)
    h.put("own:rug wool", 310, 220, "E", width=180, depth=100)
    h.put("own:picture field", 16.4, 220, "E", elevation=140)
    h.put("scopia:ficus", 350, 55, scale=1.5)
    h.ceiling("scopia:ceiling-lamp", 200, 230, "Bedroom ceiling", 1200)


def child(h):
    h.stand("scopia:captains-bed", 840, 452, "N")
    desk = h.stand("scopia:kids_wooden_desk", 660, 17, "S")
    h.put("scopia:office_chair", 660, 100, "N")
    h.lamp(h.on(desk, "scopia:desk_lamp2", -30, -8, facing=20), "Child's desk lamp", 470, 3000)
    h.put("own:rug terracotta", 650, 270, width=200, depth=140)
    h.put("ccby:toyTrain", 620, 260, 30, elevation=1.2)
    h.put("cc0:teddyBear", 840, 400, 160, elevation=52)
    h.stand("cc0:shelves", 407, 130, "E")
    h.ceiling("ccby:hangingLight", 650, 230, "Child's ceiling", 1055, height=80)


def landing_and_bath(h):
    h.stand("cc0:bookcase", 400, 745, "N", depth=30)
    h.ceiling("scopia:ceiling-lamp", 330, 610, "Landing ceiling", 1000)
    h.stand("scopia:corner_bathtub", 805, 745, "N")
    h.stand("scopia:double_vanity", 720, 467, "S", height=200)
    h.stand("ccby:toilets_unit_jay_hardy", 570, 745, "N")
    h.put("kator:bathmat", 740, 600)
    h.ceiling("scopia:ceiling-lamp", 710, 600, "Bathroom ceiling", 1400, 3000)


def garden(h):
    for x in (-250, 700, 1150):
        h.put("scopia:hedgeTextured", x, -420)
        h.put("scopia:hedgeTextured", x + 155, -420)
    h.put("scopia:bush", -150, -250)
    h.put("scopia:rattanTable", 300, -200)
    h.put("scopia:rattanArmchair", 210, -200, "E")
    h.put("scopia:rattanArmchair", 390, -200, "W")
    h.put("scopia:poplar", 1250, -150)
