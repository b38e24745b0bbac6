#!/usr/bin/env bash
# Runs a campaign on several machines with GNU parallel. Every machine needs hil-bench, hil-bench-campaign, the campaign file and the folder
# OUT under the same paths (a network file system):
#   docs/examples/gnu_parallel.sh CAMPAIGN.toml OUT SHARDS [--sshloginfile MACHINES]
# Without --sshloginfile it starts the processes on this machine, one per core at a time.
set -euo pipefail
campaign=${1:?expected a campaign file}
out=${2:?expected a folder for the results}
shards=${3:?expected the number of shards}
shift 3
seq 0 $((shards - 1)) | parallel --halt soon,fail=1 --workdir "$PWD" "$@" \
  "${HIL_BENCH:-hil-bench}" campaign "$campaign" --shard "{}/$shards" --threads 1 --out "$out" --resume
name=$(basename "$campaign" .toml)
"${HIL_BENCH:-hil-bench}" campaign merge "$out/$name.sqlite" "$out/$name"-*-of-"$shards.sqlite"
