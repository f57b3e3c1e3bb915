#!/bin/sh
# python.sh tests|types PROJECT PROGRAM: runs the tests of python/ with the program, or mypy. Exit code 77: skipped.
set -eu
what=$1 project=$2
export UNDERSTUDY_PROGRAM="$3" PYTHONPATH="$2/python" PYTHONDONTWRITEBYTECODE=1
python=/usr/bin/python3  # Debian's Python, because its modules are Debian's
demand() {
  for module in "$@"; do
    "$python" -c "import $module" 2>/dev/null || { echo "skipped: Python's module $module is not installed"; exit 77; }
  done
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
if [ "$what" = types ]; then
  demand mypy pytest hypothesis
  "$python" -m mypy --strict --cache-dir="$folder" "$project/python/understudy"
else
  demand pytest xdist hypothesis
  # The tests name the plugin; an installed one does not count.
  "$python" -m pytest -q -n 2 -p no:cacheprovider --basetemp="$folder/kept" "$project/python/tests"
fi
