"""What scripts that measure batches share: calls, outputs of a batch, its status."""
import filecmp
import json
import os
import subprocess
from pathlib import Path


def call(*command, **more):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)


def checked(*command, **more):
    done = call(*command, **more)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def files(folder):
    """All files below; those that go meanwhile do no harm."""
    return sorted(Path(at) / name for at, _, names in os.walk(folder) for name in names)


def outputs(folder):
    """Files of tasks whose output is published, by their path."""
    out = folder / "out"
    return {str(p.relative_to(out)): p for p in files(out) if not p.relative_to(out).parts[1].endswith(".tmp")}


def equal(a, b):
    return not differences(a, b)


def differences(a, b):
    one, other = outputs(a), outputs(b)
    out = [f"only in one: {k}" for k in sorted(one.keys() ^ other.keys())]
    return out + [f"differs: {k}" for k in sorted(one.keys() & other.keys())
                  if not filecmp.cmp(one[k], other[k], shallow=False)]


def done_files(folder):
    return [p for p in files(folder / "done") if len(p.name) == 16]


def seconds_of_tasks(folder):
    return [json.loads(p.read_text())["seconds"] for p in done_files(folder)]


def status(program, folder):
    return json.loads(checked(program, "batch", "status", folder, "--json"))


def plan(program, toml, folder):
    checked(program, "batch", "plan", toml, "-o", folder)
    return folder
