#!/usr/bin/env python3
"""Builds the VS Code extension: understudy-VERSION.vsix, with the schemas that the program prints.

usage: vsix.py [FOLDER [UNDERSTUDY]]

The file goes into FOLDER (.). UNDERSTUDY is the program (the installed one), whose version the extension gets. The
extension contains no code, so a package is a zip archive with two lists of its contents, and needs no npm module.
Equal input gives equal bytes.
"""
import json
import os
import re
import subprocess
import sys
import zipfile
from xml.sax.saxutils import escape, quoteattr

HERE = os.path.dirname(os.path.abspath(__file__))
PARTS = ("README.md", "language-configuration.json", "snippets", "syntaxes")
TYPES = {"json": "application/json", "md": "text/markdown", "txt": "text/plain", "vsixmanifest": "text/xml"}


def output_of(program, *arguments):
    try:
        return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout
    except OSError as error:
        sys.exit(f"vsix.py: {program}: {error.strerror}; expected the program `understudy`")
    except subprocess.CalledProcessError as error:
        sys.exit(f"vsix.py: {program} {arguments[0]}: exit code {error.returncode}; expected the program `understudy`")


def manifest_of_packages(package):
    """Returns what VS Code and its galleries read before they unpack the rest."""
    engine = package["engines"]["vscode"]
    languages = [language["aliases"][0] for language in package["contributes"]["languages"]]
    tags = ",".join(package["keywords"] + languages + ["snippet"])
    return f"""<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id={quoteattr(package["name"])} Version={quoteattr(package["version"])} \
Publisher={quoteattr(package["publisher"])}/>
    <DisplayName>{escape(package["displayName"])}</DisplayName>
    <Description xml:space="preserve">{escape(package["description"])}</Description>
    <Tags>{escape(tags)}</Tags>
    <Categories>{escape(",".join(package["categories"]))}</Categories>
    <GalleryFlags>Public</GalleryFlags>
    <License>extension/LICENSE.txt</License>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value={quoteattr(engine)}/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionDependencies" Value=""/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionPack" Value=""/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="ui,workspace,web"/>
      <Property Id="Microsoft.VisualStudio.Services.GitHubFlavoredMarkdown" Value="true"/>
    </Properties>
  </Metadata>
  <Installation>
    <InstallationTarget Id="Microsoft.VisualStudio.Code"/>
  </Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.License" Path="extension/LICENSE.txt" Addressable="true"/>
  </Assets>
</PackageManifest>
"""


def content_types():
    rows = "".join(f'<Default Extension=".{ending}" ContentType="{kind}"/>' for ending, kind in TYPES.items())
    return ('<?xml version="1.0" encoding="utf-8"?>\n'
            f'<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">{rows}</Types>\n')


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def contents(program):
    """Returns the text of each file of the package by its path, in the order of the archive."""
    package = json.loads(text_of(os.path.join(HERE, "package.json")))
    package["version"] = output_of(program, "--version").strip()
    if not re.fullmatch(r"\d+\.\d+\.\d+", package["version"]):
        sys.exit(f"vsix.py: {program}: does not print a version such as 1.2.3; expected the program `understudy`")
    del package["scripts"]
    made = {"extension.vsixmanifest": manifest_of_packages(package), "[Content_Types].xml": content_types(),
            "extension/package.json": json.dumps(package, indent=2) + "\n",
            "extension/LICENSE.txt": text_of(os.path.join(HERE, "..", "..", "LICENSE"))}
    for part in PARTS:
        place = os.path.join(HERE, part)
        for name in sorted(os.listdir(place)) if os.path.isdir(place) else [""]:
            path = os.path.join(part, name) if name else part
            made[f"extension/{path}"] = text_of(os.path.join(HERE, path))
    for what in ("bench", "scenario", "model"):
        made[f"extension/schemas/{what}.schema.json"] = output_of(program, "schema", what)
    return made


def build(folder=".", program="understudy"):
    files = contents(program)
    version = json.loads(files["extension/package.json"])["version"]
    path = os.path.join(folder, f"understudy-{version}.vsix")
    os.makedirs(folder, exist_ok=True)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, text in files.items():
            entry = zipfile.ZipInfo(name)  # of 1980, the earliest time of a zip archive
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, text)
    return path


if __name__ == "__main__":
    if len(sys.argv) > 3 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    try:
        print(build(*sys.argv[1:]))
    except OSError as error:
        sys.exit(f"vsix.py: {error.filename}: {error.strerror}")
