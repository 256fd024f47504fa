"""Things that stand together in more than one home."""
import math

from home import FACING


def _step(facing, right, front=0):
    a = math.radians(FACING.get(facing, facing))
    return right * math.cos(a) - front * math.sin(a), right * math.sin(a) + front * math.cos(a)


def curtains(h, x, y, facing, span, width=55, colour=None):
    """A pair beside a window `span` wide; (x, y) is the window's middle on the wall's face, and `facing` looks into the room."""
    for side in (-1, 1):
        dx, dy = _step(facing, side * (span / 2 + width * 0.3), 10)
        h.put("scopia:curtain", x + dx, y + dy, facing, width=width, depth=9, height=238, elevation=2, colour=colour)


def row(h, x, y, facing, units):
    """Units with their backs to a wall, side by side to the right of who stands before them, from (x, y) on; (key, more) each."""
    out, at = [], 0
    for key, more in units:
        width = more.get("width", h.pieces[key].width)
        dx, dy = _step(facing, at + width / 2)
        out.append(h.stand(key, x + dx, y + dy, facing, **more))
        at += width
    return out


def dining(h, key, x, y, facing, chair, along, ends=0, gap=12, **more):
    """A table with chairs: `along` on each long side, and at `ends` of its ends; drawn back by `gap`."""
    table = h.put(key, x, y, facing, **more)
    a = FACING.get(facing, facing)
    depth = h.pieces[chair].depth
    for side, turn in ((1, 180), (-1, 0)):
        for k in range(along):
            px, py = table.local((k - (along - 1) / 2) * table.width / along, side * (table.depth / 2 + gap + depth / 4))
            h.put(chair, px, py, a + turn + 7 * ((k + side) % 3 - 1))
    for k in range(ends):
        side = 1 - 2 * k
        px, py = table.local(side * (table.width / 2 + gap + depth / 4), 0)
        h.put(chair, px, py, a + (90 if side > 0 else 270))
    return table


def bed(h, key, x, y, facing, table="cc0:bedsideTable2", **more):
    """A double bed with its head at (x, y), a table on both sides; returns the two tables, left first as one lies in it."""
    placed = h.stand(key, x, y, facing, **more)
    tables = []
    for side in (1, -1):
        dx, dy = _step(facing, side * (placed.width / 2 + h.pieces[table].width / 2 + 6))
        tables.append(h.stand(table, x + dx, y + dy, facing))
    return tables


def place_setting(h, table, right, front, facing):
    h.on(table, "kator:plate-and-ustensils", right, front, facing=facing)
