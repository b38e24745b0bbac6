#!/usr/bin/env bash
# Builds and runs the tests of the project. The last line is "N passed, N failed"; the exit code is 0 only if nothing failed.
#   bash tests/run.sh                 format and structure, every unit, property and process test, one pass over vcan
#   bash tests/run.sh --full          also the sanitizers, all of vcan, two emulated controllers, Slurm, the papers, the fuzzers
#   bash tests/run.sh --coverage      unit tests, process tests and the papers' pages, with line coverage of dbc, target and bench
#   bash tests/run.sh --tidy          with either of the first two: also clang-tidy on every source, about ten minutes
#   bash tests/run.sh --analyse       with either of the first two: also clang's static analyser on every source, about an hour
#   bash tests/run.sh --soak          with either of the first two: also five minutes of random flights against one target (tests/soak)
#   bash tests/run.sh --package       with --full: also installs the Debian package in a fresh Debian and flies with it (root, network; tests/package)
#   bash tests/run.sh --only REGEX    with any option: runs only the CTest cases whose name matches, in every configuration
# The totals count each CTest case in each configuration, each static check, and each failed build.
# The end of the output lists the checks that the mode did not run. JUnit files and logs: build/results/.
set -uo pipefail
exec </dev/null
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
root=$PWD
results=$root/build/results

usage() { echo "tests/run.sh: $*" >&2; exit 2; }
mode=default tidy=no analyse=no soak=no package=no only=
while (($#)); do
  case "$1" in
    --full | --coverage)
      if [[ $mode != default && $mode != "${1#--}" ]]; then usage "$1 excludes --$mode"; fi
      mode=${1#--} ;;
    --tidy) tidy=yes ;;
    --analyse) analyse=yes ;;
    --soak) soak=yes ;;
    --package) package=yes ;;
    --only)
      only=${2:-}
      if [[ -z "$only" ]]; then usage "--only: expected a regular expression"; fi
      shift ;;
    -h | --help) sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' tests/run.sh; exit ;;
    *) usage "unknown option '$1': expected --full, --coverage, --tidy, --analyse, --soak, --package or --only REGEX" ;;
  esac
  shift
done
if [[ $mode == coverage && $tidy$analyse$soak != nonono ]]; then usage "--coverage excludes --tidy, --analyse and --soak"; fi
if [[ $package == yes && $mode != full ]]; then usage "--package needs a full build, expected --full as well"; fi

