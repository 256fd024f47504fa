#!/usr/bin/env python3
"""Makes a wheel of the Python module and all that it needs.

    python3 python/make_wheel.py TREE MODULE FOLDER

TREE: an installed program with all libraries, as the tarball of a release unpacks: bin, lib with libroomlight.so.1 in
it or in a folder of it, libexec, share. MODULE: the folder `roomlight` with the compiled `_roomlight`, as a build has it in
build/release/python/roomlight. FOLDER: where the wheel goes.

The wheel holds TREE as roomlight/_prefix. It has the same bytes each time from the same files; SOURCE_DATE_EPOCH is the
time of all of them. Needs patchelf.
"""

import argparse
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path
from typing import Iterator, List, NoReturn, Tuple

ROOT = Path(__file__).resolve().parent.parent
# What the library and the commands look for below their prefix; not pages for people, or for a desktop.
TAKEN = ("bin/roomlight", "lib", "libexec/roomlight", "share/roomlight", "share/doc/roomlight/libraries",
         "share/doc/roomlight/copyright", "share/doc/roomlight/LICENSE", "share/doc/roomlight/NOTICE")
LEFT_OUT = re.compile(r"(^|/)(cmake|pkgconfig|python3|__pycache__)(/|$)|\.a$|libroomlight\.so$")
LIBRARY = re.compile(r"\.so(\.|$)")
# Of the system, as other wheels have it: two of them in one process would not agree.
OF_THE_SYSTEM = ("libstdc++.so.6", "libgcc_s.so.1")
OWN = "libroomlight.so.1"
TRIED = 36  # minor version of the glibc that wheels are tried on, Debian 12's
GLIBC = re.compile(r"GLIBC_2\.(\d+)")


def end(message: str) -> NoReturn:
    print(f"make_wheel: {message}", file=sys.stderr)
    sys.exit(1)


def version() -> str:
    """As Python writes versions: 1.0.0rc1."""
    lists = (ROOT / "CMakeLists.txt").read_text()
    number = re.search(r"project\(roomlight VERSION (\S+)", lists)
    rest = re.search(r'set\(ROOMLIGHT_VERSION "\$\{PROJECT_VERSION\}([^"]*)"', lists)
    assert number
    return number.group(1) + (rest.group(1).replace("-", "") if rest else "")


def tags(module: Path) -> Tuple[str, str]:
    """The interpreter and the machine of a compiled module: cp311 and x86_64."""
    found = re.search(r"\.cpython-(\d+)-(\w+)-linux", module.name)
    if not found:
        end(f"{module.name}: is not named as a module of CPython on Linux")
    return f"cp{found.group(1)}", found.group(2)


def is_program(file: Path) -> bool:
    with file.open("rb") as opened:
        return opened.read(4) == b"\x7fELF"


def least_glibc(files: List[Path]) -> int:
    """The least minor version of glibc that has all the symbols that the programs ask for, and that was tried."""
    versions = [TRIED]
    for file in files:
        said = subprocess.run(["objdump", "-T", file], check=True, capture_output=True, text=True).stdout
        versions += [int(v) for v in GLIBC.findall(said)]
    return max(versions)


def copy_tree(tree: Path, prefix: Path) -> None:
    for taken in TAKEN:
        top = tree / taken
        files = [top] if top.is_file() else sorted(f for f in top.rglob("*") if f.is_file())
        for file in files:
            name = file.relative_to(tree)
            if LEFT_OUT.search(name.as_posix()) or name.name in OF_THE_SYSTEM:
                continue
            (prefix / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, prefix / name)
            shutil.copymode(file, prefix / name)


def leave_one_name(lib: Path) -> None:
    """Wheels have no links: of a library that lies there by several names only the one that programs load stays."""
    for file in programs_below(lib):
        soname = subprocess.run(["patchelf", "--print-soname", file], check=True, capture_output=True, text=True).stdout
        if soname.strip() and soname.strip() != file.name and (file.parent / soname.strip()).exists():
            file.unlink()


def name_apart(programs: List[Path], lib: Path) -> None:
    """Gives libraries names of their own: of two that share a name, the loader takes the one that came first, which may
    be another wheel's."""
    names = {f.name: f.name.replace(".so", "-roomlight.so", 1) for f in lib.rglob("*.so*") if f.name != OWN}
    for file in programs:
        asked = subprocess.run(["patchelf", "--print-needed", file], check=True, capture_output=True, text=True).stdout
        for name in asked.split():  # one at a time: several changes in one call of patchelf 0.14 spoil each other
            if name in names:
                subprocess.run(["patchelf", "--replace-needed", name, names[name], file], check=True)
        if file.name in names and file.is_relative_to(lib):
            subprocess.run(["patchelf", "--set-soname", names[file.name], file], check=True)
            file.rename(file.with_name(names[file.name]))


