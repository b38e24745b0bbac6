#!/bin/sh
# Counts the instructions of one step of each estimator: tests/perf/estimators/count_instructions.sh BUILD_DIR
set -eu
out=$(mktemp)
trap 'rm -f "$out"' EXIT
count() { # count PROGRAM CALL...
  program=$1
  shift
  for call in "$@"; do
    valgrind --tool=callgrind --toggle-collect="$call" --callgrind-out-file="$out" "$program" >/dev/null 2>&1
    counted=$(sed -n 's/^summary: //p' "$out")
    if [ "${counted:-0}" -eq 0 ]; then
      echo "count_instructions.sh: callgrind counted nothing in $call() of $program" >&2
      exit 1
    fi
    printf '%-22s %s instructions\n' "$call" "$counted"
  done
}
folder=$1/tests/perf/estimators
count "$folder/estimators_instructions" imu_step_reference imu_step_two_sample update_kalman update_robust_h2 update_invariant update_considering
count "$folder/los_rate_instructions" step_switched_thermal step_switched_glint step_combined step_kalman step_low_pass
count "$folder/inflight_alignment_instructions" imu_step fix_ekf_15 fix_ekf_18 fix_ukf_15 fix_ukf_18 fix_sin_cos_16 fix_sin_cos_19 fix_correlated
count "$folder/wind_instructions" step_ekf step_h_infinity step_adaptive_q step_recommended
