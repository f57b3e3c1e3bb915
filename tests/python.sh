#!/bin/sh
# python.sh tests|types PROJECT PROGRAM: the tests of python/ against the program, or what mypy says. 77: skipped.
set -eu
what=$1 project=$2
export UNDERSTUDY_PROGRAM="$3" PYTHONPATH="$2/python" PYTHONDONTWRITEBYTECODE=1
python=/usr/bin/python3  # Debian's, as its modules are
demand() {
  for module in "$@"; do
    "$python" -c "import $module" 2>/dev/null || { echo "skipped: Python's module $module is not installed"; exit 77; }
  done
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
if [ "$what" = types ]; then
  demand mypy pytest
  "$python" -m mypy --strict --cache-dir="$folder" "$project/python/understudy"
else
  demand pytest xdist hypothesis
  # The plugin is named by the tests; what is installed of it does not count.
  "$python" -m pytest -q -n 2 -p no:cacheprovider --basetemp="$folder/kept" "$project/python/tests"
fi
