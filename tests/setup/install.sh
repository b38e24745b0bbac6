#!/usr/bin/env bash
# Installs the Debian 12 packages of this project; does nothing, and needs no rights, when all are there.
#   install.sh build    what it takes to build and run the programs (the default)
#   install.sh tests    that, and what the tests use besides
#   install.sh list build|tests    prints the package names
set -euo pipefail

build_packages=(
  g++ cmake ninja-build ccache pkg-config git
  libeigen3-dev libboost1.81-dev libgeographiclib-dev libfmt-dev libexpected-dev
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libsqlite3-dev
  gnuplot-nox # draws the figures of hil-bench campaign --paper
  libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev # CMake configures the tests too
)
test_packages=(
  python3 python3-can python3-canmatrix # an independent DBC reader and CAN node
  can-utils iproute2 kmod busybox user-mode-linux rt-tests # vcan where the kernel has none
  qemu-system-x86 make gcc-12 libelf1 # two CAN controllers with the kernel's driver, in an emulated PC; its kernel is not installed
  slurm-wlm munge # a cluster of one machine, for campaigns as job arrays; started by the test itself, never as a service
  clang clang-format clang-tidy libclang-rt-14-dev valgrind
)

die() { echo "install.sh: $*" >&2; exit 2; }

select_packages() {
  case "$1" in
    build) wanted=("${build_packages[@]}") ;;
    tests) wanted=("${build_packages[@]}" "${test_packages[@]}") ;;
    *) die "unknown set '$1': expected build or tests" ;;
  esac
}

missing_of() { # names of the packages among "$@" that are not installed
  comm -23 <(printf '%s\n' "$@" | LC_ALL=C sort) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' | LC_ALL=C sort)
}

if [[ "${1:-}" == list ]]; then
  select_packages "${2:-build}"
  printf '%s\n' "${wanted[@]}"
  exit 0
fi
select_packages "${1:-build}"
command -v dpkg-query >/dev/null || die "no dpkg here: expected Debian 12 (bookworm)"
mapfile -t missing < <(missing_of "${wanted[@]}")
((${#missing[@]})) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || die "needs root or sudo to install: ${missing[*]}"
  if [[ ! -t 0 ]] && ! sudo -n true 2>/dev/null; then
    die "needs root, or sudo without a password, to install: ${missing[*]}"
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 \
    apt-get -q -y -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 -o Dpkg::Use-Pty=0 "$@" </dev/null
}
log=$(mktemp)
trap 'rm -f "$log"' EXIT
echo "install.sh: installing ${missing[*]}"
# Without package lists, or with old ones, the first try fails within a second: only then are they fetched.
if ! apt install --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
  echo "install.sh: fetching package lists"
  if ! { apt update && apt install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    die "apt-get could not install (Debian 12 expected): ${missing[*]}"
  fi
fi
