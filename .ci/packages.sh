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

# A new machine updates itself at first: apt-get waits for that.
apt_get() {
  as_root apt-get -q -o DPkg::Lock::Timeout=600 "$@"
}

# Package lists, once, as soon as a package cannot be had: perhaps only they are missing or old.
update_lists() {
  [ -z "$updated" ] || return 1
  updated=yes
  apt_get update
}
updated=

# fetch PACKAGE...
fetch() {
  echo "Installing $*"
  apt_get install -y --no-install-recommends "$@" || { update_lists && apt_get install -y --no-install-recommends "$@"; }
}

# install_missing: all at once, which takes a third of the time; if that fails, one after the other, so that the message
# names the package.
install_missing() {
  [ -n "$missing" ] || return 0
  # shellcheck disable=SC2086  # words
  fetch $missing && return 0
  for package in $missing; do
    fetch "$package" && continue
    echo "kte: cannot install the package $package, which is needed here; install it by hand and try again" >&2
    exit 1
  done
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
  install_missing
}

# install_optional PACKAGE...: true if all of them are there; the caller says what is left out without them.
install_optional() {
  missing=
  for package in "$@"; do need "$package"; done
  # shellcheck disable=SC2086
  [ -z "$missing" ] || fetch $missing
}
