"""Costs of tasks, for scripts/measure_batch: file operations, pictures an hour, disk and files, prediction of Slurm."""
import json
import os
import re
import resource
import shutil
import statistics
import time
from pathlib import Path

from batch_tools import call, checked, files, plan

# What a client asks the file server for. Reads and writes travel with open, close and fsync.
OPERATIONS = {"openat", "close", "newfstatat", "mkdir", "rename", "link", "unlink", "unlinkat", "rmdir", "fsync",
              "utimensat", "getdents64", "readlink", "faccessat2", "access"}
ROOT = Path(__file__).resolve().parent.parent
SIMULATE = ROOT / "scripts/simulate_batch"
COSTS = """
[[pictures]]
homes = "{home}"
lights = ["day", "evening"]
size = "480x270"
quality = "draft"
[[pictures]]
homes = "{home}"
lights = ["day", "evening"]
size = "960x540"
quality = "draft"
[[pictures]]
homes = "{home}"
lights = "day"
size = "960x540"
quality = "good"
[[pictures]]
homes = "{home}"
lights = "day"
size = "1280x720"
quality = "good"
[[references]]
homes = "{home}"
lights = "day"
seeds = 2
samples = 4
size = "960x540"
[[walks]]
homes = "{home}"
lights = "day"
walk = "{walk}"
frames = 6
framesPerTask = 3
size = "480x270"
quality = "draft"
"""
FRAMES = 3  # of a task
NAMES = ["draft, 480x270", "draft, 960x540", "good, 960x540", "good, 1280x720",
         "reference, 4 samples of a seed, 960x540", f"frame of a walk, draft, 480x270, {FRAMES} a task"]


def is_operation(line, folders):
    """Whether a line of strace asks the server for something: on a path below these folders, or a file open there."""
    said = re.match(r"\d+ +(\w+)\((.*)", line)
    if not said or said[1] not in OPERATIONS:
        return False
    words = said[2]
    path = re.search(r'"([^"]*)"', words)
    if path and path[1].startswith("/"):
        return path[1].startswith(folders)
    if path and not path[1] and said[1] == "newfstatat":
        return False  # of an open file: the client knows
    if path and path[1]:
        return not re.match(r"AT_FDCWD<([^>]*)>", words) or words.split("<", 1)[1].startswith(folders)
    return bool(re.match(r"\d+<([^>]*)>", words)) and words.split("<", 1)[1].startswith(folders)


def operations_of(args, folder, log, *words):
    """File operations of a run in the batch's folder and beside the home."""
    checked("strace", "-f", "-qq", "-y", "-e", "trace=%file,%desc", "-o", log, args.program, "batch", "run", folder,
            *words)
    folders = (str(folder.resolve()), str(args.home.resolve().parent))
    with open(log) as lines:
        return sum(is_operation(line, folders) for line in lines)


def foreign_claims(folder, count):
    """Claims of a machine that is not there, of the last tasks, as if they were being done."""
    owner = {"host": "far", "machine": "far", "process": 1, "started": 1, "job": "", "restarts": 0, "token": "far-1-1"}
    for line in (folder / "tasks.jsonl").read_text().splitlines()[-count:]:
        (folder / "claims" / json.loads(line)["id"]).write_text(json.dumps(owner))


def file_operations(args, out, toml):
    """Of a task, of a start, and of a start for each claim there is."""
    if call("strace", "-V").returncode:
        return None
    folder, log, tasks, claims = plan(args.program, toml, out / "operations"), out / "strace", 8, 16
    checked(args.program, "batch", "run", folder, "--index", 1, "--chunk", claims)
    start = operations_of(args, folder, log, "--index", claims)
    work = operations_of(args, folder, log, "--index", 0, "--chunk", tasks)
    foreign_claims(folder, claims)
    return {"task": (work - start) / tasks, "start": start,
            "claim": (operations_of(args, folder, log, "--index", claims) - start) / claims}


def start_seconds(args, folder):
    """Of a `batch run` whose task is done."""
    times = []
    for _ in range(5):
        before = time.monotonic()
        checked(args.program, "batch", "run", folder, "--index", 0)
        times.append(time.monotonic() - before)
    return statistics.median(times)


def job_seconds(environment, out, jobs=40):
    """Of a core that an empty job of Slurm takes."""
    script = out / "empty.sh"
    script.write_text(f"#!/bin/sh\n#SBATCH --array=0-{jobs - 1}\n#SBATCH --output=/dev/null\nexit 0\n")
    before = time.monotonic()
    checked("sbatch", script, env=environment)
    while checked("squeue", "-h", env=environment).strip():
        time.sleep(0.2)
    return (time.monotonic() - before) * os.cpu_count() / jobs


def simulated(batch, **options):
    words = [w for k, v in options.items() for w in (f"--{k.replace('_', '-')}", v)]
    return json.loads(checked(SIMULATE, batch, "--json", *words))


def blocks(paths):
    return sum(os.lstat(p).st_blocks * 512 for p in paths)


def storage(folder):
    """Bytes on the disk and number of files and folders of each task, without what merge adds."""
    tasks = json.loads((folder / "plan.json").read_text())["tasks"]
    paths = [p for kind in ("out", "done") for p in (folder / kind).glob("*/**/*")]
    lists = (folder / "tasks.jsonl").stat().st_size + (folder / "tasks.idx").stat().st_size
    return blocks(paths) / tasks, len(paths) / tasks, lists / tasks


def used():
    """Seconds of cores that programs which have ended took."""
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def output_bytes(folder, first, count):
    lines = (folder / "tasks.jsonl").read_text().splitlines()[first:first + count]
    names = [json.loads(line)["id"] for line in lines]
    return sum(p.stat().st_size for name in names for p in files(folder / "out" / name[:2] / name))


def cost_table(args, out):
    """Pictures of a furnished home, two tasks at once: core seconds, and what a million of them take."""
    toml, first = out / "costs.toml", 0
    walk = args.furnished.with_name(args.furnished.stem + "_walk.json")
    toml.write_text(COSTS.format(home=args.furnished, walk=walk))
    shutil.rmtree(out / "costs", ignore_errors=True)
    folder = plan(args.program, toml, out / "costs")
    rows = ["| picture | core seconds | an hour of a core | kB | a million: core hours | GB |",
            "|---|---|---|---|---|---|"]
    sections = json.loads((folder / "plan.json").read_text())["sections"]
    names = dict(zip(sorted(s["line"] for s in sections), NAMES))
    for section in sections:
        (out / "section.list").write_text("".join(f"{first + n:010}\n" for n in range(section["tasks"])))
        before = used()
        checked(args.program, "batch", "run", folder, "--all", "--jobs", min(2, section["tasks"]),
                "--list", out / "section.list")
        pictures = section["tasks"] * (FRAMES if section["kind"] == "walks" else 1)
        seconds = (used() - before) / pictures
        size = output_bytes(folder, first, section["tasks"]) / pictures
        first += section["tasks"]
        rows.append(f"| {names[section['line']]} | {seconds:.0f} | {3600 / seconds:.0f} | {size / 1e3:.0f} "
                    f"| {rounded(1e6 * seconds / 3600)} | {size / 1e3:.0f} |")
        print(rows[-1], flush=True)
    return rows


def rounded(number):
    """Two digits that count."""
    digits = max(0, len(str(int(number))) - 2)
    return f"{round(number, -digits):,.0f}"
