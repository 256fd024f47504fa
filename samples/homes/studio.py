"""A studio: one room to live, cook and sleep in, and a bathroom; 30 m2, windows to the west."""
from home import Home


def draw(pieces):
    h = Home("studio", "A studio", pieces, north=265, day=(2026, 4, 18, 16, 30))
    h.room("Studio", (0, 0), (640, 0), (640, 320), (420, 320), (420, 520), (0, 520), floor="pine", walls=0xF0EDE6)
    h.room("Bathroom", (420, 320), (640, 520), floor="slate tiles", walls="metro tiles")
    h.build()
    h.window("scopia:window_4x1", 170, 0, "Studio", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 470, 0, "Studio")
    h.door("scopia:door", 420, 420, "Studio")
    h.door("kator:exterior-door-02", 330, 520, "Studio")
    sleeping(h)
    living(h)
    kitchen(h)
    bathroom(h)
    h.view("Living", (395, 480, 150), (110, 80, 80))
    h.view("Kitchen", (250, 215, 150), (620, 165, 95))
    h.view("Bed", (395, 90, 150), (60, 390, 60))
    return h


def sleeping(h):
    h.stand("cc0:bed1", 17, 330, "E")
    side = h.stand("cc0:bedsideTable2", 17, 225, "E")
    h.lamp(h.on(side, "ccby:lamp"), "Bedside lamp", 400)
    h.on(side, "ccby:clock", 14, 12)
    h.put("own:rug wool", 190, 330, "E", width=150, depth=110)
    h.stand("ccby:wardrobe2", 105, 503, "N")
    h.put("own:picture fern", 16.4, 330, "E", elevation=130)
    for x in (28, 312):
        h.put("scopia:curtain", x, 26, width=55, depth=9, height=235, elevation=3)


def living(h):
    h.put("own:rug indigo", 195, 130, width=190, depth=130)
    sofa = h.put("scopia:beige_sofa_2seats", 80, 130, "E")
    table = h.put("cc0:oakTable", 210, 130, scale=0.62, elevation=1.2)
    h.on(table, "ccby:tulips")
    h.on(table, "ccby:coffee_cup", 20, 18)
    h.lamp(h.put("scopia:little_lamp3", 45, 48, elevation=0, scale=1.9), "Reading lamp", 700)
    h.put("ccby:decorativePlant", 345, 55, scale=1.4)
    h.ceiling("scopia:saloon_lamp", 250, 200, "Ceiling lamp", 1400, facing="E")


def kitchen(h):
    x = 623
    h.stand("kator:fridge", x, 50, "W", height=175)
    lower = h.stand("ccby:kitchenDrawersCabinet", x, 105, "W")
    h.stand("ccby:kitchenSink", x, 176, "W")
    right = h.stand("ccby:kitchenLowerCabinet", x, 265, "W", width=80)
    hob = h.on(right, "scopia:induction-cooker-4-zones", 0, 2)
    h.on(hob, "ccby:largePan", 12, -8, scale=0.75)
    h.on(lower, "ccby:espressokettle", 5, 0)
    h.stand("ccby:kitchenUpperCabinet", x, 140, "W", elevation=145)
    h.stand("ccby:hood", x, 265, "W", width=80, elevation=165)
    h.lamp(h.stand("kator:fluorescent-strip", x - 8, 140, "W", elevation=136.5), "Worktop light", 900, 3000)
    table = h.put("scopia:white_kitchen_table", 455, 100, "E")
    h.on(table, "scopia:bowlWithSalad", 0, 0)
    h.on(table, "kator:plate-and-ustensils", -30, 14, facing="S")
    for y, facing in ((38, "S"), (170, "N")):
        h.put("cc0:chairWithCushion", 455, y, facing)


def bathroom(h):
    stall = h.stand("cc0:showerStall", 585, 503, "N")
    h.stand("cc0:toiletsUnit", 475, 503, "N")
    h.stand("cc0:modernVanity", 623, 365, "W", width=70, depth=52)
    h.put("kator:bathmat", 520, 420)
    h.stand("ccby:bathroomRadiator", 428, 490, "E", elevation=80)
    h.ceiling("scopia:ceiling-lamp", 530, 420, "Bathroom ceiling", 1000, 3000)
