"""The walk file beside a home: six seconds at eye height through a room or two, in which furniture is moved. Places are those of the plan."""
import json

EYE = 160.0
SECONDS, RATE = 6, 10
FOV = 55

# Per home: the level walked on, the camera's way as (eye, looked at with its height) at even times, and what moves: which of the pieces with a
# key, how it has moved at the end (to the right and down on the plan, or "back" from where its front looks), and how it has turned.
WALKS = {
    "room": (0, [((110, 320), (430, 160, 80)), ((170, 200), (400, 230, 70)), ((230, 100), (350, 330, 60))],
             [("kator:mid-century-chair", 0, (-45, -30), 70)]),
    "studio": (0, [((395, 480), (110, 80, 80)), ((345, 350), (330, 120, 80)), ((305, 250), (470, 110, 70))],
               [("cc0:chairWithCushion", 1, "back", 0)]),
    "two_room_flat": (0, [((455, 385), (110, 110, 85)), ((385, 260), (170, 220, 70)), ((335, 100), (200, 330, 60))],
                      [("scopia:armchair2", 0, (5, -50), -50)]),
    "family_flat": (0, [((500, 420), (120, 90, 80)), ((470, 340), (330, 140, 75)), ((520, 410), (690, 250, 80)), ((800, 415), (690, 250, 80))],
                    [("kator:mid-century-chair", 0, (40, 45), -80), ("cc0:osakaChair", 2, "back", 0)]),
    "house": (0, [((500, 410), (90, 110, 80)), ((465, 310), (100, 210, 75)), ((480, 150), (690, 260, 75))],
              [("cc0:winchesterArmchair", 0, (35, -60), 60)]),
    "large_house": (0, [((655, 560), (120, 130, 85)), ((600, 420), (400, 180, 80)), ((640, 300), (900, 300, 80)), ((755, 300), (980, 330, 85))],
                    [("kator:mid-century-chair", 1, (40, 60), -75), ("cc0:antiqueChair", 2, "back", 0)]),
}


def _place(home, level, x, y, height):
    return [round(x / 100, 3), round((home.levels[level].elevation + height) / 100, 3), round(y / 100, 3)]


def _object(home, key, index, by, turn):
    piece = [p for p in home.placed if p.piece.key == key][index]
    named = [p for p in home.placed if p.name == piece.name]
    if by == "back":
        x, y = piece.local(0, -45)
        by = (x - piece.x, y - piece.y)
    out = {"name": piece.name}
    if len(named) > 1:
        out["number"] = 1 + next(k for k, p in enumerate(named) if p is piece)
    move = [round(by[0] / 100, 3), 0, round(by[1] / 100, 3)]
    # At rest, moved, and half of the way back.
    out["keys"] = [{"time": 0}, {"time": 3.5, "move": move, "turn": turn}, {"time": SECONDS, "move": [m / 2 for m in move], "turn": turn / 2}]
    return out


def walk(home):
    level, way, moves = WALKS[home.name]
    camera = [{"time": round(SECONDS * k / (len(way) - 1), 3), "position": _place(home, level, *eye, EYE), "target": _place(home, level, *towards),
               "verticalFov": FOV} for k, (eye, towards) in enumerate(way)]
    return {"version": 1, "comment": f"{home.title}: a walk in which furniture is moved.", "seconds": SECONDS, "framesPerSecond": RATE, "camera": camera,
            "objects": [_object(home, *m) for m in moves]}


def write(home, folder):
    (folder / f"{home.name}_walk.json").write_text(json.dumps(walk(home), indent=2) + "\n")
