"""Debian packages of an installed tree."""
import gzip
import hashlib
import os
import shutil
import subprocess
import tempfile
import textwrap
from dataclasses import dataclass
from pathlib import Path

from common import OUT, PACKAGING, ROOT, end, output, programs_below, run, triplet

LIBRARY = "libroomlight1"


@dataclass
class DebianPackage:
    """One of the packages that the installed tree is divided into. The first whose patterns fit a file has it."""
    name: str
    section: str
    files: tuple  # patterns below /
    summary: str
    about: tuple  # paragraphs
    own: tuple = ()  # packages of this tree that it needs, of the same version
    depends: tuple = ()  # beside the shared libraries that its programs load
    recommends: tuple = ()
    suggests: tuple = ()


ABOUT = ("roomlight opens a room, a home or a single object (glTF, OBJ, FBX, COLLADA, Sweet Home 3D and more) and computes "
         "how light falls in it. It makes photoreal pictures, a walk in the browser in which lamps are dimmed and moved, "
         "illuminance in lux with reports, and lighting proposals.")
PACKAGES = (
    DebianPackage("libroomlight-dev", "libdevel",
                  ("usr/include/**/*", "usr/lib/*/libroomlight.so", "usr/lib/*/libroomlight.a", "usr/lib/*/cmake/**/*",
                   "usr/lib/*/pkgconfig/*"),
                  "how light really falls in a home, for C++ programs",
                  (ABOUT, "This package has the headers of the library, for C++20, and what CMake and pkg-config need."),
                  own=(LIBRARY,)),
    DebianPackage("python3-roomlight", "python", ("usr/lib/python3/**/*",), "how light really falls in a home, for Python",
                  (ABOUT, "This package is the Python module, with pictures and meshes as arrays of NumPy."),
                  own=(LIBRARY, "roomlight"), depends=("python3 (>= 3.11), python3 (<< 3.12)", "python3-numpy")),
    DebianPackage(LIBRARY, "libs", ("usr/lib/*/libroomlight.so.*", "usr/lib/*/glibc-hwcaps/**/*"),
                  "how light really falls in a home, as a library",
                  (ABOUT, "This package is the library, built for processors of level {levels}; the system takes the best."),
                  depends=("tzdata",), recommends=("roomlight",)),
    DebianPackage("roomlight", "graphics", ("**/*",), "how light really falls in a home", (ABOUT,),
                  own=(LIBRARY,), depends=("tzdata",), suggests=("ffmpeg", "xdg-utils", "sweethome3d", "blender")))


def compress(file):
    with open(file, "rb") as source, open(f"{file}.gz", "wb") as target:
        with gzip.GzipFile("", "wb", 9, target, mtime=0) as packed:
            shutil.copyfileobj(source, packed)
    file.unlink()


def divide(stage, roots):
    """Moves every file of the stage to the first package whose patterns fit."""
    taken = set()
    for package, root in roots:
        for pattern in package.files:
            for file in sorted(stage.glob(pattern)):
                if (file.is_dir() and not file.is_symlink()) or file in taken:
                    continue
                taken.add(file)
                target = root / file.relative_to(stage)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(file, target, follow_symlinks=False)


def debian_documents(package, root, release):
    documents = root / "usr/share/doc" / package.name
    documents.mkdir(parents=True, exist_ok=True)
    (documents / "LICENSE").unlink(missing_ok=True)  # copyright says where its text is
    shutil.copyfile(PACKAGING / "debian/copyright", documents / "copyright")
    shutil.copyfile(ROOT / "CHANGELOG.md", documents / "changelog")
    (documents / "changelog.Debian").write_text(
        f"{package.name} ({release.debian}) unstable; urgency=medium\n\n  * Version {release.version}; changelog.gz says "
        f"what is new.\n\n -- {release.maintainer}  {release.date('%a, %d %b %Y %H:%M:%S +0000')}\n")
    overrides = root / "usr/share/lintian/overrides"
    overrides.mkdir(parents=True, exist_ok=True)
    (overrides / package.name).write_text(
        f"# not uploaded to Debian, where a first version closes a bug\n{package.name}: initial-upload-closes-no-bugs *\n")
    for file in (documents / "changelog", documents / "changelog.Debian", *(root / "usr/share/man").rglob("*.1")):
        compress(file)


