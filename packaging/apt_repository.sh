#!/bin/sh
# apt_repository.sh FOLDER SUITE=DEB...: makes a signed apt repository in FOLDER, with a flat part for each SUITE.
# UNDERSTUDY_SIGNING_KEY: the gpg key that signs it; without it, a key is made for this repository and then discarded.
# Its public half is FOLDER/understudy.gpg. Needs dpkg-dev and gpg.
set -eu
fail() {
  echo "apt_repository.sh: $*" >&2
  exit 1
}
[ $# -ge 2 ] || fail "expected FOLDER SUITE=DEB..., such as /srv/apt bookworm=understudy_0.3.0-1_amd64.deb"
for tool in dpkg-scanpackages gpg; do
  command -v $tool >/dev/null || fail "$tool is missing; expected the packages dpkg-dev and gpg"
done
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
work=$(mktemp -d)
trap 'gpgconf --homedir "$work" --kill all 2>/dev/null || true; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
chmod 700 "$work"
key=${UNDERSTUDY_SIGNING_KEY:-}
if [ -z "$key" ]; then
  export GNUPGHOME="$work"
  key="Understudy packages <packages@understudy.invalid>"
  gpg --batch --quiet --passphrase '' --quick-generate-key "$key" ed25519 sign never 2>/dev/null
fi
gpg --batch --export "$key" >"$folder/understudy.gpg"

for named in "$@"; do
  suite=${named%%=*} deb=${named#*=}
  [ "$suite" != "$named" ] && [ -f "$deb" ] || fail "$named: expected SUITE=DEB"
  mkdir -p "$folder/$suite"
  cp "$deb" "$folder/$suite/"
done
date=$(date -u -R ${SOURCE_DATE_EPOCH:+-d "@$SOURCE_DATE_EPOCH"})
for part in "$folder"/*/; do
  suite=$(basename "$part")
  # apt looks for the names below the repository's address, which contains SUITE/.
  (cd "$folder" && dpkg-scanpackages --multiversion "$suite" 2>/dev/null) >"${part}Packages"
  gzip -9nc "${part}Packages" >"${part}Packages.gz"
  {
    printf 'Origin: Understudy\nLabel: Understudy\nSuite: %s\nCodename: %s\nDate: %s\nSHA256:\n' "$suite" "$suite" "$date"
    for list in Packages Packages.gz; do
      printf ' %s %s %s\n' "$(sha256sum "$part$list" | cut -d' ' -f1)" "$(stat -c %s "$part$list")" $list
    done
  } >"$work/Release"
  cp "$work/Release" "${part}Release"
  gpg --batch --quiet --yes --local-user "$key" --clearsign --output "${part}InRelease" "${part}Release"
  gpg --batch --quiet --yes --local-user "$key" --armor --detach-sign --output "${part}Release.gpg" "${part}Release"
done
echo "deb [signed-by=$folder/understudy.gpg] file:$folder SUITE/"
