# Sourced by tests/run.sh, examples/run.sh and .ci/run: installs what the build needs and is not there (Debian, Ubuntu).

# need PACKAGE [COMMAND]: there if the command is found, whoever installed it, or else if the package is installed.
need() {
  if [ -n "$2" ] && command -v "$2" >/dev/null 2>&1; then return 0; fi
  if dpkg-query -W -f '${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; then return 0; fi
  missing="$missing $1"
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  elif command -v sudo >/dev/null 2>&1; then
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  else
    echo "neither root nor sudo" >&2
    return 1
  fi
}

# install_packages PACKAGE...: those that all need, and these.
install_packages() {
  missing=
  need cmake cmake
  need g++ g++
  need ninja-build ninja
  need pkg-config pkg-config
  need libeigen3-dev
  need libboost-dev
  need catch2
  need libbenchmark-dev
  need libcereal-dev
  need libcli11-dev
  need libcpp-httplib-dev
  need libsundials-dev
  need libtinyxml2-dev
  need libxsimd-dev
  need libxml2-utils xmllint
  need python3 python3
  for package in "$@"; do need "$package"; done
  updated=
  for package in $missing; do
    echo "Installing $package"
    as_root apt-get install -y -q --no-install-recommends "$package" && continue
    # Perhaps only the lists are missing or old.
    if [ -z "$updated" ]; then
      updated=yes
      as_root apt-get update -q && as_root apt-get install -y -q --no-install-recommends "$package" && continue
    fi
    echo "kte: cannot install the package $package, which is needed here; install it by hand and try again" >&2
    exit 1
  done
}
