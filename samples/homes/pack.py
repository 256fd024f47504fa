"""Writes a home as .sh3d: a zip file of Home.xml, the models with their pictures and icons, and the surfaces; the same bytes every time."""
import zipfile

import surfaces
from home_xml import Writer

TIME = (2026, 1, 1, 0, 0, 0)


def _surfaces_of(home):
    looks = [home.ground, home.facade] + [v for level in home.levels for look in level.looks.values() for v in look.values()]
    return sorted({v for v in looks if isinstance(v, str)})


def write(home, path):
    entries, contents, number = {}, {}, 0
    for name in _surfaces_of(home):
        entries[name] = str(number)
        contents[str(number)] = surfaces.painted(name)
        number += 1
    for key, piece in home.used_pieces().items():
        entries[key] = (f"{number}/{piece.model}", str(number + 1))
        contents[str(number + 1)] = piece.icon()
        contents |= {f"{number}/{file}": data for file, data in piece.files().items()}
        number += 2
    contents["Home.xml"] = Writer(home, entries).text().encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, data in contents.items():
            info = zipfile.ZipInfo(name, TIME)
            info.compress_type, info.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            archive.writestr(info, data)
