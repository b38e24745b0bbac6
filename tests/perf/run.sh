#!/usr/bin/env bash
# Builds and runs every benchmark of tests/perf, prints the figures, and records them with what they were measured on.
#   bash tests/perf/run.sh [BENCHMARK OPTIONS...]        e.g.  --benchmark_filter=check --benchmark_repetitions=5
# Records: build/perf/DATE/PROGRAM.json, whose "context" holds processor, kernel, compiler and commit.
# Figures, no verdict: exit code 1 only when something did not build or run.
set -euo pipefail
exec </dev/null
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:${PATH:-} LC_ALL=C.UTF-8
bash tests/setup/install.sh build

build=build/default
cmake --preset default >/dev/null
rm -rf "$build/perf" # no benchmark that the sources no longer have
ninja -C "$build" tests_perf

commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
if [[ -n "$(git status --porcelain 2>/dev/null)" ]]; then commit+=-changed; fi
about=(
  "commit=$commit"
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
code=0
for program in "$build"/perf/*; do
  printf '\n== %s\n' "${program##*/}"
  "$program" --benchmark_context="${context%,}" --benchmark_out="$records/${program##*/}.json" \
    --benchmark_out_format=json "$@" || { echo "tests/perf/run.sh: ${program##*/} failed" >&2; code=1; }
  grep -q '"error_occurred": true' "$records/${program##*/}.json" && code=1
done
printf '\nrecorded in %s\n' "$records"
exit "$code"
