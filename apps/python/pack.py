"""Packs isoroll for pip.

    python3 pack.py wheel FOLDER   a wheel of what CMake put into FOLDER: library, command, _instruments.pyi
    python3 pack.py sdist FOLDER   the sources

CMake calls it so (../packaging/wheel.cmake). Pip calls build_wheel and build_sdist (PEP 517); CMAKE_ARGS in the
environment has further options for CMake. It needs Python's standard library, and objdump. The same files give the same
bytes: everything has one date, SOURCE_DATE_EPOCH or that of ../packaging/date.cmake.
"""

import base64
import gzip
import hashlib
import io
import os
import platform
import re
import shlex
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
SOURCES = [".ci", ".clang-format", ".clang-tidy", ".packages", "CITATION.cff", "CMakeLists.txt", "LICENSE",
           "README.md", "apps", "examples", "lib", "tests"]
LIBRARY, COMMAND = "libisoroll.so.0", "isoroll"  # as wheel.cmake calls them
OF_GLIBC = {"libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}

METADATA = """\
Metadata-Version: 2.1
Name: isoroll
Version: {version}
Summary: The rubber Chaplygin ball on a sphere and its twin, a point on a sphere
License: GPL-3.0-or-later
License-File: LICENSE
License-File: NOTICES
Requires-Python: >=3.9
Requires-Dist: numpy>=1.21
Description-Content-Type: text/markdown

"""


def version():
    text = (SOURCE / "lib/base/version.h").read_text()
    return ".".join(re.search(rf"ISO_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def metadata():
    return (METADATA.format(version=version()) + (HERE / "README.md").read_text(encoding="utf-8")).encode()


def date():
    """Seconds since 1970: of all files."""
    day = re.search(r"\d{10}", (SOURCE / "apps/packaging/date.cmake").read_text())[0]
    return int(os.environ.get("SOURCE_DATE_EPOCH") or day)


# --- the wheel ------------------------------------------------------------------------------------------------------


def glibc(path):
    """N: the file runs with glibc 2.N and later. It needs nothing else."""
    said = subprocess.run(["objdump", "-p", str(path)], check=True, stdout=subprocess.PIPE, universal_newlines=True,
                          env=dict(os.environ, LC_ALL="C")).stdout
    others = set(re.findall(r"NEEDED +(\S+)", said)) - OF_GLIBC
    versions = [int(number) for number in re.findall(r" GLIBC_2\.(\d+)", said)]
    if others or not versions or "TEXTREL" in said:
        sys.exit(f"{path.name} cannot be in a wheel: it needs {', '.join(others) or 'no glibc, or changes its code'}")
    return max(versions)


def wheel_files(folder, tag):
    """Names in the wheel and their bytes."""
    modules = sorted((HERE / "isoroll").glob("*.py")) + [HERE / "isoroll/py.typed"]
    about, data = f"isoroll-{version()}.dist-info", f"isoroll-{version()}.data"
    files = {f"isoroll/{path.name}": path.read_bytes() for path in modules}
    files["isoroll/_instruments.pyi"] = (folder / "_instruments.pyi").read_bytes()
    files[f"isoroll/{LIBRARY}"] = (folder / LIBRARY).read_bytes()
    files[f"{data}/scripts/{COMMAND}"] = (folder / COMMAND).read_bytes()
    files[f"{about}/METADATA"] = metadata()
    files[f"{about}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: isoroll {version()}\nRoot-Is-Purelib: false\n"
                               f"Tag: {tag}\n").encode()
    files[f"{about}/licenses/LICENSE"] = (SOURCE / "LICENSE").read_bytes()
    files[f"{about}/licenses/NOTICES"] = (folder / "NOTICES").read_bytes()
    record = f"{about}/RECORD"
    hashes = {name: base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest()).rstrip(b"=").decode()
              for name in files}
    lines = [f"{name},sha256={hashes[name]},{len(files[name])}\n" for name in files] + [f"{record},,\n"]
    files[record] = "".join(lines).encode()
    return files


def pack_wheel(folder):
    """Returns the wheel's name."""
    oldest = max(glibc(folder / name) for name in (LIBRARY, COMMAND))
    tag = f"py3-none-manylinux_2_{oldest}_{platform.machine()}"
    for old in folder.glob("isoroll-*.whl"):
        old.unlink()
    path = folder / f"isoroll-{version()}-{tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in wheel_files(folder, tag).items():
            entry = zipfile.ZipInfo(name, time.gmtime(date())[:6])
            entry.create_system = 3  # Unix: it has permissions
            entry.external_attr = (0o100755 if "/scripts/" in name or ".so" in name else 0o100644) << 16
            archive.writestr(entry, content, zipfile.ZIP_DEFLATED, 9)
    return path.name


# --- the sources ----------------------------------------------------------------------------------------------------


def source_files():
    """Names and bytes, in one order. The top has what pip reads."""
    backend = (HERE / "pyproject.toml").read_text().replace('["."]', '["apps/python"]')
    yield "PKG-INFO", metadata(), False
    yield "pyproject.toml", backend.encode(), False
    for top in SOURCES:
        path = SOURCE / top
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            name = file.relative_to(SOURCE).as_posix()
            if file.is_file() and "__pycache__" not in name:
                yield name, file.read_bytes(), os.access(file, os.X_OK)


def pack_sdist(folder):
    """Returns the file's name."""
    root = f"isoroll-{version()}"
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / f"{root}.tar.gz", "wb") as file, \
            gzip.GzipFile("", "wb", 9, file, mtime=date()) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        for name, content, runs in source_files():
            entry = tarfile.TarInfo(f"{root}/{name}")
            entry.size, entry.mtime, entry.mode = len(content), date(), 0o755 if runs else 0o644
            archive.addfile(entry, io.BytesIO(content))
    return f"{root}.tar.gz"


# --- what pip calls -------------------------------------------------------------------------------------------------


def build_sdist(sdist_directory, config_settings=None):
    return pack_sdist(Path(sdist_directory))


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    if not (SOURCE / "CMakeLists.txt").is_file():
        sys.exit(f"the sources of isoroll are not at {SOURCE}: a wheel cannot be made of apps/python alone")
    with tempfile.TemporaryDirectory() as build:
        options = ["-DBUILD_TESTING=OFF", "-DISO_MPI=OFF", f"-DISO_PYTHON={sys.executable}",
                   *shlex.split(os.environ.get("CMAKE_ARGS", ""))]
        subprocess.run(["cmake", "-S", str(SOURCE), "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "wheel", "--parallel", str(os.cpu_count() or 1)],
                       check=True)
        made, = Path(build, "wheel").glob("*.whl")
        Path(wheel_directory, made.name).write_bytes(made.read_bytes())
        return made.name


if __name__ == "__main__":
    actions = {"wheel": pack_wheel, "sdist": pack_sdist}
    if len(sys.argv) != 3 or sys.argv[1] not in actions:
        sys.exit("usage: python3 pack.py wheel|sdist FOLDER")
    print(actions[sys.argv[1]](Path(sys.argv[2])))
