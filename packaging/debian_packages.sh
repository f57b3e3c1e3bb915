# ./run and ./test source this file: it lists the Debian packages that they need, installs them, and calls CMake.

build_packages=(g++ cmake ninja-build ccache pkg-config libboost-dev libcli11-dev libmodbus-dev
                libyaml-cpp-dev nlohmann-json3-dev libsqlite3-dev libgtest-dev libeigen3-dev)
host_packages=(mbpoll python3-serial expect)
plot_packages=(gnuplot-nox)
test_packages=(python3                                   # counts the results
               clang-format                              # checks the formatting of all files
               nodejs                                    # parses the page's scripts
               clang libclang-rt-dev                     # compile with sanitizers
               dpkg-dev man-db                           # for the package and its man page
               advancecomp                               # packs the portable archive
               tshark gtkwave                            # read the captures and traces
               socat                                     # connects a port to an address
               sqlite3 parallel                          # read results, and run shards
               lcov                                      # reads coverage
               zsh fish                                  # complete commands and flags
               python3-pytest python3-pytest-xdist python3-hypothesis python3-yaml mypy  # the Python client
               python3-pip python3-setuptools python3-wheel                  # its wheel
               python3-pymodbus python3-serial-asyncio)  # a host; it only recommends the second package, but needs it
heavy_host_packages=(ser2net libqt5serialbus5-dev chromium chromium-driver firefox-esr python3-selenium npm node-typescript)  # with UNDERSTUDY_HEAVY_HOSTS=1

# Succeeds if apt-get can install packages here, as root.
can_install() {
  command -v apt-get >/dev/null && command -v dpkg-query >/dev/null || return 1
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null
}

# missing_of PACKAGE...: prints the packages that are not installed, one per line; without dpkg, all of them.
missing_of() {
  local package status
  for package in "$@"; do
    status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) || status=
    [ "$status" = 'install ok installed' ] || echo "$package"
  done
}

# install_missing PACKAGE...: prints the missing packages and installs them; prints nothing if none is missing. If it
# cannot install them, it lists them, and the caller continues with the installed ones.
install_missing() {
  local missing why  # names of packages do not contain spaces
  missing=($(missing_of "$@"))
  [ ${#missing[@]} -eq 0 ] && return 0
  if ! can_install; then
    why="no apt-get"
    ! command -v apt-get >/dev/null || why="not root, and no sudo"
    echo "nothing can be installed here ($why); needed (Debian 12 names): ${missing[*]}"
    return 0
  fi
  echo "installing: ${missing[*]}"
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null 2>&1 && return 0
  # The list of packages may be outdated or missing.
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# configure PRESET: runs CMake, and starts from scratch if the folder was moved or renamed since the last run.
configure() {
  local said
  if said=$(cmake --preset "$1" 2>&1); then
    printf '%s\n' "$said"
    return 0
  fi
  if [[ $said == *'is different than the directory'* || $said == *'does not match the source'* ]]; then
    cmake --fresh --preset "$1"
    return
  fi
  printf '%s\n' "$said"
  return 1
}
