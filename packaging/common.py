"""What the packaging scripts share."""
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "build/package"
PACKAGING = ROOT / "packaging"


def run(*command, **options):
    return subprocess.run([str(c) for c in command], check=True, text=True, **options)


def output(*command, **options):
    return run(*command, stdout=subprocess.PIPE, **options).stdout.strip()


def end(message):
    print(f"package: {message}", file=sys.stderr)
    sys.exit(1)


def triplet():
    """Of this machine, as folders of libraries are named: x86_64-linux-gnu."""
    return output("dpkg-architecture", "-qDEB_HOST_MULTIARCH")


def programs_below(root):
    """Programs and libraries."""
    return [f for f in sorted(root.rglob("*")) if f.is_file() and not f.is_symlink() and f.read_bytes()[:4] == b"\x7fELF"]
