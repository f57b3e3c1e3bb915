#!/bin/sh
# portable.sh [FOLDER [BUILD]]: packs the program and everything it needs into
# FOLDER/understudy-VERSION-linux-MACHINE.tar.gz (FOLDER: .), which runs wherever it is unpacked. BUILD is a build
# folder whose program is used as it is; without it, build/release is brought up to date and used. Equal sources,
# compiled on equal systems, produce equal bytes. Needs Debian's dpkg, binutils and advancecomp.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
project=$(dirname "$here")
mkdir -p "${1:-.}"
folder=$(cd "${1:-.}" && pwd)
build=${2:-}
if [ -z "$build" ]; then
  build=$project/build/release
  (cd "$project" && cmake --preset release && cmake --build --preset release --target understudy) >&2
fi
build=$(cd "$build" && pwd)
newest_glibc=2.35  # of Ubuntu 22.04

fail() {
  echo "portable.sh: $*" >&2
  exit 1
}
for tool in cmake strip objdump dpkg-query gzip advdef; do
  command -v "$tool" >/dev/null || fail "$tool is missing; expected Debian's cmake, binutils, dpkg, gzip and advancecomp"
done
[ -x "$build/understudy" ] || fail "$build: has no program; expected a folder in which it is built"

version=$("$build/understudy" --version)
if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
  SOURCE_DATE_EPOCH=$(date -u -d "$(sed -n 's/^ -- .*>  //p' "$here/changelog.in" | head -1)" +%s)
fi
name=understudy-$version-linux-$(uname -m)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
tree=$work/$name
prefix=/opt/understudy  # the man pages name it

# --- the files ----------------------------------------------------------------------------------
for component in understudy licence; do
  DESTDIR=$work/installed cmake --install "$build" --prefix $prefix --component $component >/dev/null
done
installed=$work/installed$prefix
documents=$installed/share/doc/understudy
libraries=$tree/lib/understudy
mkdir -p "$tree/bin" "$libraries" "$tree/licences"
strip -o "$tree/bin/understudy" "$build/understudy"
for preloaded in tty_shim host_time; do
  strip -o "$libraries/$preloaded.so" "$build/lib/understudy/$preloaded.so"
done
for part in understudy man bash-completion zsh fish; do
  mkdir -p "$tree/share"
  cp -R "$installed/share/$part" "$tree/share/"
done
# The extension has a copy of the schemas, which would make the archive larger than 5 MB.
rm -rf "$tree/share/understudy/vscode"
rm -f "$tree/share/understudy/docs"  # links to pages that the archive does not contain
cp "$documents/LICENSE" "$documents/CHANGELOG.md" "$tree/"
for licence in "$documents"/third_party/*/LICENSE; do
  cp "$licence" "$tree/licences/$(basename "$(dirname "$licence")")"
done

# --- the libraries --------------------------------------------------------------------------------
is_glibc() {
  case $1 in
    linux-vdso.so.* | ld-linux*.so.* | libc.so.* | libm.so.* | libpthread.so.* | libdl.so.* | librt.so.*) true ;;
    *) false ;;
  esac
}
ldd "$build/understudy" | while read -r library arrow place rest; do
  library=$(basename "$library")
  ! is_glibc "$library" || continue
  [ "$arrow" = "=>" ] && [ -f "$place" ] || fail "$library: is not found; expected it where the loader looks"
  cp -L "$place" "$libraries/$library"
  # The libraries do not search relative to the program: they find only the C library.
  for needed in $(objdump -p "$place" | sed -n 's/^ *NEEDED *//p'); do
    is_glibc "$needed" || fail "$library: needs $needed; expected its static archive, so that it becomes part of the program"
  done
done

