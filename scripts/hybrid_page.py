"""The page that scripts/measure_hybrid writes."""
import os
import textwrap
from statistics import median


def percent(x):
    return f"{x:+.1f} %"


def worst(rows, way, key):
    row = max(rows, key=lambda r: abs(r[way][key]))
    return abs(row[way][key]), row["name"].replace("_", " ")


def verdict(met):
    return "met" if met else "missed"


def asked(rows, records, benches):
    """Rows of what was asked: text, measured, met."""
    for way, limit in (("good", 0.0005), ("draft", 0.0015)):
        for key, name in (("mseBeyondNoise", "without the references' noise"), ("mse", "as it is")):
            count = sum(r[way][key] <= limit for r in rows)
            yield f"{way}: mse at most {limit}, {name}", f"{count} of {len(rows)}; largest {worst(rows, way, key)[0]:.5f}, {worst(rows, way, key)[1]}", count == len(rows)
    bright = sum(abs(r["good"]["meanLuminanceErrorPercent"]) <= 2 for r in rows)
    yield "good: mean luminance within 2 %", f"{bright} of {len(rows)}; largest {worst(rows, 'good', 'meanLuminanceErrorPercent')[0]:.1f} %, {worst(rows, 'good', 'meanLuminanceErrorPercent')[1]}", bright == len(rows)
    for way, key, limit in (("good", "blotchesPercent", 1), ("good", "grainPercent", 1), ("draft", "blotchesPercent", 2)):
        values = [r[way][key] for r in rows if r[way][key] is not None]
        yield f"{way}: {key.removesuffix('Percent')} at most {limit} %", f"{sum(v <= limit for v in values)} of {len(values)}; median {median(values):.1f} %, largest {max(values):.1f} %", max(values) <= limit
    for filtered, limit in ((False, 1 / 100), (True, 1 / 10)):
        ratio = median(r["good"]["seconds"] / r["good"]["path"][filtered][0] for r in rows)
        yield f"good: time at most 1/{1 / limit:.0f} of path's {'with' if filtered else 'without'} filter for the same mse, median", f"1/{1 / ratio:.0f}" if ratio < 0.5 else f"{ratio:.1f} times", ratio <= limit
    for way, limit in (("good", 2), ("draft", 0.4)):
        seconds = [r["speed"][way]["seconds"] for r in rows]
        yield f"{way}: {limit} s after loading", f"{sum(s <= limit for s in seconds)} of {len(rows)}; median {median(seconds):.2f}, longest {max(seconds):.2f}", max(seconds) <= limit
    memory = [r["speed"]["good"]["MiB"] / r["pathMiB"] for r in rows]
    yield "good: peak memory at most 1.5 of path's", f"largest {max(memory):.2f}", max(memory) <= 1.5
    if "illuminate" in benches:
        seconds = [b["real_time"] / 1e3 for b in benches["illuminate"]]
        yield "relight after one lamp changed: 0.15 s", f"median {median(seconds):.2f}, longest {max(seconds):.2f}", max(seconds) <= 0.15
    if "gather" in benches:
        rates = [b["percentOfBare"] for b in benches["gather"]]
        yield "gather: at least half the rays a second of bare Embree for the same rays", f"{min(rates):.0f} to {max(rates):.0f} %", min(rates) >= 50
    leaks = [m for g, _, t, m in records if "Sealed" in g and t == "hybrid"]
    if leaks:
        yield "leaks: dark room at most 0.1 % of the bright one", f"largest {100 * max(leaks):.4f} %", max(leaks) <= 0.001
    contact = [m for g, _, _, m in records if "cup, mse" in g]
    if len(contact) == 2:
        yield "contact: error at most twice the whole picture's", f"{contact[1] / contact[0]:.2f}", contact[1] <= 2 * contact[0]


def unevenness(rows):
    yield "| scene, rig |" + "".join(f" {way}: blotches | grain |" for way in ("draft", "good", "best"))
    yield "|---" * 7 + "|"
    for r in rows:
        cells = ["–" if r[way][key] is None else f"{r[way][key]:.1f} %" for way in ("draft", "good", "best") for key in ("blotchesPercent", "grainPercent")]
        yield f"| {r['name'].replace('_', ' ')} | " + " | ".join(cells) + " |"


def errors(rows):
    yield "| scene, rig | draft: mse | beyond noise | mean | good: mse | beyond noise | mean | best: mse | beyond noise | estimated | s | cone: mse | beyond noise | mean | s |"
    yield "|---" * 15 + "|"
    for r in rows:
        cells = [r["name"].replace("_", " ")]
        for way in ("draft", "good"):
            cells += [f"{r[way]['mse']:.5f}", f"{r[way]['mseBeyondNoise']:.5f}", percent(r[way]["meanLuminanceErrorPercent"])]
        best, cone = r["best"], r["cone"]
        cells += [f"{best['mse']:.5f}", f"{best['mseBeyondNoise']:.5f}", f"{best['numbers']['estimatedMse']:.5f}" if "estimatedMse" in best["numbers"] else "–", f"{best['seconds']:.0f}"]
        cells += [f"{cone['mse']:.5f}", f"{cone['mseBeyondNoise']:.5f}", percent(cone["meanLuminanceErrorPercent"]), f"{cone['seconds']:.1f}"]
        yield "| " + " | ".join(cells) + " |"


