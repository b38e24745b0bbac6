#!/usr/bin/env bash
# Runs a command under a kernel of its own that has CAN: Debian's user-mode Linux, on this machine's own files.
#   run.sh COMMAND...     in the current folder, as root of the guest; ends with the command's exit code, 125 if the guest failed
# The guest has the CAN modules loaded and vcan0, vcan1 up, an empty /tmp and /run, no other network, one processor.
set -euo pipefail
die() { echo "user_mode_linux: $*" >&2; exit 125; }
(($#)) || die "no command given, for example: candump -n 1 vcan0"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$here/../../.." && pwd)/build/user_mode_linux
modules=$(echo /usr/lib/uml/modules/*/kernel)
linux=/usr/bin/linux.uml
[[ -x $linux && -d $modules ]] || die "$linux and its modules are missing: apt-get install user-mode-linux"
[[ -x /usr/bin/busybox || -x /bin/busybox ]] || die "busybox is missing: apt-get install busybox"

mkdir -p "$build"
shim=$build/whole_xstate.so
if [[ ! $shim -nt $here/whole_xstate.cpp ]]; then
  made=$(mktemp "$build/shim.XXXXXX") # several may start at once
  g++ -std=c++20 -O2 -shared -fPIC -o "$made" "$here/whole_xstate.cpp" || die "cannot compile whole_xstate.cpp"
  mv "$made" "$shim"
fi

guest=$(mktemp -d "$build/guest.XXXXXX")
trap 'rm -rf "$guest"' EXIT
cat >"$guest/init" <<INIT
#!/bin/bash
PATH=/usr/sbin:/usr/bin:/sbin:/bin
mount -t proc proc /proc && mount -t sysfs sysfs /sys && mount -t tmpfs tmpfs /tmp && mount -t tmpfs tmpfs /run
mkdir -p /dev/shm && mount -t tmpfs tmpfs /dev/shm
for module in drivers/net/can/dev/can-dev net/can/can net/can/can-raw net/can/can-bcm net/can/can-gw drivers/net/can/vcan; do
  if [[ -e $modules/\$module.ko ]]; then insmod $modules/\$module.ko; fi
done
ip link set lo up
for bus in vcan0 vcan1; do ip link add dev \$bus type vcan && ip link set \$bus mtu 72 up; done
$(export -p | grep -v -E ' (PATH|LD_PRELOAD|TMPDIR|TMP|TEMP|PWD|OLDPWD)=')
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
cd $(printf %q "$PWD")
$(printf '%q ' "$@") </dev/null
echo \$? >$guest/code
busybox poweroff -f
INIT
chmod +x "$guest/init"

# The guest's memory is a file that is mapped executable: in /dev/shm where there is room, as tmpfs is fastest.
if (($(df --output=avail -k /dev/shm 2>/dev/null | tail -n 1 || echo 0) < 600000)); then export TMPDIR=$guest; fi
LD_PRELOAD=$shim "$linux" mem=512M root=/dev/root rootfstype=hostfs rootflags=/ rw init="$guest/init" \
  con=null con0=fd:0,fd:1 loglevel=1 </dev/null 2>"$guest/stderr" | sed -u '/^reboot: System halted/d' || true
if [[ ! -s $guest/code ]]; then
  tail -n 20 "$guest/stderr" >&2
  die "the guest ended before the command did"
fi
exit "$(cat "$guest/code")"
