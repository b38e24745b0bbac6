#!/usr/bin/env bash
# package.sh OUT: builds only the parts of the project that the Debian package contains, and writes the package to OUT/canhil.deb.
set -euo pipefail
out=$(mkdir -p "${1:?expected a folder for canhil.deb}" && realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bash tests/setup/install.sh package
cmake --preset default
cmake --build build/default --target canhil_installed
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
(cd build/default && cpack -G DEB -B "$work")
mv "$work"/*.deb "$out/canhil.deb"
