# Shows the progress of a long command whose output goes to a log. Source this file.
#   progress_start WHAT LOG   starts to print "WHAT: 120 of 180 (1:05)": one updated line on a terminal, else a line every 30 s
#   progress_stop             stops printing; removes the line from a terminal
#   progress_rest LOG         prints the log without its progress lines, so that failures and CTest's summary remain
# The progress is read from the log: Ninja's [n/m], CTest's cases, apt's packages. progress_start and progress_stop must have the same stdout.
progress_interval_s=30
progress_watcher=
export NINJA_STATUS='[%f/%t] ' # overrides the user's setting

progress_of() { # progress_of LOG: "120 of 180", or nothing if the log shows no progress
  awk '
    /^\[[0-9]+\/[0-9]+\] / { split(substr($1, 2), n, /[\/\]]/); state = n[1] " of " n[2] }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { split($1, n, "/"); state = n[1] " of " n[2] }
    match($0, /[0-9]+ newly installed/) { split(substr($0, RSTART), n, " "); packages = n[1] }
    packages && /^Get:[0-9]+ / { state = "fetched " ++fetched " of " packages }
    packages && /^Unpacking / { state = "unpacked " ++unpacked " of " packages }
    packages && /^Setting up / { state = "set up " ++ready " of " packages }
    END { if (state) print state }' "$1" 2>/dev/null
}

progress_watch() { # progress_watch WHAT LOG: runs until it is killed or its parent shell has ended
  local what=$1 log=$2 start=$SECONDS said=$SECONDS state now
  # The sleep must not keep the output open, or a reader of the output would wait for it to end.
  while sleep 1 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
    if [[ ! -t 1 ]] && ((SECONDS - said < progress_interval_s)); then continue; fi
    said=$SECONDS
    state=$(progress_of "$log")
    printf -v now '%s%s (%d:%02d)' "$what" "${state:+: $state}" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60))
    if [[ -t 1 ]]; then printf '\r\033[K%s' "$now"; else echo "$now"; fi
  done
}

progress_start() {
  progress_watch "$@" 2>/dev/null &
  progress_watcher=$!
}

progress_stop() {
  [[ -n "$progress_watcher" ]] || return 0
  kill "$progress_watcher" 2>/dev/null || true
  wait "$progress_watcher" 2>/dev/null || true
  progress_watcher=
  if [[ -t 1 ]]; then printf '\r\033[K'; fi
}

progress_rest() {
  grep -avE '^-- |^\[[0-9]+/[0-9]+\] |^ninja: (Entering directory|no work)|^ +Start +[0-9]+: |^ *[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed ' \
    "$1" || true
}
