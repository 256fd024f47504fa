"""The two lighting files beside a home: by day with its lamps off, and at night with its lamps on."""
import json


# Windows of the library Scopia call their panes so. Each is a thin box, so that light meets two surfaces of one pane: double glazing.
GLAZING = [{"material": "Glass", "panes": 1}]


def day(home):
    return {
        "comment": f"{home.title} by day, its lamps off.",
        "scene": {"lamps": "off", "suns": "off", "sky": "off", "emission": "off"},
        "daylight": {"sky": "clear", "latitude": home.latitude, "longitude": home.longitude, "time": home.time_text, "north": home.north,
                     "temperature": "9000 K", "sunTemperature": "5400 K"},
        "glazing": GLAZING,
    }


def night(home):
    return {
        "comment": f"{home.title} after sunset: its lamps, as many lumen as the home says, and a last glow of the sky.",
        "scene": {"suns": "off", "sky": "off"},
        "daylight": {"sky": "clear", "direction": [0.6, -0.14, -0.8], "sunIlluminance": "0 lx", "temperature": "12000 K"},
        "glazing": GLAZING,
    }


def write(home, folder):
    for name, light in (("day", day(home)), ("night", night(home))):
        (folder / f"{home.name}_{name}.json").write_text(json.dumps(light, indent=2) + "\n")
