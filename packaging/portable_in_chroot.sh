#!/bin/sh
# portable_in_chroot.sh ARCHIVE WHEEL SUITE[=ROOT]...: tests the results of portable.sh and program_wheel.py in bare
# systems: serves the quick start, runs all scenarios, which must have the same hashes as here, and installs the wheel
# into a fresh environment. Run it by hand, as root, with debootstrap and a network. It copies a ROOT made by
# debootstrap, or makes one. SUITE is bookworm, trixie, jammy (Ubuntu 22.04) and so on.
set -eu
archive=$(readlink -f "$1") wheel=$(readlink -f "$2")
shift 2
work=$(mktemp -d)
trap 'umount "$work"/*/proc "$work"/*/dev/pts 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
trap 'exit 1' INT TERM
mkdir "$work/here"
tar -xzf "$archive" -C "$work/here" --strip-components 1
"$work/here/bin/understudy" run --hash "$work/here/share/understudy/scenarios" | grep '^hash' | sort >"$work/hashes"

cat >"$work/use.sh" <<'END'
set -eu
cd /root
began=$(date +%s%N)
mkdir portable && tar -xzf portable.tar.gz -C portable --strip-components 1
portable/bin/understudy serve portable/share/understudy/scenarios/quickstart.yaml --links /root >ready.txt 2>serve.log &
served=$!
until grep -qs '^ready' ready.txt; do kill -0 $served || { cat serve.log; exit 1; }; sleep 0.01; done
port=$(sed -n 's/^ready [^ ]* \([^ ]*\).*/\1/p' ready.txt)
portable/bin/understudy poll "$port" --model simple2-r3 Aaxis_SVON=1 Aaxis_Speed=200 Aaxis_AccTime=5 Aaxis_DecTime=5 \
  Aaxis_Pulse=32000 Aaxis_Move_INC=1 >/dev/null
portable/bin/understudy poll "$port" --model simple2-r3 STATUS.4 | tail -1 | grep -q '1$'
echo "from the archive to a moving axis: $((($(date +%s%N) - began) / 1000000)) ms"
kill $served && wait $served
portable/bin/understudy run --hash portable/share/understudy/scenarios | grep '^hash' | sort >hashes
diff hashes hashes.expected
echo "$(wc -l <hashes) scenarios have the hashes of the machine that made the archive"
[ -e wheel ] || exit 0
{ apt-get update -qq && apt-get install -y -qq --no-install-recommends python3-venv python3-pytest; } >install.log 2>&1 ||
  { tail -20 install.log; exit 1; }
python3 -m venv --system-site-packages v
v/bin/pip --disable-pip-version-check install -q --no-index wheel/*.whl
[ "$(v/bin/understudy models)" = "$(portable/bin/understudy models)" ]
printf 'def test_time_stands(bench):\n    assert bench.advance("1ms") == 1_000_000\n    assert bench["HW_Code"] == 49153\n' >test_it.py
v/bin/python -m pytest -q -p no:cacheprovider test_it.py | tail -1
END

for suite in "$@"; do
  root=$work/${suite%%=*}
  case $suite in
    *=*) cp -a "${suite#*=}" "$root" ;;
    *) debootstrap --variant=minbase "$suite" "$root" >/dev/null ;;
  esac
  mkdir "$root/root/wheel"
  cp "$wheel" "$root/root/wheel/"
  cp "$archive" "$root/root/portable.tar.gz"
  cp "$work/hashes" "$root/root/hashes.expected"
  cp "$work/use.sh" "$root/root/"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  mount -t proc proc "$root/proc"
  mkdir -p "$root/dev/pts"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
  ln -sf pts/ptmx "$root/dev/ptmx"
  echo "--- ${suite%%=*}"
  chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive sh /root/use.sh
  umount "$root/proc" "$root/dev/pts"
  rm -rf --one-file-system "$root"
done
