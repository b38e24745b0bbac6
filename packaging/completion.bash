# Completes the subcommands and options of hil-bench and hil-target. They are read from the program's --help.
_canhil() {
  local current=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} word words
  local -a path=()
  # The subcommands on the command line; they precede all options.
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == [a-z]* ]] || break
    path+=("$word")
  done
  while ! words=$("$program" "${path[@]}" --help 2>/dev/null) && ((${#path[@]})); do unset 'path[-1]'; done
  if [[ $current == -* ]]; then
    words=$(grep -oE '^ +(-[a-z],)?--[a-z0-9-]+' <<<"$words" | grep -oE -- '--[a-z0-9-]+')
  else
    words=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' <<<"$words")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; [[ $current == -* ]] || compgen -f -- "$current")
}
complete -o filenames -F _canhil hil-bench hil-target
