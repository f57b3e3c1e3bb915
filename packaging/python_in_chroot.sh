#!/bin/sh
# python_in_chroot.sh PROGRAM_DEB: builds the client's wheel and Debian package, and uses both in bare chroots. Run it
# by hand, as root, with debootstrap and a network. PROGRAM_DEB is the package that `cpack` made in build/release.
# UNDERSTUDY_ROOT=FOLDER: copies this chroot, made by debootstrap, instead of making one.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
program=$(readlink -f "$1")
work=$(mktemp -d)
trap 'umount "$work"/*/proc "$work"/*/dev/pts 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
wheel=$("$here/wheel.sh" "$work/packages")
deb=$("$here/python_deb.sh" "$work/packages")
bare=${UNDERSTUDY_ROOT:-}
if [ -z "$bare" ]; then
  bare=$work/bare
  debootstrap --variant=minbase bookworm "$bare" >/dev/null
fi
suite='
def test_time_stands(bench, port):
    assert bench.advance("1ms") == 1_000_000
    assert bench["HW_Code"] == 49153
'
for way in deb wheel; do
  root=$work/$way
  cp -a "$bare" "$root"
  cp "$program" "$root/root/program.deb"
  cp "$deb" "$wheel" "$root/root/"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  printf '%s' "$suite" >"$root/root/test_installed.py"
  mount -t proc proc "$root/proc"
  mkdir -p "$root/dev/pts"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
  ln -sf pts/ptmx "$root/dev/ptmx"
  if [ $way = deb ]; then
    install='apt-get install -y -qq --no-install-recommends ./program.deb ./python3-understudy_*.deb python3-pytest'
    python=/usr/bin/python3
  else
    # A virtual environment that sees Debian'"'"'s pytest; the wheel itself needs nothing.
    install='apt-get install -y -qq --no-install-recommends ./program.deb python3-pytest python3-venv &&
      python3 -m venv --system-site-packages v && v/bin/pip --disable-pip-version-check install -q --no-index ./*.whl'
    python=/root/v/bin/python
  fi
  chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/root sh -euc "cd /root
    { apt-get update -qq && $install; } >install.log 2>&1 || { tail -20 install.log; exit 1; }
    $python -m pytest -q test_installed.py
    $python -c 'import understudy; print(understudy.__file__)'
    ! ls -d /tmp/understudy-* 2>/dev/null"
  umount "$root/proc" "$root/dev/pts"
  echo "$way: installed and used"
done
