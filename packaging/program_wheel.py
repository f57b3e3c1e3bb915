#!/usr/bin/env python3
"""program_wheel.py ARCHIVE [FOLDER]: makes a wheel from what portable.sh has packed and from the Python client, so that
`pip install` also installs the program, its library and scenarios. It is written into FOLDER (.). Its tag names the
machine and the oldest C library that the program needs. Needs the same packages as wheel.sh.
"""
import base64
import hashlib
import json
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile
import zipfile

HERE = pathlib.Path(__file__).resolve().parent


class Wheel:
    """Writes a zip file whose entries all have the same time, with their list (RECORD)."""

    def __init__(self, path, information, when):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9)
        self.information, self.when, self.record = information, when, []

    def add(self, name, content, mode=0o644):
        entry = zipfile.ZipInfo(name, self.when)
        entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, (0o100000 | mode) << 16
        self.zip.writestr(entry, content)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(content)}\n")

    def close(self):
        name = f"{self.information}/RECORD"
        entry = zipfile.ZipInfo(name, self.when)
        entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o100644 << 16
        self.zip.writestr(entry, "".join(self.record) + f"{name},,\n")
        self.zip.close()


def tag_of(archive, parts):
    machine = re.fullmatch(r"understudy-[^-]+-linux-(\w+)\.tar\.gz", archive.name).group(1)
    glibc = next(part["version"] for part in parts["components"] if part["name"] == "glibc")
    return f"manylinux_{glibc.replace('.', '_')}_{machine}"


def place_of(path, data, information):
    """Returns the place of a file of the portable tree in the wheel, or nothing if the wheel does not contain it."""
    if path == "bin/understudy":
        return f"{data}/scripts/understudy"
    if path.startswith(("lib/", "share/")):
        return f"{data}/data/{path}"  # below the prefix, where the program looks for it: ../lib/understudy
    if path == "sbom.cdx.json":
        return f"{information}/sboms/understudy.cdx.json"
    if path.startswith("licences/"):
        return f"{information}/licenses/{path[len('licences/'):]}"
    return None


def main(archive, folder="."):
    archive = pathlib.Path(archive)
    with tempfile.TemporaryDirectory() as own, tarfile.open(archive) as packed:
        client = subprocess.run([HERE / "wheel.sh", own], check=True, capture_output=True, text=True).stdout.strip()
        files = {member.name.partition("/")[2]: member for member in packed.getmembers() if member.isfile()}
        tag = tag_of(archive, json.load(packed.extractfile(files["sbom.cdx.json"])))
        stem = "-".join(pathlib.Path(client).name.split("-")[:2])
        information, data = f"{stem}.dist-info", f"{stem}.data"
        path = pathlib.Path(folder, f"{stem}-py3-none-{tag}.whl").resolve()
        path.parent.mkdir(parents=True, exist_ok=True)
        with zipfile.ZipFile(client) as pure:
            wheel = Wheel(path, information, pure.infolist()[0].date_time)
            for name in sorted(pure.namelist()):
                if name not in (f"{information}/RECORD", f"{information}/WHEEL"):
                    wheel.add(name, pure.read(name))
        wheel.add(f"{information}/WHEEL", f"Wheel-Version: 1.0\nGenerator: {pathlib.Path(__file__).name}\n"
                                          f"Root-Is-Purelib: false\nTag: py3-none-{tag}\n\n".encode())
        for name, member in sorted(files.items()):
            place = place_of(name, data, information)
            if place:
                wheel.add(place, packed.extractfile(member).read(), member.mode & 0o777)
        wheel.close()
    print(path)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
