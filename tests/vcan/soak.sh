#!/bin/bash
# soak.sh PROGRAM SECONDS [FRAMES_PER_S]: runs the soak test (soak.cpp; PROGRAM is build/default/tests/vcan/vcan_soak) on vcan0, which run.sh
# provides.
set -u
[ $# -ge 2 ] && [ "$2" -gt 0 ] || { echo "soak.sh: expected PROGRAM SECONDS [FRAMES_PER_S]" >&2; exit 2; }
CANHIL_VCAN_TIMEOUT_S=$(($2 + 120))
export CANHIL_VCAN_TIMEOUT_S
exec "$(dirname "$(readlink -f "$0")")/run.sh" "$1" vcan0 "${@:2}"
