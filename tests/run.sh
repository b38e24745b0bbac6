#!/usr/bin/env bash
# Builds and runs every test of the project; the last line is "N passed, N failed", the exit code 0 only when none failed.
#   bash tests/run.sh                 everything
#   bash tests/run.sh --quick         the optimised build and its tests, no sanitizers, no static checks
#   bash tests/run.sh --tidy          everything, and clang-tidy on every source: about ten minutes more on two cores
#   bash tests/run.sh --analyse       everything, and clang's static analyser on every source: about an hour more
#   bash tests/run.sh --fuzz          everything, and a short run of each fuzzer: what it finds need not be of the last change
#   bash tests/run.sh --only REGEX    the CTest cases whose name matches, in every configuration
# Counted: each CTest case in each configuration, each static check, and each build that fails.
# JUnit files and logs: build/results/.
set -uo pipefail
exec </dev/null
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
root=$PWD
results=$root/build/results

quick=no tidy=no analyse=no fuzz=no only=
while (($#)); do
  case "$1" in
    --quick) quick=yes ;;
    --tidy) tidy=yes ;;
    --analyse) analyse=yes ;;
    --fuzz) fuzz=yes ;;
    --only)
      only=${2:-}
      if [[ -z "$only" ]]; then echo "tests/run.sh: --only: expected a regular expression" >&2; exit 2; fi
      shift ;;
    -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/run.sh; exit ;;
    *) echo "tests/run.sh: unknown option '$1': expected --quick, --tidy, --analyse, --fuzz or --only REGEX" >&2; exit 2 ;;
  esac
  shift
done

