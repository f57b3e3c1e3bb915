#!/bin/sh
# python_deb.sh [FOLDER]: builds python3-understudy_VERSION_all.deb, the client and the pytest plugin, into FOLDER (.).
# Needs dpkg-deb, and everything that wheel.sh needs.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "${1:-.}"
folder=$(cd "${1:-.}" && pwd)
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-1700000000}
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
wheel=$("$here/wheel.sh" "$staging/wheel")
version=$(basename "$wheel" | cut -d- -f2)
root=$staging/root
modules=$root/usr/lib/python3/dist-packages
documents=$root/usr/share/doc/python3-understudy
mkdir -p "$modules" "$documents" "$root/DEBIAN"
/usr/bin/python3 -m zipfile -e "$wheel" "$modules"
rm "$modules"/understudy-*.dist-info/RECORD  # for pip; dpkg manages these files
rm "$modules"/understudy-*.dist-info/LICENSE  # Debian has it
cp "$here/copyright" "$documents/copyright"
sed "s/@DEBIAN_VERSION@/$version-1/; s/^understudy /python3-understudy /; s/@MAINTAINER@/Understudy maintainers <maintainers@understudy.invalid>/" \
  "$here/changelog.in" | gzip -9n >"$documents/changelog.Debian.gz"
cat >"$root/DEBIAN/control" <<END
Package: python3-understudy
Version: $version-1
Architecture: all
Section: python
Priority: optional
Maintainer: Understudy maintainers <maintainers@understudy.invalid>
Depends: python3 (>= 3.8)
Recommends: understudy
Suggests: python3-pytest, python3-pytest-xdist, python3-hypothesis
Installed-Size: $(du -sk "$root/usr" | cut -f1)
Description: benches of emulated motion controllers, from Python and pytest
 The client of understudy, an emulator of industrial motion controllers, and
 a plugin of pytest with the fixtures bench, bench_factory and port.
END
printf '#!/bin/sh\nset -e\nif [ "$1" = configure ]; then py3compile -p python3-understudy || true; fi\n' >"$root/DEBIAN/postinst"
printf '#!/bin/sh\nset -e\npy3clean -p python3-understudy || true\n' >"$root/DEBIAN/prerm"
chmod -R u=rwX,go=rX "$root"
chmod 755 "$root/DEBIAN/postinst" "$root/DEBIAN/prerm"
deb=$folder/python3-understudy_$version-1_all.deb
dpkg-deb --root-owner-group --build "$root" "$deb" >/dev/null
echo "$deb"