# Makes the result independent of the caller's shell: Debian's tools come first in PATH, the locale is fixed, and the caller's
# build settings are removed.
export PATH=/usr/bin:/usr/sbin:/bin:/sbin:${PATH:-} LC_ALL=C.UTF-8
unset CXXFLAGS CPPFLAGS LDFLAGS CXX CC CMAKE_GENERATOR MAKEFLAGS DESTDIR LD_PRELOAD CDPATH
unset "${!GTEST_@}" "${!CTEST_@}" "${!GCOV_@}"
source tests/setup/progress.sh
jobs=$(nproc)
mkdir -p "$results" && rm -f "$results"/* || exit 2
if [[ ! -w "${HOME:-/nonexistent}" ]]; then export HOME=$root/build/home && mkdir -p "$HOME"; fi # ccache needs a writable home

passed=0 failed=0 rows=() alone=() not_run=()
finish() {
  printf '\n%-34s %7s %7s %8s\n' stage passed failed time
  ((${#rows[@]})) && printf '%s\n' "${rows[@]}"
  ((${#alone[@]})) && printf '\n' && printf 'passed only alone, not beside other tests: %s\n' "${alone[@]}"
  ((${#not_run[@]})) && printf '\n' && printf 'not run: %s\n' "${not_run[@]}"
  printf '\n%d passed, %d failed\n' "$passed" "$failed"
  exit $((failed > 0))
}
running= # process group of the running command
ahead=   # process group of a build that runs beside tests
interrupted() {
  progress_stop
  echo "tests/run.sh: interrupted" >&2
  for group in $running $ahead; do kill -TERM -- "-$group" 2>/dev/null; done
  if [[ -n "$ahead" ]]; then signal_session CONT "$ahead"; fi # run_alone may have stopped it, and a stopped process does not end
  failed=$((failed + 1))
  finish
}
trap interrupted INT TERM HUP

stage() { # stage NAME FUNCTION...: runs the function, which adds to passed and failed
  local name=$1 p=$passed f=$failed start=$SECONDS took
  shift
  printf '\n=== %s\n' "$name"
  "$@"
  took=$((SECONDS - start))
  rows+=("$(printf '%-34s %7d %7d %4d:%02d' "$name" $((passed - p)) $((failed - f)) $((took / 60)) $((took % 60)))")
}

one_check() { # one_check COMMAND...: counts the command as one check
  if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

failure() { echo "FAILED: $*"; failed=$((failed + 1)); }

logged() { # logged WHAT LOG COMMAND...: runs the command with its output in the log and its progress on the terminal; returns its exit code
  local what=$1 log=$2 code=0
  shift 2
  : >"$log"
  setsid "$@" >"$log" 2>&1 & # in the background, so that the shell handles an interruption at once
  running=$!
  progress_start "$what" "$log"
  wait "$running" || code=$?
  progress_stop
  running=
  return "$code"
}

# Compiles several sources as one, unless clang-tidy or gcov needs each source separately. In such a build, a later
# change of a source takes longer to compile; therefore the default mode does not change the setting of an existing build.
together=()
if [[ $mode == coverage || $tidy$analyse != nono ]]; then
  together=(-DCANHIL_TOGETHER=OFF)
elif [[ $mode == full || ! -e build/default/build.ninja ]]; then
  together=(-DCANHIL_TOGETHER=ON)
fi
configure() { # configure PRESET LOG
  { cmake --preset "$1" "${together[@]}" || cmake --fresh --preset "$1" "${together[@]}"; } >"$2" 2>&1 ||
    { tail -n 20 "$2"; failure "configuring $1"; return 1; }
}

build() { # build PRESET [TARGET...]
  local preset=$1 log=$results/$1.build.log
  shift
  configure "$preset" "$log" || return
  # With -k 0, ninja continues after errors, so that all targets that can be built are tested.
  if ! logged "building $preset" "$log" ninja -C "build/$preset" -j "$jobs" -k 0 "$@"; then
    progress_rest "$log"
    failure "building $preset"
  fi
}

run_ctest() { # run_ctest PRESET [CTEST OPTIONS...]
  local preset=$1 junit=$results/$1.xml log=$results/$1.ctest.log code=0 counts p f
  shift
  # One job more than cores: many tests run in real time or wait for a guest system, and leave their core idle.
  local way=()
  if [[ $preset != default ]]; then way=("${personality[@]}"); fi
  logged "testing $preset" "$log" "${way[@]}" ctest --test-dir "build/$preset" -j $((jobs + 1)) --timeout 300 \
    --output-on-failure --no-tests=ignore ${only:+-R "$only"} --output-junit "$junit" "$@" || code=$?
  progress_rest "$log"
  if ! counts=$(python3 tests/static/junit_counts.py "$junit"); then failure "no results of ctest for $preset"; return; fi
  read -r p f <<<"$counts"
  if ((f > 0 && f <= 5)); then run_alone "$preset"; fi
  passed=$((passed + p)) failed=$((failed + f))
  if ((code && !f)); then failure "ctest for $preset ended with $code"; fi
  if ((!p && !f)) && [[ -z "$only" ]]; then failure "no tests found for $preset"; fi
}
personality=()

# Runs failed tests once more, alone, also without the build that runs ahead, if they start programs: beside others, a flight in real time may get no
# processor for so long that the bench rightly judges nothing. Unit tests and static checks must pass the first time. finish() names each test that
# passed only alone.
run_alone() { # run_alone PRESET: changes p, f and code of run_ctest
  local junit=$results/$1.alone.xml log=$results/$1.alone.log numbers counts p2 f2
  # Numbers alone choose the tests: of tests chosen by label too, ctest -I counts only those with the label.
  numbers=$(comm -12 <(cut -d: -f1 "build/$1/Testing/Temporary/LastTestsFailed.log" | sort) \
    <(ctest --test-dir "build/$1" -N -LE "$(labelled 'unit|static|fuzz')" | numbers_of_tests) | paste -sd, -)
  if [[ -z "$numbers" ]]; then return; fi
  if [[ -n "$ahead" ]]; then signal_session STOP "$ahead"; fi
  logged "testing $1 again, alone" "$log" "${way[@]}" ctest --test-dir "build/$1" -I "0,0,0,$numbers" --timeout 300 --output-on-failure \
    --output-junit "$junit" || true
  if [[ -n "$ahead" ]]; then signal_session CONT "$ahead"; fi
  progress_rest "$log"
  if ! counts=$(python3 tests/static/junit_counts.py "$junit"); then return; fi
  read -r p2 f2 <<<"$counts"
  mapfile -t -O ${#alone[@]} alone < <(sed -nE "s/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+) .* Passed .*/\1 ($1)/p" "$log")
  p=$((p + p2)) f=$((f - p2))
  if ((!f)); then code=0; fi
}