# The same result from any shell: Debian's tools first, one locale, no settings of the caller's builds.
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:${PATH:-} LC_ALL=C.UTF-8
unset CXXFLAGS CPPFLAGS LDFLAGS CXX CC CMAKE_GENERATOR MAKEFLAGS DESTDIR LD_PRELOAD CDPATH
unset "${!GTEST_@}" "${!CTEST_@}"
jobs=$(nproc)
mkdir -p "$results" && rm -f "$results"/* || exit 2
if [[ ! -w "${HOME:-/nonexistent}" ]]; then export HOME=$root/build/home && mkdir -p "$HOME"; fi # for ccache

passed=0 failed=0 rows=()
finish() {
  printf '\n%-34s %7s %7s %8s\n' stage passed failed time
  ((${#rows[@]})) && printf '%s\n' "${rows[@]}"
  printf '\n%d passed, %d failed\n' "$passed" "$failed"
  exit $((failed > 0))
}
running= # process group of the ctest that runs
interrupted() {
  echo "tests/run.sh: interrupted" >&2
  if [[ -n "$running" ]]; then kill -TERM -- "-$running" 2>/dev/null; fi
  failed=$((failed + 1))
  finish
}
trap interrupted INT TERM HUP

stage() { # stage NAME FUNCTION...: runs it; it adds to passed and failed
  local name=$1 p=$passed f=$failed start=$SECONDS took
  shift
  printf '\n=== %s\n' "$name"
  "$@"
  took=$((SECONDS - start))
  rows+=("$(printf '%-34s %7d %7d %4d:%02d' "$name" $((passed - p)) $((failed - f)) $((took / 60)) $((took % 60)))")
}

one_check() { # one_check COMMAND...: counts as one
  if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

failure() { echo "FAILED: $*"; failed=$((failed + 1)); }

build() { # build PRESET [TARGET...]
  local preset=$1 log=$results/$1.build.log
  shift
  { cmake --preset "$preset" || cmake --fresh --preset "$preset"; } >"$log" 2>&1 ||
    { tail -n 20 "$log"; failure "configuring $preset"; return 1; }
  # -k 0: what still builds is still tested.
  if ! ninja -C "build/$preset" -j "$jobs" -k 0 "$@" 2>&1 | tee -a "$log"; then
    failure "building $preset"
  fi
}

run_ctest() { # run_ctest PRESET [CTEST OPTIONS...]
  local preset=$1 junit=$results/$1.xml code=0 counts
  shift
  setsid "${personality[@]}" ctest --test-dir "build/$preset" -j "$jobs" --timeout 300 --output-on-failure \
    --no-tests=ignore ${only:+-R "$only"} --output-junit "$junit" "$@" &
  running=$!
  wait "$running" || code=$?
  running=
  if ! counts=$(python3 tests/static/junit_counts.py "$junit"); then failure "no results of ctest for $preset"; return; fi
  local p f
  read -r p f <<<"$counts"
  passed=$((passed + p)) failed=$((failed + f))
  if ((code && !f)); then failure "ctest for $preset ended with $code"; fi
  if ((!p && !f)) && [[ -z "$only" ]]; then failure "no tests found for $preset"; fi
}
personality=()

optimised() { build default && run_ctest default; }

# Whether the sanitizers run here: some need fixed addresses (setarch -R), the leak checker needs ptrace.
probe_sanitizers() {
  local dir=$root/build/probe
  mkdir -p "$dir"
  printf 'int main(int n, char** v) { int* volatile p = new int(n); int r = *p - 1; if (n < 2) delete p; p = 0; return r * 0; }' >"$dir/probe.cpp"
  for kind in address thread; do
    g++ -fsanitize=$kind "$dir/probe.cpp" -o "$dir/$kind" || return
  done
  if ! { "$dir/address" && "$dir/thread"; } >/dev/null 2>&1; then
    personality=(setarch "$(uname -m)" -R)
    echo "sanitizers: addresses fixed by setarch -R, this kernel's layout is too random for them"
  fi
  leaks=1
  if ! "${personality[@]}" "$dir/address" leak 2>&1 | grep -q 'detected memory leaks'; then
    leaks=0
    echo "sanitizers: leaks are NOT checked, this machine does not let a process be traced"
  fi
  export ASAN_OPTIONS=detect_leaks=$leaks:detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1
  export UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1
}

address_sanitizer() {
  echo "address, leak and undefined-behaviour sanitizers on: unit, processes"
  echo "not under them: vcan and controller (a whole kernel runs in each test), papers (long runs of code that unit tests cover), static"
  build asan tests_unit tests_processes && run_ctest asan -L '^(unit|processes)'
}

thread_sanitizer() {
  echo "thread sanitizer on: what has threads (hil-target and hil-bench run have one thread each)"
  build tsan tests_threads && run_ctest tsan -L threads
}

fuzzers() {
  build fuzz tests_fuzz && run_ctest fuzz -L '^fuzz$'
}

if ! bash tests/setup/install.sh tests; then
  failure "installing packages"
  finish
fi

static=yes
if [[ $quick == yes || -n "$only" ]]; then static=no; fi
if [[ $static == yes ]]; then stage "clang-format" one_check bash tests/static/format.sh; fi
stage "optimised build, all tests" optimised
if [[ $quick == no ]]; then
  probe_sanitizers
  stage "address and UB sanitizers" address_sanitizer
  stage "thread sanitizer" thread_sanitizer
  if [[ $fuzz == yes ]]; then
    stage "fuzzing, a short run each" fuzzers
  else
    echo "not run: the fuzzers; bash tests/run.sh --fuzz runs them"
  fi
fi
# With clang-tidy a first run on two cores would take longer than the 45 minutes that it may.
if [[ $tidy == yes ]]; then
  stage "clang-tidy" one_check python3 tests/static/tidy.py build/default
elif [[ $static == yes ]]; then
  echo "not run: clang-tidy; bash tests/run.sh --tidy runs it"
fi
if [[ $analyse == yes ]]; then
  stage "clang static analyser" one_check python3 tests/static/tidy.py --each build/default
elif [[ $static == yes ]]; then
  echo "not run: clang's static analyser; bash tests/run.sh --analyse runs it"
fi
if [[ -n "$only" ]] && ((!passed && !failed)); then failure "no test matches '$only'"; fi
finish
