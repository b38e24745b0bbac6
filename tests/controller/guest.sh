#!/bin/sh
# guest.sh DIR: runs in the guest system, which sees the host's files. Creates can0 and can1, runs DIR/command, and
# writes the exit status of this command to the serial port "status".
dir=$1
export PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
die() { echo "canhil: cannot $*" >/dev/console; busybox poweroff -f; }

mount -t devtmpfs dev /dev || die "mount /dev"
mount -t proc proc /proc || die "mount /proc"
mount -t sysfs sysfs /sys || die "mount /sys"
mkdir -p /dev/shm /dev/pts
mount -t tmpfs tmpfs /dev/shm
mount -t devpts devpts /dev/pts
ln -s /proc/self/fd /dev/fd
mount -t tmpfs tmpfs /run

port() { # port NAME: prints the device of the virtual serial port NAME
  for one in /sys/class/virtio-ports/*; do
    if [ "$(cat "$one/name")" = "$1" ]; then echo "/dev/${one##*/}"; return; fi
  done
  die "find the port $1"
}
ip link set lo up
for i in can0 can1; do
  ip link set $i up type can bitrate "${CANHIL_CONTROLLER_BITRATE:-1000000}" || die "set up $i"
done

# Puts pipes between the command and the ports, so that the command's output is a pipe and not a serial port.
mkfifo /run/out /run/err
cat /run/out >"$(port out)" &
cat /run/err >"$(port err)" &
setsid bash -c '. "$1/environment"; . "$1/command"' bash "$dir" </dev/null >/run/out 2>/run/err &
command=$!
wait $command
status=$?
kill -s KILL -- -$command 2>/dev/null # ends processes that the command left running: they would keep the pipes open
wait
echo $status >"$(port status)"
busybox poweroff -f
