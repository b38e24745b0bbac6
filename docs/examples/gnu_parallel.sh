#!/usr/bin/env bash
# Runs a campaign on several machines with GNU parallel. On every machine, hil-bench, hil-bench-campaign, the campaign file and the folder
# OUT must have the same paths, for example on a network file system:
#   docs/examples/gnu_parallel.sh CAMPAIGN.toml OUT SHARDS [--sshloginfile MACHINES]
# Without --sshloginfile all processes run on this machine, as many at a time as the machine has cores.
set -euo pipefail
campaign=${1:?expected a campaign file}
out=${2:?expected a folder for the results}
shards=${3:?expected the number of shards}
shift 3
seq 0 $((shards - 1)) | parallel --halt soon,fail=1 --workdir "$PWD" "$@" \
  "${HIL_BENCH:-hil-bench}" campaign "$campaign" --shard "{}/$shards" --threads 1 --out "$out" --resume
name=$(basename "$campaign" .toml)
"${HIL_BENCH:-hil-bench}" campaign merge "$out/$name.sqlite" "$out/$name"-*-of-"$shards.sqlite"
