#!/bin/sh
# The first process in user-mode Linux: uml_init.sh DIR CWD. Creates the interfaces, runs DIR/command, writes the exit status of this command to DIR/status.
dir=$1
cwd=$2
die() { echo "canhil: cannot $*" >/dev/console; busybox poweroff -f; }

mount -t proc proc /proc || die "mount /proc"
mount -t sysfs sysfs /sys || die "mount /sys"
mkdir -p /dev/shm /dev/pts
mount -t tmpfs tmpfs /dev/shm
mount -t devpts devpts /dev/pts
ln -s /proc/self/fd /dev/fd
mount -t tmpfs tmpfs /run
mkdir "$dir/tmp" && mount --bind /tmp "$dir/tmp"
mount -t tmpfs tmpfs /tmp
case $cwd in /tmp/*) # if the caller's working directory is below /tmp, the guest must still see this directory
  top=${cwd#/tmp/}
  top=${top%%/*}
  mkdir "/tmp/$top" && mount --bind "$dir/tmp/$top" "/tmp/$top" || die "show $cwd"
  ;;
esac

modules=/usr/lib/uml/modules/$(uname -r)/kernel
for module in drivers/net/can/dev/can-dev net/can/can net/can/can-raw net/can/can-bcm net/can/can-gw drivers/net/can/vcan \
  net/sched/sch_tbf; do # sch_tbf slows an interface down, for tests of full queues
  insmod "$modules/$module.ko" || die "load $modules/$module.ko"
done
ip link set lo up
for i in vcan0 vcan1; do
  ip link add dev $i type vcan && ip link set $i mtu 72 && ip link set $i up || die "make $i"
done

for line in /dev/ttyS0 /dev/ttyS1; do stty raw -echo <$line; done
# The output of the command goes through pipes, because the serial lines are terminals and the command must not see a terminal.
mkfifo /run/out /run/err
cat /run/out >/dev/ttyS0 &
cat /run/err >/dev/ttyS1 &
setsid bash -c '. "$1/environment"; . "$1/command"' bash "$dir" </dev/null >/run/out 2>/run/err &
command=$!
wait $command
status=$?
kill -s KILL -- -$command 2>/dev/null # ends processes that the command left running: they would keep the pipes open
wait
echo $status >"$dir/status"
busybox poweroff -f
