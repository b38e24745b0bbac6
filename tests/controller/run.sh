#!/usr/bin/env bash
# run.sh COMMAND...: runs COMMAND on a machine where can0 and can1 are two SJA1000 controllers (kvaser_pci) on one bus; both are up, at 1 Mbit/s.
# COMMAND has the directory and the environment of the caller. The exit status, stdout and stderr of run.sh are those of COMMAND.
# The machine is a PC that QEMU emulates in software, so no root rights are needed. The machine has Debian's kernel and
# drivers and sees the host's files; changes of files are discarded at the end. docs/controller.md describes
# what can be tested on the machine.
# Needs these packages of Debian: qemu-system-x86 busybox iproute2 gzip make gcc-12. apt downloads the kernel once (kernel.sh).
# CANHIL_CONTROLLER_TIMEOUT_S (default 600) is the time limit.
set -u
here=$(dirname "$(readlink -f "$0")")

say() { echo "controller: $*" >&2; }
[ $# -gt 0 ] || { say "expected a command: run.sh COMMAND..."; exit 2; }
missing=
for tool in qemu-system-x86_64 busybox ip gzip make gcc-12; do command -v $tool >/dev/null || missing="$missing $tool"; done
[ -z "$missing" ] || { say "missing:$missing (Debian: apt install qemu-system-x86 busybox iproute2 gzip make gcc-12)"; exit 125; }
kernel=$("$here/kernel.sh") || exit 125

dir=$(mktemp -d /var/tmp/canhil-controller.XXXXXX)
qemu=0
trap 'kill -KILL -- -$qemu 2>/dev/null; rm -rf "$dir"' EXIT
trap 'exit 130' INT TERM HUP
export -p >"$dir/environment"
{ printf 'cd %q && exec' "$PWD"; printf ' %q' "$@"; echo; } >"$dir/command"

# Builds the kernel module of the faulty wire (wire/canhil_wire.c). A command that needs the module loads it with insmod "$CANHIL_WIRE".
cp -r "$here/wire" "$dir/wire"
env -u MAKEFLAGS -u ARCH -u CROSS_COMPILE make -C "$kernel/build" M="$dir/wire" modules >"$dir/make" 2>&1 ||
  { say "cannot build wire/canhil_wire.c: $(grep -m1 -iE 'error|not found' "$dir/make")"; exit 125; }
echo "export CANHIL_WIRE=$dir/wire/canhil_wire.ko" >>"$dir/environment"

initramfs() { # packs the tree $dir/initramfs into $dir/initramfs.gz
  mkdir -p "$dir/initramfs"/{bin,dev,modules} || return
  cp "$(command -v busybox)" "$dir/initramfs/bin/busybox" || return
  local library
  for library in $(ldd "$(command -v busybox)" 2>/dev/null | grep -o '/[^ ]*'); do
    cp --parents -L "$library" "$dir/initramfs" || return
  done
  cp "$kernel"/modules/*.ko "$kernel/order" "$dir/initramfs/modules/" || return
  install -m 755 "$here/initramfs_init.sh" "$dir/initramfs/init" || return
  echo "$here/guest.sh" >"$dir/initramfs/guest"
  echo "$dir" >"$dir/initramfs/dir"
  (cd "$dir/initramfs" && find . | busybox cpio -o -H newc 2>/dev/null) | gzip -1 >"$dir/initramfs.gz"
}
initramfs || { say "cannot make the initramfs"; exit 125; }

mkfifo "$dir/out" "$dir/err"
cat "$dir/out" & out=$!
cat "$dir/err" >&2 & err=$!
ports=()
for name in out err status; do
  ports+=(-chardev "file,id=$name,path=$dir/$name" -device "virtserialport,chardev=$name,name=$name")
done
limit=${CANHIL_CONTROLLER_TIMEOUT_S:-600}
setsid timeout -k 5 "$limit" qemu-system-x86_64 -nodefaults -no-user-config -display none -no-reboot \
  -machine pc,accel=tcg -m 1024 -smp 1 -icount shift=1 \
  -kernel "$kernel/vmlinuz" -initrd "$dir/initramfs.gz" -append "console=ttyS0 quiet loglevel=3 panic=-1 mitigations=off" \
  -serial "file:$dir/console" -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
  -object can-bus,id=canbus0 -device kvaser_pci,canbus=canbus0 -device kvaser_pci,canbus=canbus0 \
  -device virtio-serial-pci "${ports[@]}" >"$dir/qemu" 2>&1 </dev/null &
qemu=$!
wait $qemu
ended=$?
# If QEMU did not start, nobody has opened the pipes for writing, and the two cat processes would wait forever for a
# writer. The next line opens the pipes and closes them. It opens them for reading and writing, because this does not
# block.
: <>"$dir/out" <>"$dir/err"
wait $out $err
if [ -s "$dir/status" ]; then exit "$(cat "$dir/status")"; fi
if [ $ended = 124 ] || [ $ended = 137 ]; then say "given up after $limit s (CANHIL_CONTROLLER_TIMEOUT_S): $*"; exit 124; fi
say "QEMU ended without running the command: $(cat "$dir/qemu" "$dir/console" 2>/dev/null | grep -m1 -iE 'canhil|panic|fail|cannot|qemu')"
exit 125
