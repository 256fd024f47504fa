"""A folder that runs on any Debian 12 or later: programs, and all libraries but those of the C library."""
import os
import re
import shutil
import subprocess
from pathlib import Path

from common import OUT, PACKAGING, ROOT, end, output, programs_below, run, triplet

# Libraries of the C library: of the system everywhere, and never taken along.
OF_THE_SYSTEM = re.compile(r"^(ld-linux|linux-vdso|libc|libm|libdl|librt|libpthread|libresolv|libutil|libmvec)[-.]")


def loaded(program):
    """Name and file of every shared library that a program loads, less those of the system."""
    for line in output("ldd", program).splitlines():
        found = re.match(r"\s*(\S+) => (/\S+)", line)
        if found and not OF_THE_SYSTEM.match(found.group(1)):
            yield found.group(1), Path(found.group(2)).resolve()


def package_of(file):
    """The Debian package of a library; its path may be one from before /lib became a link to /usr/lib."""
    for place in (file, Path(str(file).removeprefix("/usr"))):
        found = subprocess.run(["dpkg", "-S", place], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(":")[0]
    return end(f"{file} is of no Debian package: its licence is unknown")


def take_libraries(folder):
    """Libraries beside roomlight's own, found from programs and from one another, and their licences."""
    place = folder / "lib" / triplet()
    licences = folder / "share/doc/roomlight/libraries"
    licences.mkdir(parents=True)
    own = programs_below(folder)
    libraries = dict(pair for file in own for pair in loaded(file) if not pair[0].startswith("libroomlight"))
    for name, file in libraries.items():
        shutil.copyfile(file, place / name)
        (place / name).chmod(0o644)
        run("patchelf", "--set-rpath", "$ORIGIN", place / name)
        package = package_of(file)
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", licences / f"{package}.copyright")
    for name in ("GPL-2", "GPL-3", "LGPL-2.1", "LGPL-3", "Apache-2.0", "MPL-2.0"):
        shutil.copyfile(f"/usr/share/common-licenses/{name}", licences / name)
    shutil.copyfile(PACKAGING / "debian/copyright", folder / "share/doc/roomlight/copyright")
    for file in own:
        run("patchelf", "--set-rpath", f"$ORIGIN/{os.path.relpath(place, file.parent)}", file)


def wheel(folder, release):
    """Of the tarball's folder: the Python module with all that it needs."""
    module = folder / "lib/python3/dist-packages/roomlight"
    said = output("/usr/bin/python3", ROOT / "python/make_wheel.py", folder, module, OUT,
                  env={**os.environ, "SOURCE_DATE_EPOCH": str(release.epoch)})
    return OUT / Path(said.splitlines()[-1].split(": ")[1]).name


def tarball_and_wheel(stage, release):
    """Of what is installed below stage/NAME, where NAME is that of the tarball."""
    name = release.tarball
    for development in ("include", *(f"lib/{triplet()}/{what}" for what in ("cmake", "pkgconfig", "libroomlight.a", "libroomlight.so"))):
        file = stage / name / development
        shutil.rmtree(file) if file.is_dir() else file.unlink(missing_ok=True)
    take_libraries(stage / name)
    file = OUT / f"{name}.tar.gz"  # a bare system has no xz
    run("tar", "--sort=name", f"--mtime=@{release.epoch}", "--owner=0", "--group=0", "--numeric-owner",
        "-C", stage, "-c", "-I", "gzip -9n", "-f", file, name)
    return [file, wheel(stage / name, release)]