def ratios(rows):
    yield "| scene, rig | draft s | path s | ratio | filtered s | ratio | good s | path s | ratio | filtered s | ratio |"
    yield "|---" * 11 + "|"
    for r in rows:
        cells = [r["name"].replace("_", " ")]
        for way in ("draft", "good"):
            cells.append(f"{r[way]['seconds']:.2f}")
            for filtered in (False, True):
                seconds, beyond = r[way]["path"][filtered]
                cells += [f"{'~' if beyond else ''}{seconds:.1f}", f"1/{seconds / r[way]['seconds']:.1f}"]
        yield "| " + " | ".join(cells) + " |"
    cells = ["median"]
    for way in ("draft", "good"):
        cells.append(f"{median(r[way]['seconds'] for r in rows):.2f}")
        for filtered in (False, True):
            cells += ["", f"1/{median(r[way]['path'][filtered][0] / r[way]['seconds'] for r in rows):.1f}"]
    yield "| " + " | ".join(cells) + " |"


def speeds(rows):
    stages = ("bvh", "lights", "voxelise", "illuminate", "gather")
    yield "| scene, rig | quality | " + " | ".join(stages) + " | in all | cores busy: illuminate | gather | in all | MiB | of path's |"
    yield "|---" * (len(stages) + 8) + "|"
    for r in rows:
        for way, s in r["speed"].items():
            times = " | ".join(f"{s['stages'].get(n, 0):.2f}" for n in stages)
            busy = " | ".join(f"{sum(s['cpu'][n] for n in names) / max(1e-9, sum(s['stages'][n] for n in names)):.2f}" for names in (["illuminate"], ["gather"], list(s["stages"])))
            yield f"| {r['name'].replace('_', ' ')} | {way} | {times} | {s['seconds']:.2f} | {busy} | {s['MiB']:.0f} | {s['MiB'] / r['pathMiB']:.2f} |"


def tests(records):
    leaks = {}
    for group, place, technique, measured in records:
        if "Sealed" in group:
            leaks.setdefault(place, {})[technique] = measured
    yield "| wall, voxels | hybrid | cone |"
    yield "|---|---|---|"
    for place, by in leaks.items():
        yield f"| {place} | {100 * by['hybrid']:.4f} % | {100 * by['cone']:.4f} % |"
    yield from ("", "A table on legs of 2 cm with a cup on it, mse beyond noise:", "", "| | hybrid |", "|---|---|")
    for group, place, _, measured in records:
        if "cup, mse" in group:
            yield f"| {place} | {measured:.6f} |"


def page(rows, records, benches, pictures, args):
    homes = any(r["name"].startswith("home_") for r in rows)
    lines = [f"# Technique hybrid in {'the sample homes' if homes else 'the test rooms'}", "",
             *textwrap.wrap(f"Error, time and memory of `hybrid` at each quality, beside `cone` and `path`, on {os.cpu_count()} cores. Made by `scripts/measure_hybrid`. "
                            f"Errors and the seconds beside them are at {args.size}, times and memory of the stages at {args.time_size}."
                            + ("" if homes else " The sample homes have their own page: [homes](homes.md)."), 120), "",
             "- `mse` is against the mean of two references by `path`; `beyond noise` is the mse without the references' noise.",
             "- `mean` is the error of the mean luminance.",
             f"- `best` stops at an estimated mse of 0.0002 or after {args.best_seconds:g} s. `estimated` is its own estimate; – means that no",
             "  time was left for paths.", "",
             "## Asked", "", "| asked | measured | |", "|---|---|---|"]
    lines += [f"| {text} | {measured} | {verdict(met)} |" for text, measured, met in asked(rows, records, benches)]
    lines += ["", "## Errors", "", *errors(rows)]
    lines += ["", "[Blotches and grain](../reference/conventions.md#measures-of-error), without the noise of the references:", "", *unevenness(rows)]
    counts = ", ".join(map(str, args.samples))
    lines += ["", "## Time for the same error", "",
              *textwrap.wrap(f"Seconds after loading that `path` needs for the mse beyond noise of `draft` and of `good`. They come from its runs with {counts} "
                             "samples a pixel: without its filter from error = constant / samples, with it by interpolation between the runs. ~ marks "
                             "an extrapolation beyond the longest run.", 120), "", *ratios(rows)]
    lines += ["", "## Times and memory", "", f"Seconds after loading; runs: {args.runs}, of which the quickest counts.", f"Cores busy: processor time over wall-clock time, of {os.cpu_count()} cores.", "",
              "Processor time of every thread while one picture is made (`scripts/trace_cores`):", "", "![processor time of every thread over time](../pictures/cores.svg)", "", *speeds(rows)]
    if records:
        lines += ["", "## Leaks and contact", "", "Mean luminance of a sealed room beside a bright one, as a share of the bright room's (tests/physics/hybrid_test.cpp):", "", *tests(records)]
    if pictures:
        lines += ["", "## Equal time", "", "From left to right: `hybrid` good, `path` and filtered `path` in the same time, the reference."]
        for name in pictures:
            seconds = next(r["good"]["seconds"] for r in rows if r["name"] == name)
            lines += ["", f"{name.replace('_', ' ')}, {seconds:.1f} s:", "", f"![{name.replace('_', ' ')}](../pictures/equal_time_{name}.jpg)"]
    return "\n".join(lines) + "\n"
