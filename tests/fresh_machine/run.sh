#!/usr/bin/env bash
# Runs a command of this project on a machine with nothing installed: a minimal Debian 12 in a chroot, with a fresh clone of the project.
#   sudo bash tests/fresh_machine/run.sh [--keep] COMMAND...        e.g.  bash tests/run.sh
# Run this script by hand before a release. COMMAND must install the packages that it needs, as tests/run.sh does.
# The chroot uses the package sources of the host: the configuration of the host's apt (sources, keys, proxies, credentials) is copied into it.
# Uncommitted changes are not tested. Exit code: that of COMMAND; 2 if the chroot could not be made.
set -euo pipefail

die() { echo "fresh_machine: $*" >&2; exit 2; }
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
keep=no
if [[ "${1:-}" == --keep ]]; then keep=yes; shift; fi
(($#)) || die "no command given, for example: bash tests/run.sh"
((EUID == 0)) || die "must be run by root (it mounts and changes root)"
for tool in debootstrap unshare git tar; do
  command -v "$tool" >/dev/null || die "$tool is missing: apt-get install debootstrap util-linux git tar"
done

cache=${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/canhil/fresh_machine
minimal=$cache/bookworm-minbase.tar
mkdir -p "$cache"

# debootstrap reads proxies only from the environment, so apt's proxies are exported for it.
eval "$(apt-config shell apt_http_proxy Acquire::http::Proxy apt_https_proxy Acquire::https::Proxy)"
export http_proxy="${http_proxy:-${apt_http_proxy:-}}" https_proxy="${https_proxy:-${apt_https_proxy:-}}"
[[ -n "$http_proxy" ]] || unset http_proxy
[[ -n "$https_proxy" ]] || unset https_proxy

make_minimal() {
  local mirror
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Component: main' | head -n 1)
  [[ -n "$mirror" ]] || die "apt on this machine has no source for bookworm main"
  echo "fresh_machine: making a minimal Debian 12 (once)"
  rm -rf "$cache/making"
  debootstrap --variant=minbase bookworm "$cache/making" "$mirror" >"$cache/debootstrap.log" 2>&1 ||
    { tail -n 5 "$cache/debootstrap.log" >&2; die "debootstrap failed, see $cache/debootstrap.log"; }
  rm -rf "$cache/making/var/cache/apt/archives/"*.deb
  tar -C "$cache/making" -cf "$minimal.part" .
  mv "$minimal.part" "$minimal"
  rm -rf "$cache/making"
}
[[ -f "$minimal" ]] || make_minimal

machine=$(mktemp -d "$cache/machine.XXXXXX")
cleanup() {
  if [[ $keep == yes ]]; then echo "fresh_machine: kept in $machine"; else rm -rf --one-file-system "$machine"; fi
}
trap cleanup EXIT
chmod 755 "$machine"
tar -C "$machine" -xf "$minimal"

# Copies what apt needs to reach the host's package sources: the configuration of apt, the host names and the certificates.
rm -rf "$machine/etc/apt"
cp -aL /etc/apt "$machine/etc/apt"
cp -aL /usr/share/keyrings/. "$machine/usr/share/keyrings/"
for file in /etc/resolv.conf /etc/hosts; do
  if [[ -e $file ]]; then cp -L "$file" "$machine$file"; fi
done
if [[ -d /etc/ssl/certs ]]; then mkdir -p "$machine/etc/ssl" && cp -rL /etc/ssl/certs "$machine/etc/ssl/" 2>/dev/null || true; fi

git clone -q --no-hardlinks --no-local "$root" "$machine/srv/canhil"
echo "fresh_machine: $(git -C "$machine/srv/canhil" log -1 --format='%h %s')"

pass_on=()
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
  if [[ -n "${!name:-}" ]]; then pass_on+=("$name=${!name}"); fi
done
# The command has its own mount and process namespaces: at its end, the kernel removes all its mounts and ends all its processes.
code=0
unshare --mount --pid --fork --kill-child bash -euc '
  machine=$1; shift
  mount -t proc proc "$machine/proc"
  mount --rbind /sys "$machine/sys"
  mount --rbind /dev "$machine/dev"
  mount -t tmpfs tmpfs "$machine/dev/shm"
  mount -t tmpfs tmpfs "$machine/run"
  exec chroot "$machine" /usr/bin/env -i "$@"
' fresh_machine "$machine" HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
  "${pass_on[@]}" bash -c 'cd /srv/canhil && exec "$@"' fresh_machine "$@" </dev/null || code=$?
echo "fresh_machine: '$*' exited with $code"
exit "$code"
