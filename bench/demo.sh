#!/usr/bin/env bash
# Builds canhil and runs the 20 s transfer alignment in real time over the best bus that this machine has.
# Needs only Debian 12: missing packages are installed first. Exit code: 0 the outputs passed, 1 the outputs failed, 2 the set-up failed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
case "${1:-}" in
  '') ;;
  -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' bench/demo.sh; exit ;;
  *) echo "demo.sh: unknown option '$1': expected none, or --help" >&2; exit 2 ;;
esac
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:$PATH
source tests/setup/progress.sh
say() { echo "demo: $*" >&2; }

say "packages"
bash tests/setup/install.sh build >&2 || exit 2
say "building (some minutes the first time)"
mkdir -p build
: >build/demo.log
progress_start "demo: building" build/demo.log >&2
built=yes
{ { [[ -e build/default/build.ninja ]] || cmake --preset once; } && cmake --build build/default --target hil-bench hil-target; } >build/demo.log 2>&1 || built=no
progress_stop >&2
if [[ $built == no ]]; then
  progress_rest build/demo.log | tail -n 40 >&2
  say "the build failed; see build/demo.log"
  exit 2
fi

# vcan is the kernel's own CAN stack; the embedded bus is a substitute on machines without vcan.
choose_bus() {
  if [[ -d /sys/class/net/vcan0 ]]; then echo vcan0; return; fi
  if ((EUID == 0)) && { modprobe -q vcan 2>/dev/null || true; } && ip link add dev vcan0 type vcan 2>/dev/null; then
    ip link set vcan0 up && echo vcan0 && return
  fi
  echo local:
}
had_vcan=no
if [[ -d /sys/class/net/vcan0 ]]; then had_vcan=yes; fi
bus=$(choose_bus)
if [[ $bus == vcan0 && $had_vcan == no ]]; then trap 'ip link del vcan0' EXIT; fi
if [[ $bus == vcan0 ]]; then say "bus: vcan0"; else say "bus: embedded (this kernel has no vcan that this user may make)"; fi

# The bench's standard error is printed after the bench has ended, so that it does not interrupt the progress line.
say "flying 20 s in real time"
code=0
progress_start "demo: flying 20 s" /dev/null >&2
build/default/hil-bench run bench/flights/transfer_alignment.toml --bus "$bus" >build/demo.out 2>build/demo.err || code=$?
progress_stop >&2
cat build/demo.err >&2
cat build/demo.out
if ((code == 3)); then
  say "outputs passed; timing was not measured on this host, for the reason above"
  code=0
fi
exit $code
