#!/usr/bin/env bash
# Builds and runs every benchmark of tests/perf, prints the figures, and stores them with a description of the machine.
#   bash tests/perf/run.sh [BENCHMARK OPTIONS...]        e.g.  --benchmark_filter=unpack --benchmark_repetitions=5
# The results are in build/perf/DATE/: one PROGRAM.json and PROGRAM.txt for each *_benchmark (the "context" of the former contains processor,
# kernel, compiler and commit); machine.txt with the same description of the machine; one NAME.txt for each other program and for each count of
# instructions. `python3 tests/perf/page.py build/perf/DATE` puts them into docs/performance.md.
# At the end stands a table of all goals (goals.py). A goal that is not met does not change the exit code: it is 1 only if something did not build or run,
# or a figure of a goal is missing.
set -euo pipefail
exec </dev/null
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:${PATH:-} LC_ALL=C.UTF-8
bash tests/setup/install.sh full

build=build/measured
cmake --preset perf >/dev/null
ninja -C "$build" tests/perf/all hil-bench hil-target

commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
if [[ -n "$(git status --porcelain 2>/dev/null)" ]]; then commit+=-changed; fi
about=(
  "date=$(date -u +%Y-%m-%d)"
  "commit=$commit"
  "processors=$(nproc)"
  "load_before=$(cut -d' ' -f1-3 /proc/loadavg)"
  "compiler=$(c++ --version | head -n 1)"
  "build=$(sed -n 's/^CMAKE_BUILD_TYPE:[^=]*=//p' "$build/CMakeCache.txt")"
  "kernel=$(uname -sr)"
  "processor=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)"
  "memory_kib=$(sed -n 's/^MemTotal: *\([0-9]*\) kB/\1/p' /proc/meminfo)"
  "governor=$(cat /sys/devices/system/cpu/cpu0/cpufreq/scaling_governor 2>/dev/null || echo unknown)"
)
context=$(printf '%s,' "${about[@]//[,]/ }")
records=build/perf/$(date -u +%Y%m%dT%H%M%SZ)
mkdir -p "$records"
printf '%s\n' "${about[@]}" | tee "$records/machine.txt"

code=0
failed() { echo "tests/perf/run.sh: $1 failed" >&2; code=1; }
as_text() { # as_text NAME COMMAND...
  local name=$1
  shift
  printf '\n== %s\n' "$name"
  "$@" 2>&1 | tee "$records/$name.txt" || [[ $? == 3 ]] || failed "$name" # 3: not measured; the program printed the reason
}
while read -r program; do
  name=${program##*/}
  case $name in
    *_instructions | vcan_node | run_turnaround) ;; # started below: with callgrind, on vcan, or with real-time priority
    *_benchmark)
      printf '\n== %s\n' "$name"
      "$program" --benchmark_context="${context%,}" --benchmark_out="$records/$name.json" --benchmark_out_format=json "$@" 2>/dev/null |
        tee "$records/$name.txt" || failed "$name"
      if grep -q '"error_occurred": true' "$records/$name.json"; then failed "$name"; fi
      ;;
    *) as_text "$name" "$program" ;;
  esac
done < <(find "$build/tests/perf" -type f -perm -u+x | LC_ALL=C sort)
as_text ports_vcan tests/vcan/run.sh /usr/bin/python3 tests/perf/ports/vcan.py "$build/tests/perf/ports/vcan_node"
# Measures the turnaround with real-time priority, if permitted. In the first measurement all processes share one CPU:
# otherwise the time in which another CPU wakes up would hide the time that the target needs.
real_time=(chrt -f 30)
"${real_time[@]}" true 2>/dev/null || real_time=()
last_cpu=$(taskset -cp $$ | sed 's/.*[ ,-]//')
as_text turnaround "${real_time[@]}" taskset -c "$last_cpu" "$build/tests/perf/run/run_turnaround"
as_text turnaround_all_cpus "${real_time[@]}" "$build/tests/perf/run/run_turnaround"
as_text turnaround_vcan tests/vcan/run.sh "${real_time[@]}" "$build/tests/perf/run/run_turnaround" --bus vcan0 vcan1
as_text jitter /usr/bin/python3 tests/perf/run/jitter.py "$build/hil-bench"
as_text jitter_vcan tests/vcan/run.sh /usr/bin/python3 tests/perf/run/jitter.py "$build/hil-bench" 5 vcan0
as_text live /usr/bin/python3 tests/perf/run/live.py "$build/hil-bench"
as_text codec_instructions sh tests/perf/codec/count_instructions.sh "$build/tests/perf/codec/codec_instructions"
as_text estimators_instructions sh tests/perf/estimators/count_instructions.sh "$build"
as_text run_stages python3 tests/perf/run/stages.py "$build"
echo "load_after=$(cut -d' ' -f1-3 /proc/loadavg)" | tee -a "$records/machine.txt"
printf '\n== goals\n'
python3 tests/perf/goals.py "$records" | tee "$records/goals.txt" || failed goals
printf '\nrecorded in %s\n' "$records"
exit "$code"
