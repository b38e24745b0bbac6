#!/bin/bash
# run.sh COMMAND...: runs COMMAND on a machine with vcan0 and vcan1 (mtu 72, so classic and FD). COMMAND has the directory and the environment of
# the caller. The exit status, stdout and stderr of run.sh are those of COMMAND. run.sh uses the first of these ways that works:
#   1. if this kernel has vcan: a separate network namespace, so that COMMAND does not disturb other runs or an existing vcan0;
#   2. user-mode Linux: a kernel as a process, with this machine's files (Debian: user-mode-linux kmod iproute2 busybox gcc).
#      /tmp, /run and /dev are private to the guest; one CPU.
# CANHIL_VCAN_WAY selects a way: kernel or uml. CANHIL_VCAN_TIMEOUT_S (default 600) is the time limit of user-mode Linux.
set -u
here=$(dirname "$(readlink -f "$0")")

say() { echo "vcan: $*" >&2; }
case "${1:-}" in -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "$0"; exit ;; esac
[ $# -gt 0 ] || { say "expected a command: run.sh COMMAND..."; exit 2; }

make_interfaces='ip link set lo up && for i in vcan0 vcan1; do
  ip link add dev $i type vcan && ip link set $i mtu 72 && ip link set $i up || exit 1; done'

kernel_namespace() { # prints the options with which unshare can make the interfaces on this machine
  [ "$(id -u)" = 0 ] && modprobe -qa vcan can-raw can-gw 2>/dev/null
  for options in --net "--net --map-root-user"; do
    if unshare $options sh -c "$make_interfaces" 2>/dev/null &&
      grep -q '^CAN_RAW' /proc/net/protocols 2>/dev/null; then echo "$options"; return 0; fi
  done
  return 1
}

in_kernel() {
  options=$(kernel_namespace) || return
  say "this kernel's, in a network namespace"
  exec unshare $options sh -c "($make_interfaces) && exec \"\$@\"" sh "$@"
}

in_uml() {
  missing=
  for tool in linux busybox ip insmod gcc; do command -v $tool >/dev/null || missing="$missing $tool"; done
  [ -z "$missing" ] || return
  dir=$(mktemp -d /var/tmp/canhil-vcan.XXXXXX)
  trap 'kill -KILL -- -$uml 2>/dev/null; rm -rf "$dir"' EXIT
  trap 'exit 130' INT TERM HUP
  uml=0
  gcc -O1 -shared -fPIC -o "$dir/xstate.so" "$here/uml_xstate.c" || { say "cannot build uml_xstate.c"; exit 2; }
  export -p >"$dir/environment"
  { printf 'cd %q && exec' "$PWD"; printf ' %q' "$@"; echo; } >"$dir/command"
  printf '#!/bin/sh\nexec sh %q %q %q\n' "$here/uml_init.sh" "$dir" "$PWD" >"$dir/init"
  chmod +x "$dir/init"

  # User-mode Linux makes its descriptors non-blocking. Therefore it gets pipes of its own, and the caller's stdout
  # stays blocking.
  mkfifo "$dir/out" "$dir/err"
  cat "$dir/out" & out=$!
  cat "$dir/err" >&2 & err=$!
  limit=${CANHIL_VCAN_TIMEOUT_S:-600}
  say "user-mode Linux"
  # Bench and target run in this one guest system. Without real-time priority, a busy host would stall the guest for
  # longer than a target may be silent. The guest is pinned to one processor of the host, because it cannot use more:
  # the guest has one processor, and at any time only one of its processes on the host runs, while the others wait.
  realtime="taskset -c $((RANDOM % $(nproc))) chrt -f 10"
  $realtime true 2>/dev/null || realtime="chrt -f 10"
  $realtime true 2>/dev/null || realtime=
  LD_PRELOAD="$dir/xstate.so" setsid $realtime timeout -k 5 "$limit" linux mem=512M root=/dev/root rootfstype=hostfs rootflags=/ rw \
    init="$dir/init" con=null con0=null,fd:5 ssl=null ssl0=null,fd:3 ssl1=null,fd:4 quiet \
    3>"$dir/out" 4>"$dir/err" 5>"$dir/console" >"$dir/boot" 2>&1 </dev/null &
  uml=$!
  wait $uml
  ended=$?
  kill -KILL -- -$uml 2>/dev/null # if the guest did not end by itself: each process of the guest is a process of the host
  wait $out $err
  if [ -s "$dir/status" ]; then exit "$(cat "$dir/status")"; fi
  if [ $ended = 124 ] || [ $ended = 137 ]; then say "given up after $limit s (CANHIL_VCAN_TIMEOUT_S): $*"; exit 124; fi
  say "user-mode Linux ended without running the command: $(cat "$dir/boot" "$dir/console" | grep -m1 -iE 'canhil|panic|fail|cannot')"
  exit 125
}

missing=
case ${CANHIL_VCAN_WAY:-any} in
  any) in_kernel "$@"; in_uml "$@" ;;
  kernel) in_kernel "$@" ;;
  uml) in_uml "$@" ;;
  *) say "CANHIL_VCAN_WAY: expected kernel or uml, not '$CANHIL_VCAN_WAY'"; exit 2 ;;
esac
say "no way to vcan: this kernel has none that this user may make, and user-mode Linux lacks:${missing:- (not asked for)}" \
  "(Debian: apt install user-mode-linux kmod iproute2 busybox gcc)"
exit 125
