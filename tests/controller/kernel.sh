#!/usr/bin/env bash
# kernel.sh: downloads Debian's kernel into a cache (once), unpacks the parts that a guest with CAN controllers needs, and prints the
# path of the folder with these parts. The parts are vmlinuz, modules/*.ko, and build/ (the headers, to build a module). Nothing is
# installed. On failure, prints one error line and ends with exit code 2.
# The cache: ${XDG_CACHE_HOME:-~/.cache}/canhil/controller/, one folder per kernel. Remove the cache to get Debian's newest kernel.
set -euo pipefail

die() { echo "controller: $*" >&2; exit 2; }
cache=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/canhil/controller
modules=(
  drivers/virtio/virtio{_ring,,_pci_modern_dev,_pci_legacy_dev,_pci} drivers/char/virtio_console
  net/9p/9pnet{,_virtio} fs/netfs/netfs fs/fscache/fscache fs/9p/9p fs/overlayfs/overlay
  drivers/net/can/dev/can-dev net/can/can{,-raw,-bcm,-gw} drivers/net/can/sja1000/{sja1000,kvaser_pci} net/sched/sch_tbf
)
modules=("${modules[@]/%/.ko}")

present() { # prints the folder of the newest kernel in the cache; fails if the cache has no kernel
  local newest
  newest=$(find "$cache" -mindepth 2 -maxdepth 2 -name complete 2>/dev/null | sort -V | tail -n 1)
  if [[ -z "$newest" ]]; then return 1; fi
  dirname "$newest"
}
if present; then exit 0; fi

for tool in apt-get apt-cache dpkg-deb tar flock; do
  command -v "$tool" >/dev/null || die "$tool is missing, and no kernel in $cache: expected Debian 12"
done
mkdir -p "$cache" || die "cannot make the folder $cache"
exec 9>"$cache/lock"
flock 9 # if several kernel.sh run at the same time, only one downloads
if present; then exit 0; fi

# Package lists in the cache. They are needed because a user without root rights cannot write to apt's folders, and
# because the machine's lists may be old or absent. If apt uses these lists, it also verifies downloads by the
# signatures of Debian's archive.
own_lists=(-o "Dir::State::Lists=$cache/lists" -o "Dir::Cache=$cache/apt" -o Debug::NoLocking=1 -o APT::Sandbox::User=root)
options=(-o APT::Sandbox::User=root)
depends() { apt-cache "${options[@]}" depends --important "$1" 2>/dev/null | sed -n 's/^ *Depends: //p'; }
fetch() { # downloads the packages into the current directory
  local image
  image=$(depends linux-image-amd64 | grep -m 1 '^linux-image-[0-9]')
  if [[ -z "$image" ]]; then echo "E: no package linux-image-amd64 in the lists"; return 1; fi
  release=${image#linux-image-}
  mapfile -t headers < <(depends "linux-headers-$release" | grep -E '^linux-(headers-.*-common|kbuild-.*)$')
  rm -f ./*.deb
  apt-get "${options[@]}" -q -o Acquire::Retries=3 download "$image" "linux-headers-$release" "${headers[@]}"
}
making=$(mktemp -d "$cache/making.XXXXXX")
trap 'rm -rf "$making"' EXIT
cd "$making"
echo "controller: downloading Debian's kernel into $cache (once, about 85 MB)" >&2
if ! fetch >log 2>&1; then
  mkdir -p "$cache"/lists/partial "$cache"/apt/archives/partial
  options=("${own_lists[@]}")
  { apt-get "${options[@]}" -q -o Acquire::Retries=3 update && fetch; } >>log 2>&1 ||
    die "cannot download linux-image-amd64 (Debian 12's apt sources expected): $(grep -m 1 -E '^[EW]: ' log || tail -n 1 log)"
fi

unpack() { # unpack PACKAGE [FILE...]
  local package=$1
  shift
  dpkg-deb --fsys-tarfile "$package"_*.deb | tar -x "$@" 2>>log || die "$package: unexpected content: $(tail -n 1 log)"
}
unpack "linux-image-$release" "./boot/vmlinuz-$release" "${modules[@]/#/./lib/modules/$release/kernel/}"
for package in "linux-headers-$release" "${headers[@]}"; do unpack "$package"; done
mkdir -p "$release/modules"
mv "boot/vmlinuz-$release" "$release/vmlinuz"
for module in "${modules[@]}"; do mv "lib/modules/$release/kernel/$module" "$release/modules/"; done
printf '%s\n' "${modules[@]##*/}" >"$release/order" # the modules in the order in which they are loaded
mv usr "$release/"
# One Makefile of the headers contains an absolute path, which is wrong in the cache. sed makes this path relative.
build=$release/usr/src/linux-headers-$release
sed -i 's|^include /usr/src/|include $(dir $(lastword $(MAKEFILE_LIST)))../|' "$build/Makefile"
ln -s "usr/src/linux-headers-$release" "$release/build"
touch "$release/complete"
rm -rf "${cache:?}/$release"
mv "$release" "$cache/"
rm -rf "$cache/lists" "$cache/apt"
echo "$cache/$release"
