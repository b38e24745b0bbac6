#!/usr/bin/env bash
# manual.sh PROGRAMS OUT VERSION: makes manual pages from the --help output of the programs in the folder PROGRAMS, and
# writes the pages to the folder OUT. The pages state the version VERSION.
set -euo pipefail
programs=$1 out=$2 version=$3
mkdir -p "$out"
page() { # page NAME COMMAND...
  local name=$1
  shift
  help2man --no-info --section 1 --version-string "canhil $version" --name "$("$@" --help | head -n 1)" --output "$out/$name.1" "$*"
}
export PATH=$programs:$programs/dbc/codegen:$PATH # with it, the manual pages show program names without a path
page hil-target hil-target
page dbcgen dbcgen
page hil-bench hil-bench
hil-bench --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' | while read -r command; do
  page "hil-bench-$command" hil-bench "$command" </dev/null
done
