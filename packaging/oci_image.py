#!/usr/bin/env python3
"""oci_image.py ARCHIVE [FOLDER]: makes a container image from what portable.sh has packed, without a daemon and without
a network: FOLDER/understudy-VERSION-linux-ARCHITECTURE.oci.tar, which `podman load`, `docker load` and `skopeo copy
oci-archive:` read. It has the tree in /opt/understudy and the C library of this system, and nothing else, not even a
shell. Equal archives on equal systems make equal bytes.
"""
import datetime
import gzip
import hashlib
import io
import json
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile

PLACE = "opt/understudy"
ARCHITECTURES = {"x86_64": "amd64", "aarch64": "arm64", "armv7l": "arm"}  # as Go calls them
SERVED = ["serve", "--model", "simple2-r3", "--no-pty", "--listen", "modbus-tcp://0.0.0.0:5020"]


class Layer:
    """A tar file, each entry with the same time and owner."""

    def __init__(self, when):
        self.bytes, self.when, self.folders = io.BytesIO(), when, set()
        self.tar = tarfile.open(fileobj=self.bytes, mode="w", format=tarfile.USTAR_FORMAT)

    def entry(self, name, mode, kind, **more):
        for folder in reversed(pathlib.PurePosixPath(name).parents[:-1]):
            self.folder(str(folder))
        entry = tarfile.TarInfo(name)
        entry.mtime, entry.mode, entry.type = self.when, mode, kind
        for key, value in more.items():
            setattr(entry, key, value)
        return entry

    def folder(self, name, mode=0o755):
        if name not in self.folders:
            self.folders.add(name)
            self.tar.addfile(self.entry(name, mode, tarfile.DIRTYPE))

    def file(self, name, content, mode=0o644):
        self.tar.addfile(self.entry(name, mode, tarfile.REGTYPE, size=len(content)), io.BytesIO(content))

    def content(self):
        self.tar.close()
        return self.bytes.getvalue()


class Image:
    """The files of an OCI layout. Its blobs are named by their hashes."""

    def __init__(self):
        self.files = {"oci-layout": b'{"imageLayoutVersion":"1.0.0"}'}

    def blob(self, kind, content):
        digest = hashlib.sha256(content).hexdigest()
        self.files[f"blobs/sha256/{digest}"] = content
        return {"mediaType": f"application/vnd.oci.image.{kind}", "digest": f"sha256:{digest}", "size": len(content)}


def in_json(value):
    return json.dumps(value, sort_keys=True, separators=(",", ":")).encode()


def c_library(program):
    """Returns path and content of the C library's files that the program and its own libraries load."""
    told = subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout
    tree = str(pathlib.Path(program).parents[1])
    for path in sorted(set(re.findall(r"(/\S+) \(0x", told))):
        if not path.startswith(tree):
            yield path.lstrip("/"), pathlib.Path(path).read_bytes()


def system_layer(program, when):
    layer = Layer(when)
    for folder, mode in (("dev", 0o755), ("proc", 0o755), ("sys", 0o755), ("tmp", 0o1777), ("work", 0o1777)):
        layer.folder(folder, mode)
    layer.file("etc/passwd", b"root:x:0:0:root:/:/nologin\nnobody:x:65534:65534:nobody:/:/nologin\n")
    layer.file("etc/group", b"root:x:0:\ntty:x:5:\nnobody:x:65534:\n")
    for path, content in c_library(program):
        layer.file(path, content, 0o755)
    licence = pathlib.Path("/usr/share/doc/libc6/copyright")
    if licence.exists():
        layer.file("usr/share/doc/libc6/copyright", licence.read_bytes())
    return layer.content()


def tree_layer(packed, when):
    layer = Layer(when)
    for member in packed.getmembers():
        path = f"{PLACE}/{member.name.partition('/')[2]}"
        if member.isfile():
            layer.file(path, packed.extractfile(member).read(), member.mode)
    return layer.content()


def main(archive, folder="."):
    archive = pathlib.Path(archive)
    named = re.fullmatch(r"understudy-([^-]+)-linux-(\w+)\.tar\.gz", archive.name)
    if not named or not archive.is_file():
        sys.exit(f"oci_image.py: {archive}: is not a file understudy-VERSION-linux-MACHINE.tar.gz; expected an "
                 "archive made by portable.sh")
    version, machine = named.groups()
    architecture = ARCHITECTURES.get(machine, machine)
    with tempfile.TemporaryDirectory() as own, tarfile.open(archive) as packed:
        packed.extractall(own)
        when = packed.getmembers()[0].mtime
        program = next(pathlib.Path(own).resolve().glob("*/bin/understudy"))
        layers = [system_layer(program, when), tree_layer(packed, when)]
    created = datetime.datetime.fromtimestamp(when, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")

    image = Image()
    packed_layers = [image.blob("layer.v1.tar+gzip", gzip.compress(layer, 6, mtime=0)) for layer in layers]
    config = image.blob("config.v1+json", in_json({
        "architecture": architecture, "os": "linux", "created": created,
        "config": {"Entrypoint": [f"/{PLACE}/bin/understudy"], "Cmd": SERVED, "WorkingDir": "/work",
                   "Env": [f"PATH=/{PLACE}/bin"], "ExposedPorts": {"5020/tcp": {}},
                   "Labels": {"org.opencontainers.image.version": version}},
        "rootfs": {"type": "layers", "diff_ids": [f"sha256:{hashlib.sha256(layer).hexdigest()}" for layer in layers]},
        "history": [{"created": created, "created_by": f"oci_image.py: {what}"}
                    for what in ("the C library", f"understudy {version}")]}))
    manifest = image.blob("manifest.v1+json", in_json({
        "schemaVersion": 2, "mediaType": "application/vnd.oci.image.manifest.v1+json", "config": config,
        "layers": packed_layers,
        "annotations": {"org.opencontainers.image.title": "understudy", "org.opencontainers.image.version": version,
                        "org.opencontainers.image.licenses": "Apache-2.0"}}))
    manifest.update(platform={"architecture": architecture, "os": "linux"},
                    annotations={"org.opencontainers.image.ref.name": version,
                                 "io.containerd.image.name": f"localhost/understudy:{version}"})
    image.files["index.json"] = in_json({"schemaVersion": 2, "manifests": [manifest],
                                         "mediaType": "application/vnd.oci.image.index.v1+json"})
    # Docker before version 25 reads only this list.
    place_of = {part["digest"]: "blobs/sha256/" + part["digest"].partition(":")[2] for part in (config, *packed_layers)}
    image.files["manifest.json"] = in_json([{"Config": place_of[config["digest"]],
                                             "RepoTags": [f"localhost/understudy:{version}"],
                                             "Layers": [place_of[part["digest"]] for part in packed_layers]}])

    whole = Layer(when)
    for name in sorted(image.files):
        whole.file(name, image.files[name])
    path = pathlib.Path(folder, f"understudy-{version}-linux-{architecture}.oci.tar").resolve()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(whole.content())
    print(path)


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
