#!/bin/sh
# Instructions of one IMU step and one update: tests/perf/estimators/count_instructions.sh BUILD_DIR
set -eu
program=$1/tests/perf/estimators/estimators_instructions
out=$(mktemp)
trap 'rm -f "$out"' EXIT
for call in imu_step_reference imu_step_two_sample update_kalman update_robust_h2; do
  valgrind --tool=callgrind --toggle-collect="$call" --callgrind-out-file="$out" "$program" >/dev/null 2>&1
  printf '%-22s %s instructions\n' "$call" "$(sed -n 's/^summary: //p' "$out")"
done