def programs_below(folder: Path) -> List[Path]:
    return sorted(f for f in folder.rglob("*") if f.is_file() and is_program(f))


def lay_out(tree: Path, module: Path, stage: Path) -> List[Path]:
    package = stage / "roomlight"
    shutil.copytree(module, package, ignore=shutil.ignore_patterns("__pycache__"))
    copy_tree(tree, package / "_prefix")
    leave_one_name(package / "_prefix/lib")
    compiled = list(package.glob("_roomlight.*.so"))
    if len(compiled) != 1:
        end(f"{module}: holds {len(compiled)} compiled modules")
    libraries = sorted(package.glob(f"_prefix/lib/**/{OWN}"), key=lambda f: len(f.parts))
    if not libraries:
        end(f"{tree}: has no {OWN} below lib")
    place = libraries[0].parent.relative_to(package).as_posix()  # those for later processors lie deeper
    subprocess.run(["strip", "--strip-unneeded", *compiled], check=True)
    subprocess.run(["patchelf", "--set-rpath", f"$ORIGIN/{place}", *compiled], check=True)
    name_apart(programs_below(package), package / "_prefix/lib")
    return programs_below(package)


def metadata(tag: str) -> Iterator[Tuple[str, str]]:
    name = f"roomlight-{version()}.dist-info"
    about = (ROOT / "docs/use/python.md").read_text()
    about = re.sub(r"\[([^\]]*)\]\((?![a-z]+:)[^)]*\)", r"\1", about)  # links into the tree lead nowhere from there
    yield f"{name}/METADATA", (
        f"Metadata-Version: 2.1\nName: roomlight\nVersion: {version()}\nSummary: How light really falls in a home\n"
        "License: Apache-2.0\nClassifier: License :: OSI Approved :: Apache Software License\n"
        "Classifier: Operating System :: POSIX :: Linux\nClassifier: Programming Language :: Python :: 3\n"
        "Classifier: Topic :: Multimedia :: Graphics :: 3D Rendering\nClassifier: Typing :: Typed\n"
        "Requires-Python: >=3.9\nRequires-Dist: numpy>=1.21\nLicense-File: LICENSE\nLicense-File: NOTICE\n"
        "Description-Content-Type: text/markdown\n\n" + about)
    yield f"{name}/WHEEL", f"Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\nTag: {tag}\n"
    yield f"{name}/entry_points.txt", "[console_scripts]\nroomlight = roomlight._program:run\n"
    yield f"{name}/top_level.txt", "roomlight\n"
    for text in ("LICENSE", "NOTICE"):
        yield f"{name}/{text}", (ROOT / text).read_text()


def digest(data: bytes) -> str:
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def pack(wheel: Path, members: List[Tuple[str, bytes, int]]) -> None:
    record = f"roomlight-{version()}.dist-info/RECORD"
    lines = "".join(f"{name},{digest(data)},{len(data)}\n" for name, data, _ in members) + f"{record},,\n"
    epoch = max(int(os.environ.get("SOURCE_DATE_EPOCH", "315532800")), 315532800)  # 1980, where zip's time begins
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data, mode in [*members, (record, lines.encode(), 0o644)]:
            info = zipfile.ZipInfo(name, time.gmtime(epoch)[:6])
            info.external_attr = (0o100000 | mode) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)


def make(tree: Path, module: Path, folder: Path) -> Path:
    with tempfile.TemporaryDirectory() as name:
        stage = Path(name)
        programs = lay_out(tree, module, stage)
        python, machine = tags(next((stage / "roomlight").glob("_roomlight.*.so")))
        platform = f"manylinux_2_{least_glibc(programs)}_{machine}"
        members = [(f.relative_to(stage).as_posix(), f.read_bytes(),
                    0o755 if f.parent.name in ("bin", "roomlight") and f in programs and not LIBRARY.search(f.name) else 0o644)
                   for f in sorted(stage.rglob("*")) if f.is_file()]
        tag = f"{python}-{python}-{platform}"
        members += [(n, text.encode(), 0o644) for n, text in metadata(tag)]
        wheel = folder / f"roomlight-{version()}-{tag}.whl"
        folder.mkdir(parents=True, exist_ok=True)
        pack(wheel, members)
        return wheel


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("tree", "module", "folder"):
        parser.add_argument(name, type=Path)
    wish = parser.parse_args()
    if not shutil.which("patchelf"):
        end("needs patchelf: scripts/setup --packages")
    wheel = make(wish.tree, wish.module, wish.folder)
    print(f"make_wheel: {wheel}: {wheel.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
