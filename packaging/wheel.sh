#!/bin/sh
# wheel.sh [FOLDER]: builds the Python client's wheel into FOLDER (.), without a network.
# Needs python3-pip, python3-setuptools and python3-wheel.
set -eu
source=$(cd "$(dirname "$0")/../python" && pwd)
mkdir -p "${1:-.}"
folder=$(cd "${1:-.}" && pwd)
copy=$(mktemp -d)  # setuptools leaves folders in the sources that it builds
trap 'rm -rf "$copy"' EXIT
cp -r "$source/understudy" "$source/pyproject.toml" "$source/README.md" "$source/../LICENSE" "$copy"
rm -rf "$copy/understudy/__pycache__"
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-1700000000} /usr/bin/python3 -m pip --disable-pip-version-check wheel --quiet \
  --no-build-isolation --no-deps --no-index --wheel-dir "$folder" "$copy"
echo "$folder"/understudy-*-py3-none-any.whl