# --- system requirements ------------------------------------------------------------------------
glibc=$(for file in "$tree/bin/understudy" "$libraries"/*; do objdump -T "$file"; done |
  sed -n 's/.*[( ]GLIBC_\([0-9.]*\)).*/\1/p' | sort -uV | tail -1)
newest=$(printf '%s\n' "$glibc" "$newest_glibc" | sort -V | tail -1)
[ "$newest" = "$newest_glibc" ] || [ -n "${UNDERSTUDY_ANY_GLIBC:-}" ] ||
  fail "the program needs glibc $glibc; expected at most $newest_glibc, that of Debian 12 (UNDERSTUDY_ANY_GLIBC=1 packs it)"

# --- the list of parts (CycloneDX) and their licences ----------------------------------------------
. /etc/os-release
machine=$(dpkg --print-architecture)
part() { # NAME VERSION LICENCE PURL
  printf ',\n    { "type": "library", "name": "%s", "version": "%s", "purl": "%s",\n' "$1" "$2" "$4"
  printf '      "licenses": [{ "expression": "%s" }] }' "$3"
}
package() { # NAME LICENCE: of this system; its licence is copied
  there=$(dpkg-query -W -f '${Version}' "$1" 2>/dev/null) || fail "$1 is not installed; expected the packages that ./run installs"
  cp "/usr/share/doc/$1/copyright" "$tree/licences/$1"
  part "$1" "$there" "$2" "pkg:deb/$ID/$1@$(printf %s "$there" | sed 's/+/%2B/g; s/:/%3A/g')?arch=$machine"
}
{
  printf '{\n  "bomFormat": "CycloneDX",\n  "specVersion": "1.5",\n  "version": 1,\n  "metadata": {\n'
  printf '    "timestamp": "%s",\n' "$(date -u -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%dT%H:%M:%SZ)"
  printf '    "component": { "type": "application", "name": "understudy", "version": "%s",\n' "$version"
  printf '      "licenses": [{ "expression": "Apache-2.0" }] }\n  },\n  "components": [\n'
  {
    printf '    { "type": "platform", "name": "glibc", "version": "%s", "description": "at least" }' "$glibc"
    package libmodbus5 LGPL-2.1-or-later
    package libyaml-cpp-dev MIT
    package libsqlite3-dev blessing
    package libboost-dev BSL-1.0
    package libcli11-dev BSD-3-Clause
    package nlohmann-json3-dev MIT
    package libeigen3-dev MPL-2.0
    package "libstdc++-$(c++ -dumpversion | cut -d. -f1)-dev" "GPL-3.0-or-later WITH GCC-exception-3.1"
    awk -F' *[|] *' '/^[|] `/ {
      gsub(/[`\/]/, "", $2); sub(/^[a-z]* /, "", $4); sub(/ .*/, "", $4); sub(/ .*/, "", $6); print $2, $4, $6
    }' "$project/third_party/README.md" |
      while read -r vendored release licence; do part "$vendored" "$release" "$licence" "pkg:npm/$vendored@$release"; done
  }
  printf '\n  ]\n}\n'
} >"$tree/sbom.cdx.json"
for licence in Apache-2.0 LGPL-2.1 GPL-3 MPL-2.0; do cp "/usr/share/common-licenses/$licence" "$tree/licences/"; done
cp "$here/copyright" "$tree/licences/understudy"

cat >"$tree/README.md" <<END
# Understudy $version

This folder runs from wherever it lies, on Linux ($(uname -m)) with glibc $glibc or newer:

    bin/understudy serve --model simple2-r3 --link feeder.port
    bin/understudy run share/understudy/scenarios
    man share/man/man1/understudy.1.gz

- \`share/understudy\`: benches and scenarios, example projects, recipes for CI, JSON schemas
- \`share/bash-completion\`, \`share/zsh\`, \`share/fish\`: completion
- \`lib/understudy\`: the library for \`--tty-shim\`, and the libraries that the program loads
- \`licences\`, \`sbom.cdx.json\`: the parts of the program and their licences. libmodbus is a file of its own and
  may be replaced; its source is Debian's package libmodbus.

The man pages name /opt/understudy, where this folder may be moved to.
END

# --- the archive ------------------------------------------------------------------------------------
chmod -R u=rwX,go=rX "$tree"
archive=$folder/$name.tar.gz
LC_ALL=C tar --create --format=ustar --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
  --directory "$work" "$name" | gzip -9n >"$work/archive"
advdef -z -3 -q "$work/archive"  # the same contents in 97 % of the bytes
mv "$work/archive" "$archive"
echo "$archive"
