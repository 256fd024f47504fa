"""Two builds of view_rates in turn, for scripts/measure_view: which delays of the newer one are longer."""
import json
from statistics import median

LIMIT = 1.05  # new over old
KINDS = (("walk", "walking"), ("thing", "moving a thing"), ("lamp", "moving a lamp"))
FIGURES = (("frame", lambda r: 1e3 / r["medianFps"]), ("answer", lambda r: r["latencyMs"]), ("first frame", lambda r: r.get("jump", {}).get("firstMs")))
HEAD = "| home | light | what | frames, old | new | figure | old | new | new/old | worse |\n|---|---|---|---|---|---|---|---|---|---|"


def in_turn(old, new, turns, run):
    """What `run` gives for the two programs, turn by turn; who begins alternates, as the machine may slow down or speed up."""
    results = ([], [])
    for turn in range(turns):
        for which in (0, 1) if turn % 2 == 0 else (1, 0):
            results[which].append(run((old, new)[which]))
    return results


def figures(runs, kind, value):
    found = (value(r[kind]) for r in runs if "medianFps" in r.get(kind, {}))
    return [f for f in found if f]  # no delay: no frame that answered


def names_of(runs, kind):
    return ", ".join(sorted({r[kind]["name"] for r in runs if "name" in r.get(kind, {})}))


def size_of(runs, kind):
    sizes = sorted((r[kind]["size"] for r in runs if "size" in r.get(kind, {})), key=lambda size: int(size.split("x")[0]))
    return sizes[len(sizes) // 2] if sizes else "none"


def cell(values):
    return f"{median(values):.1f} ({min(values):.1f} to {max(values):.1f})" if values else "none"


def rows(home, light, old, new):
    """Of a home and a light: lines of the table, from the results of each program's turns."""
    out = []
    for kind, label in KINDS:
        names = names_of(old + new, kind)
        sizes = f"{size_of(old, kind)} | {size_of(new, kind)}"
        for name, value in FIGURES:
            before, now = figures(old, kind, value), figures(new, kind, value)
            if not before and not now:
                continue
            ratio = median(now) / median(before) if before and now else None
            worse = "worse" if not now or ratio and ratio > LIMIT else ""
            what = f"{label} ({names})" if names else label
            out.append(f"| {home.replace('_', ' ')} | {light} | {what} | {sizes} | {name} | {cell(before)} | {cell(now)} | {f'{ratio:.2f}' if ratio else ''} | {worse} |")
    return out


def verdict(lines):
    worse = sum(line.endswith("| worse |") for line in lines)
    return f"{worse} of {len(lines)} figures are worse by more than {100 * (LIMIT - 1):.0f} %."


def page(made_by, turns, machine, lines):
    return f"""# `roomlight view`, old and new in turn

Milliseconds of two builds of `view_rates` on {machine}: medians of {turns} turns, lowest and highest in brackets.
Made by `{made_by}`.

- `frames`: the median size of the frames; smaller frames take less time.
- `frame`: median time from one frame to the next.
- `answer`: median time from an input to the sending of the first frame that shows it.
- `first frame`: the same after one edit of a home at rest.

{verdict(lines)}

{HEAD}
""" + "\n".join(lines) + "\n"


def check(run, folder):
    """`run(program)` starts a program. Stand-ins print what is known, and the table must say so."""
    turned = []

    def stand_in(name, rates):
        file = folder / name
        file.write_text(f"#!/bin/sh\necho '{json.dumps(rates)}'\n")
        file.chmod(0o755)
        return file

    def noted(program):
        turned.append(program.name)
        return run(program)
    walk = {"medianFps": 40, "latencyMs": 30, "size": "960x540"}
    moved = {"medianFps": 20, "latencyMs": 50, "size": "807x454", "name": "Bowl", "jump": {"frames": 2, "firstMs": 80}}
    old = stand_in("old", {"walk": walk, "thing": moved, "lamp": moved})
    new = stand_in("new", {"walk": walk | {"medianFps": 39}, "thing": moved | {"latencyMs": 55, "jump": {"frames": 0}}, "lamp": {"frames": 3}})
    lines = rows("two_room_flat", "night", *in_turn(old, new, 2, noted))
    bowl = "| two room flat | night | moving a {} (Bowl) | 807x454 | {} |"
    expected = ["| two room flat | night | walking | 960x540 | 960x540 | frame | 25.0 (25.0 to 25.0) | 25.6 (25.6 to 25.6) | 1.03 |  |",
                "| two room flat | night | walking | 960x540 | 960x540 | answer | 30.0 (30.0 to 30.0) | 30.0 (30.0 to 30.0) | 1.00 |  |",
                bowl.format("thing", "807x454") + " frame | 50.0 (50.0 to 50.0) | 50.0 (50.0 to 50.0) | 1.00 |  |",
                bowl.format("thing", "807x454") + " answer | 50.0 (50.0 to 50.0) | 55.0 (55.0 to 55.0) | 1.10 | worse |",
                bowl.format("thing", "807x454") + " first frame | 80.0 (80.0 to 80.0) | none |  | worse |"]
    expected += [bowl.format("lamp", "none") + f" {name} | {was:.1f} ({was:.1f} to {was:.1f}) | none |  | worse |" for name, was in (("frame", 50), ("answer", 50), ("first frame", 80))]
    if turned != ["old", "new", "new", "old"] or lines != expected or "5 of 8 figures" not in verdict(lines):
        raise SystemExit("\n".join(["measure_view: the comparison is off:", str(turned), *lines, verdict(lines)]))
