# Says how far a long command is, of which the output goes to a log. To be sourced.
#   progress_start WHAT LOG   from now on says "WHAT: 120 of 180 (1:05)": on a terminal one line that moves, else a line every 30 s
#   progress_stop             ends that; on a terminal the line goes away
#   progress_rest LOG         prints the log without the lines that only count: what failed, and what CTest says at its end
# Read from the log: Ninja's [n/m], CTest's cases, apt's packages. Said on the caller's stdout, which both calls must share.
progress_interval_s=30
progress_watcher=
export NINJA_STATUS='[%f/%t] ' # whatever the user's own is

progress_of() { # progress_of LOG: "120 of 180", or nothing when the log does not say
  awk '
    /^\[[0-9]+\/[0-9]+\] / { split(substr($1, 2), n, /[\/\]]/); state = n[1] " of " n[2] }
    /^ *[0-9]+\/[0-9]+ Test +#[0-9]+: / { split($1, n, "/"); state = n[1] " of " n[2] }
    match($0, /[0-9]+ newly installed/) { split(substr($0, RSTART), n, " "); packages = n[1] }
    packages && /^Get:[0-9]+ / { state = "fetched " ++fetched " of " packages }
    packages && /^Unpacking / { state = "unpacked " ++unpacked " of " packages }
    packages && /^Setting up / { state = "set up " ++ready " of " packages }
    END { if (state) print state }' "$1" 2>/dev/null
}

progress_watch() { # progress_watch WHAT LOG: until it is killed, or the shell that started it is gone
  local what=$1 log=$2 start=$SECONDS said=$SECONDS state now
  # The sleep holds no output open: who reads it to its end must not wait for a sleep.
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
