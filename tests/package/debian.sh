#!/usr/bin/env bash
# debian.sh BUILD: makes the Debian package of a finished build and installs it, with its dependencies, in a
# minimal Debian 12 (debootstrap). The commands of the installation are read from the last stage of
# packaging/Containerfile. Then the demo is flown in this Debian over the embedded bus, as the user that the
# Containerfile creates. Needs root and the network.
set -euo pipefail
build=$(realpath "$1")
for tool in debootstrap dpkg-shlibdeps; do
  command -v "$tool" >/dev/null || { echo "debian.sh: no $tool here: bash tests/setup/install.sh package" >&2; exit 2; }
done
((EUID == 0)) || { echo "debian.sh: a chroot needs root" >&2; exit 2; }
work=$(mktemp -d)
trap 'umount -q "$work/root/proc" 2>/dev/null || true; rm -rf "$work"' EXIT

(cd "$build" && cpack -G DEB -B "$work" >"$work/cpack.log") || { cat "$work/cpack.log" >&2; exit 1; }
package=$(ls "$work"/*.deb)
echo "package: $(basename "$package"), $(du -h "$package" | cut -f1)"
dpkg-deb --field "$package" Package Version Depends

# Uses the mirror and the proxy of the host's apt.
mirror=$( (grep -rhvE '^ *#' /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null || true) | grep -oE '(https?|file)://[^ ]+/debian/?( |$)' | head -n 1 | tr -d ' ' || true)
eval "$(apt-config shell http_proxy Acquire::http::Proxy https_proxy Acquire::https::Proxy)"
export http_proxy https_proxy
debootstrap --variant=minbase --include=ca-certificates bookworm "$work/root" ${mirror:+"$mirror"} >"$work/debootstrap.log" ||
  { tail "$work/debootstrap.log" >&2; exit 1; }
cp /etc/apt/apt.conf.d/* "$work/root/etc/apt/apt.conf.d/" 2>/dev/null || true # proxies
cp "$package" "$work/root/canhil.deb"
mount -t proc proc "$work/root/proc"
in_chroot() { chroot "$work/root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
source=$(dirname "${BASH_SOURCE[0]}")/../..
last_stage=$(tac "$source/packaging/Containerfile" | sed '/^FROM/q' | tac)
[[ $(grep -c '^RUN ' <<<"$last_stage") == 2 ]] || { echo "debian.sh: packaging/Containerfile: expected two RUN lines in its last stage" >&2; exit 1; }
sed -n 's/^RUN //p' <<<"$last_stage" | while read -r line; do
  in_chroot bash -ec "$line" </dev/null >>"$work/apt.log" 2>&1 || { tail "$work/apt.log" >&2; exit 1; }
done
user=$(sed -n 's/^USER //p' <<<"$last_stage")
as_user() { chroot --userspec="$user" "$work/root" env -i PATH=/usr/bin:/bin HOME="/home/$user" bash -c 'cd && exec "$@"' bash "$@"; }

# The expected exit code is 3 (not measured): the outputs pass, but timing cannot be measured in virtual time.
code=0
as_user hil-bench run /usr/share/canhil/flights/transfer_alignment.toml --lockstep --log run.pcap >"$work/run.txt" || code=$?
cat "$work/run.txt"
if ((code != 3)) || grep -q FAIL "$work/run.txt"; then echo "debian.sh: the demo ended with $code" >&2; exit 1; fi
as_user hil-bench conformance
echo "debian.sh: installed and flown"
