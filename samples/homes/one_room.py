"""A room: where somebody reads, listens and watches, 19 m2, windows to the south-south-west."""
from home import Home


def draw(pieces):
    h = Home("room", "A room", pieces, north=200)
    h.room("Living room", (0, 0), (520, 420), floor="oak", walls=0xEFEBE2)
    h.build()
    h.window("scopia:window_3x1", 315, 0, "Living room", elevation=3)
    h.window("scopia:window_2x1_medium_with_large_pane", 110, 0, "Living room")
    h.door("scopia:door", 0, 345, "Living room", mirrored=True)
    for x in (175, 455):
        h.put("scopia:curtain", x, 26, width=70, depth=9, height=235, elevation=3)

    h.put("own:rug lattice", 385, 215, "E", width=250, depth=170)
    sofa = h.stand("cc0:couch", 500, 215, "W")
    table = h.put("scopia:saloon_table", 375, 215, "W", elevation=1.2)
    h.on(table, "scopia:bowlWithFruits", 30, 5)
    h.on(table, "ccby:book", -35, -5, facing=70)
    h.on(table, "scopia:cup", -10, 15)
    h.put("kator:mid-century-chair", 330, 345, 160, colour=0xB08A5A)
    h.lamp(h.put("scopia:living_lamp", 455, 70, 225), "Sofa lamp", 800)
    h.put("own:picture hills", 503.6, 170, "W", elevation=120)
    h.put("own:picture field", 503.6, 250, "W", elevation=120)

    stand = h.stand("ccby:tvStand", 17, 200, "E")
    h.on(stand, "cc0:led_tv", -8, 0, scale=1.35)
    h.lamp(h.on(stand, "ccby:lamp", 50, 0), "Television lamp", 470)
    for x in (150, 240):
        h.stand("kator:full-bookcase", x, 403, "N")
    h.put("ccby:yuccaPlant", 62, 62, scale=0.85)
    h.put("cc0:speaker3", 40, 300, 250)
    h.ceiling("ccby:hangingLight", 250, 205, "Ceiling lamp", 1055, height=80)

    h.view("Sofa corner", (60, 320, 150), (430, 160, 80))
    h.view("Window side", (440, 60, 150), (130, 330, 85))
    h.view("Reading corner", (120, 130, 145), (420, 330, 80))
    return h