# Sends a signal to all processes of a session. (Ninja gives each compiler a process group of its own.)
signal_session() { # signal_session SIGNAL SESSION
  local members
  mapfile -t members < <(awk -v session="$2" '{ pid = $1; sub(/^.*[)] /, ""); if ($4 == session) print pid }' /proc/[0-9]*/stat 2>/dev/null)
  kill -s "$1" -- "${members[@]}" 2>/dev/null || true
}

# The numbers of the tests that ctest -N lists, each once, sorted as text.
numbers_of_tests() { sed -n 's/^ *Test *#\([0-9]*\):.*/\1/p' | sort -u; }

# Prints a regular expression for ctest -L. A plus sign joins labels (tests/CMakeLists.txt): unit matches "unit+threads"; vcan does not match "vcan-full".
labelled() { echo "(^|[+])($1)([+]|$)"; }

optimised() { build default tests_unit tests_processes tests_vcan && run_ctest default -L "$(labelled 'static|unit|processes|vcan')"; }
optimised_all() {
  local code=0
  build default || code=$?
  if make_fifth; then build_ahead "$fifth" asan "${asan_targets[@]}"; fi
  if ((!code)); then run_ctest default; fi
}

# Checks whether the sanitizers work on this machine: some need fixed addresses (setarch -R), the leak checker needs ptrace.
probe_sanitizers() {
  local dir=$root/build/probe
  mkdir -p "$dir"
  printf 'int main(int n, char** v) { int* volatile p = new int(n); int r = *p - 1; if (n < 2) delete p; p = 0; return r * 0; }' >"$dir/probe.cpp"
  clang++ -fsanitize=address "$dir/probe.cpp" -o "$dir/address" && g++ -fsanitize=thread "$dir/probe.cpp" -o "$dir/thread" || return
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

# The tree for the address sanitizer: a copy of the project with a fifth estimator. So this stage also tests that adding an estimator breaks nothing.
fifth=$root/build/with_fifth
make_fifth() {
  local dbcgen=build/asan/dbc/codegen/dbcgen kit=docs/examples/kit/canhil_messages
  if ! python3 tests/fifth_estimator/add.py "$fifth"; then failure "making $fifth"; return 1; fi
  cd "$fifth" || return
  { build asan dbcgen && "$dbcgen" dbc/canhil.dbc --fd -o dbc/canhil-fd.dbc && "$dbcgen" dbc/canhil.dbc --c -o $kit.h &&
    "$dbcgen" dbc/canhil.dbc --python -o $kit.py; } || failure "the contract of $fifth"
  cd "$root" || exit 2
}

# While tests wait for real time or for guest systems, a part of the processors is idle. Therefore build_ahead begins the next build while tests
# run. The build has the lowest priority, both as a process and as a session (autogroup of the scheduler, if the kernel has autogroups).
build_ahead() { # build_ahead FOLDER PRESET TARGET...: builds the targets of a configured preset of the tree FOLDER, in the background
  setsid chrt --idle 0 bash -c '{ echo 19 >/proc/self/autogroup; } 2>/dev/null; exec ninja -C "$0" -j "$1" -k 0 "${@:2}"' \
    "$1/build/$2" "$jobs" "${@:3}" >"$results/$2.ahead.log" 2>&1 &
  ahead=$!
}
await_ahead() { # await_ahead PRESET
  progress_start "building $1" "$results/$1.ahead.log"
  wait "$ahead"
  progress_stop
  ahead=
}

asan_targets=(tests_input tests_processes tests_fuzz tests_fifth_estimator)
address_sanitizer() {
  echo "address, leak and undefined-behaviour sanitizers on: code that reads external input, and both programs; docs/ci.md lists the rest"
  echo "built with a fifth estimator in it (tests/fifth_estimator), in build/with_fifth"
  if [[ -z "$ahead" ]]; then return; fi # the copy of the project could not be made; this is already counted as a failure
  cd "$fifth" || return
  # With this sanitizer, a flight takes ten times as long. So of the process tests, those run that lead both programs through each kind of input,
  # command and flight once. The others fly the same code again, in real time, with other defects of the target, or with programs of others.
  local chosen=(
    'hil_programs[.](Set|RunMany|BadInput|BadFiles|BadBuses|Reports|Schedulability|Recording|Outputs?|Unrounded)[.]'
    'OutputsPassInLockstep/.*(los_closed_loop|wind_ekf|inflight_ssbl)"' 'hil_programs[.]Fd[.](TheWire|AScenario)' 'Bits[.]AReplayed'
    'program_checks[.].*(JudgesTheReport|IsRefused)' 'recorded_data[.]RecordedData' 'two_targets[.]'
    'Lies[.](TheCountsOfAnHonest|Garbage|OfAGroup)' 'Evidence[.](ErrorsAfter|CompareNotices)'
    'fault_programs[.]Faults[.](Of|WhatIsWrong)' 'faults_program[.]Faults[.](MatrixHas|TextAnd|BadInput)'
    'campaign_programs[.](Report|Export|Checks|Replay|Interrupted)[.]' 'CampaignBadInput[.](IsOneLine|WhatIsRead)' 'Divided.*/[(]3, 2'
    'Accept[.](StopsAt|BadInput)' 'Conformance[.]BadInput' 'KeepsEveryRule/(hil_target|los_rate|wind)'
    'Altered[.](AMapping|What|AStimulus|FaultsSpoil|ASample|AMessage|FaultsAffect|ADelay)' 'PassInLockstep/(auv|marine|odometer|hover)'
    'ClosedLoop[.](AnActuator|ADelayOf|LockstepHas|APlantThat|TheReport)' 'FmuLoop[.]AnFmu' 'ProgramLoop[.]AProgram' 'Pair[.](EachAnswers|WhatCannot)'
    'dbc_programs[.]' 'new_files[.]' 'partners[.]' 'live[.](Page|Batch)' 'other_tools_program[.]'
    'recordings_program[.](Check[.](With|ABar|Another)|Convert|Recorded|Decode|LogCompare)' 'IsJudgedAsItWasFlown/.*los'
  )
  local left_out='Partners[.](TheExample|AMagnetometer)|InRealTime'
  await_ahead asan
  # Builds what build_ahead has not built, and reports the errors.
  if build asan "${asan_targets[@]}"; then
    (cd "$root" && configure tsan "$results/tsan.ahead.log") && build_ahead "$root" tsan tests_threads
    # By number, because a regular expression of CTest has at most nine parentheses. With --only, all process tests with this name run.
    local numbers
    numbers=$({
      "${personality[@]}" ctest --test-dir build/asan -N -L "$(labelled 'input|fuzz|fifth_estimator')"
      "${personality[@]}" ctest --test-dir build/asan -N -L "$(labelled processes)" |
        grep -E "$(IFS='|' && echo "${chosen[*]}")" | grep -vE "$left_out"
    } | numbers_of_tests | sort -n | paste -sd, -)
    if [[ -n "$only" ]]; then
      run_ctest asan -L "$(labelled 'input|processes|fuzz|fifth_estimator')"
    else
      run_ctest asan -I "0,0,0,$numbers"
    fi
  fi
  cd "$root" || exit 2
}

thread_sanitizer() {
  echo "thread sanitizer on: code with threads (hil-target and hil-bench run have one thread each, with --live a second, whose queue is tested here)"
  if [[ -n "$ahead" ]]; then await_ahead tsan; fi
  build tsan tests_threads && run_ctest tsan -L "$(labelled threads)"
}

coverage() {
  find build/coverage -name '*.gcda' -delete 2>/dev/null # removes the counts of an earlier run
  export GCOV_ERROR_FILE=/dev/null # a process that cannot write gcov's counts would print a second line on stderr; tests expect one line
  # -E leaves out two tests that prevent the program from writing files: the process could not write gcov's counts either.
  # The time-out is longer, because long tests take twice as long with instrumentation and less optimisation.
  build coverage tests_unit tests_processes tests_pages &&
    run_ctest coverage --timeout 600 -L "$(labelled 'static|unit|processes|pages')" -E 'CampaignBadInput[.](FullDisk|ReadOnlyFolder)' &&
    python3 tests/static/coverage.py build/coverage | tee "$results/coverage.txt" || failure "no figures of coverage"
}

packages=tests
if [[ $tidy$analyse != nono ]]; then packages=tidy; fi
if [[ $mode != default ]]; then packages=$mode; fi
if ! bash tests/setup/install.sh "$packages"; then
  failure "installing packages"
  finish
fi

if [[ $mode != coverage && -z "$only" ]]; then stage "clang-format" one_check bash tests/static/format.sh; fi
case $mode in
  default)
    stage "optimised build, its tests" optimised
    not_run+=("address, undefined-behaviour and thread sanitizers, all of vcan, controllers, Slurm, papers, fuzzers: bash tests/run.sh --full") ;;
  full)
    probe_sanitizers
    stage "optimised build, all tests" optimised_all
    stage "address and UB sanitizers, fuzzers" address_sanitizer
    stage "thread sanitizer" thread_sanitizer ;;
  coverage)
    stage "coverage" coverage
    not_run+=("all tests that add no coverage, such as vcan: bash tests/run.sh, and bash tests/run.sh --full") ;;