def libraries_depended_on(root, stage):
    """As dpkg-shlibdeps finds them in the programs below the root; the library of this tree is said by `own`."""
    programs = programs_below(root)
    if not programs:
        return []
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "debian").mkdir()
        (Path(folder) / "debian/control").write_text("Source: roomlight\n\nPackage: roomlight\nArchitecture: any\n")
        (Path(folder) / "debian/shlibs.local").write_text(f"libroomlight 1 {LIBRARY}\n")
        said = output("dpkg-shlibdeps", "-O", f"-x{LIBRARY}", f"-l{stage}/usr/lib/{triplet()}", *[f"-e{p}" for p in programs],
                      cwd=folder, stderr=subprocess.DEVNULL)
    found = said.removeprefix("shlibs:Depends=")
    return found.split(", ") if found else []


def control(package, root, stage, release):
    about = "\n.\n".join(textwrap.fill(paragraph.format(levels=" and ".join(release.levels)), 76)
                          for paragraph in package.about)
    size = sum(f.lstat().st_size for f in root.rglob("*") if f.is_file()) // 1024 + 1
    fields = {"Package": package.name, "Version": release.debian, "Section": package.section, "Priority": "optional",
              "Architecture": output("dpkg", "--print-architecture"), "Maintainer": release.maintainer,
              "Installed-Size": size, "Depends": ", ".join([*(f"{own} (= {release.debian})" for own in package.own),
                                   *libraries_depended_on(root, stage), *package.depends]),
              "Recommends": ", ".join(package.recommends), "Suggests": ", ".join(package.suggests), "Description": package.summary}
    return "".join(f"{key}: {value}\n" for key, value in fields.items() if value) + "".join(
        f" {line}\n" for line in about.splitlines())


def byte_code(package, root):
    """Python's byte code is made where the package is installed, and goes with it."""
    for script, command in (("postinst", f"py3compile -p {package.name}"), ("prerm", f"py3clean -p {package.name}")):
        file = root / "DEBIAN" / script
        program = command.split()[0]
        file.write_text(f"#!/bin/sh\nset -e\nif command -v {program} >/dev/null; then\n  {command}\nfi\n")
        file.chmod(0o755)


def debian_package(package, root, stage, release):
    debian_documents(package, root, release)
    files = sorted(f for f in root.rglob("*") if f.is_file() and not f.is_symlink())
    sums = "".join(f"{hashlib.md5(f.read_bytes()).hexdigest()}  {f.relative_to(root)}\n" for f in files)
    text = control(package, root, stage, release)
    (root / "DEBIAN").mkdir()
    if package.name == LIBRARY:
        (root / "DEBIAN/shlibs").write_text(f"libroomlight 1 {LIBRARY} (>= {release.debian})\n")
        (root / "DEBIAN/triggers").write_text("activate-noawait ldconfig\n")
    if package.section == "python":
        byte_code(package, root)
    (root / "DEBIAN/control").write_text(text)
    (root / "DEBIAN/md5sums").write_text(sums)
    file = OUT / f"{package.name}_{release.debian}_{output('dpkg', '--print-architecture')}.deb"
    run("dpkg-deb", "--root-owner-group", "-Zxz", "--build", root, file, stdout=subprocess.DEVNULL,
        env={**os.environ, "SOURCE_DATE_EPOCH": str(release.epoch)})
    if subprocess.run(["lintian", "--fail-on", "error,warning", "--allow-root", file]).returncode:
        end(f"lintian does not pass {file.name}")
    return file


def debian_packages(stage, release):
    """Of what is installed below stage/usr."""
    for program in programs_below(stage):
        run("patchelf", "--remove-rpath", program)
    with tempfile.TemporaryDirectory(dir=OUT) as folder:
        roots = [(p, Path(folder) / p.name) for p in PACKAGES]
        for _, root in roots:
            root.mkdir(mode=0o755)
        divide(stage, roots)
        return [debian_package(package, root, stage, release) for package, root in roots
                if any(f.is_file() for f in root.rglob("*"))]
