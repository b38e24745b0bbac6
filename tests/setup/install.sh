#!/usr/bin/env bash
# Installs the Debian 12 packages that this project needs. If all packages are installed, it does nothing and needs no root rights.
#   install.sh build       packages for building and running the programs (the default)
#   install.sh tests       the set build, and the packages for tests/run.sh
#   install.sh coverage    the set tests, and the packages for tests/run.sh --coverage
#   install.sh tidy        packages for tests/run.sh --tidy and --analyse
#   install.sh package     the set build, and the packages for tests/package/debian.sh
#   install.sh docs        packages for the API pages (target api), and the pictures and figures in docs
#   install.sh full        all packages for tests/run.sh --full and tests/perf/run.sh
#   install.sh list SET    prints the package names of a set
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

build_packages=(
  g++ cmake ninja-build ccache pkg-config git
  libeigen3-dev libboost1.81-dev libgeographiclib-dev libfmt-dev libexpected-dev
  libcli11-dev libtomlplusplus-dev libmuparser-dev nlohmann-json3-dev libsqlite3-dev libsqlitecpp-dev libkainjow-mustache-dev libpcap-dev zlib1g-dev libssl-dev
  libzip-dev libpugixml-dev # plants that are FMUs: the archive, and its modelDescription.xml
  libjs-chart.js libncurses-dev # for the live view: the charts of its page (compiled into hil-bench), and its display in a terminal
  libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev # every build needs these, because CMake configures the tests too
)
test_packages=(
  clang-format
  python3 python3-can python3-canmatrix tshark # independent programs for comparison: a CAN node, a DBC reader, a reader of captures
  python3-pandas # an example of docs/recordings.md
  python3-numpy # the filters of tests/independent
  python3-yaml # reads the pipelines in docs/examples
  python3-jsonschema # validates reports by the schemas in docs
  python3-warlock # makes readers of the schemas in docs
  python3-pytest python3-pytest-xdist python3-coverage mypy flake8 python3-matplotlib # the Python package: its tests, its types, the pictures of docs/python.md
  python3-pip python3-setuptools python3-wheel python3-venv # installs the Python package from the source tree
  can-utils iproute2 kmod busybox user-mode-linux # for tests on vcan; user-mode Linux provides vcan if the machine's kernel has no vcan
)
paper_packages=(gnuplot-nox) # draws the figures of hil-bench campaign --paper, which refuses to run without it
tidy_packages=(clang clang-tidy)
docs_packages=(doxygen openssh-client) # API pages; the tutorial signs a report
picture_packages=(chromium chromium-driver python3-selenium fonts-dejavu-core) # pictures of the report page
package_packages=(dpkg-dev file debootstrap help2man) # builds a Debian package and tests it in a fresh system
full_packages=(
  rt-tests valgrind libclang-rt-14-dev
  qemu-system-x86 make gcc-12 libelf1 # an emulated PC with two CAN controllers; the PC's kernel is only unpacked, not installed
  chromium chromium-driver python3-selenium # tests the pages of the live view and of a report in a browser
  help2man systemd # help2man makes the manual pages of the package; systemd-analyze checks the package's unit without starting it
  slurm-wlm munge # a cluster of one machine, for campaigns as job arrays; started by the test itself, never as a service
)

die() { echo "install.sh: $*" >&2; exit 2; }

select_packages() {
  wanted=("${build_packages[@]}")
  case "$1" in
    build) ;;
    tests) wanted+=("${test_packages[@]}") ;;
    coverage) wanted+=("${test_packages[@]}" "${paper_packages[@]}") ;;
    tidy) wanted+=("${test_packages[@]}" "${tidy_packages[@]}") ;;
    package) wanted+=("${package_packages[@]}") ;;
    docs) wanted+=("${docs_packages[@]}" "${picture_packages[@]}" "${paper_packages[@]}" tshark) ;;
    full) wanted+=("${docs_packages[@]}" "${test_packages[@]}" "${paper_packages[@]}" "${tidy_packages[@]}" "${full_packages[@]}") ;;
    *) die "unknown set '$1': expected build, tests, coverage, tidy, package, docs or full" ;;
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
trap 'progress_stop; rm -f "$log"' EXIT
echo "install.sh: installing ${missing[*]}"
"${as_root[@]}" true # sudo asks for a password before the progress line starts
progress_start packages "$log"
# Without package lists, or with old lists, the first attempt fails within a second; only then new lists are fetched.
if ! apt install --no-install-recommends "${missing[@]}" >"$log" 2>&1; then
  progress_stop
  echo "install.sh: fetching package lists"
  progress_start packages "$log"
  if ! { apt update && apt install --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    progress_stop
    tail -n 15 "$log" >&2
    die "apt-get could not install (Debian 12 expected): ${missing[*]}"
  fi
fi