esac
again="bash tests/run.sh$([[ $mode == full ]] && echo ' --full')"
if [[ $tidy == yes ]]; then
  stage "clang-tidy" one_check python3 tests/static/tidy.py build/default
elif [[ $mode != coverage ]]; then
  not_run+=("clang-tidy: $again --tidy")
fi
if [[ $analyse == yes ]]; then
  stage "clang static analyser" one_check python3 tests/static/tidy.py --each build/default
elif [[ $mode != coverage ]]; then
  not_run+=("clang's static analyser: $again --analyse")
fi
if [[ $package == yes ]]; then
  bash tests/setup/install.sh package || failure "installing packages"
  stage "Debian package" one_check bash tests/package/debian.sh build/default
elif [[ $mode != coverage ]]; then
  not_run+=("the Debian package in a fresh Debian: bash tests/run.sh --full --package")
fi
if [[ $soak == yes ]]; then
  stage "soak" one_check python3 tests/soak/soak.py build/default --minutes 5
elif [[ $mode != coverage ]]; then
  not_run+=("five minutes of random flights against one target: $again --soak")
fi
if [[ $mode != coverage ]]; then not_run+=("line coverage: bash tests/run.sh --coverage"); fi
if [[ -n "$only" ]]; then not_run+=("clang-format, and tests whose name does not match '$only': omit --only"); fi
if [[ -n "$only" ]] && ((!passed && !failed)); then failure "no test matches '$only'"; fi
finish
