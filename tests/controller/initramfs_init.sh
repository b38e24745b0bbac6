#!/bin/busybox sh
# The first process of the guest: mounts the host's files (9p, read-only) under a writable layer in memory,
# and runs guest.sh there.
/bin/busybox --install -s /bin
die() { echo "canhil: cannot $*" >/dev/console; poweroff -f; }
mount -t devtmpfs dev /dev
while read -r module; do insmod "/modules/$module" || die "load $module"; done </modules/order
mkdir -p /host /layer /new
mount -t 9p -o trans=virtio,version=9p2000.L,msize=524288,cache=loose,ro host /host || die "mount the machine's files"
mount -t tmpfs -o size=75% tmpfs /layer && mkdir /layer/upper /layer/work || die "mount a tmpfs"
mount -t overlay -o lowerdir=/host,upperdir=/layer/upper,workdir=/layer/work overlay /new || die "mount the overlay"
read -r guest </guest
read -r dir </dir
exec switch_root /new /bin/sh "$guest" "$dir"
