#!/usr/bin/env bash
# A campaign on the machines of a list, with GNU parallel; every machine has hil-bench and hil-bench-campaign, the campaign and the folder OUT
# at the same place (a network file system):
#   docs/examples/gnu_parallel.sh CAMPAIGN.toml OUT SHARDS [--sshloginfile MACHINES]
# Without a list: processes of this machine, as many at a time as it has cores.
set -euo pipefail
campaign=${1:?expected a campaign file}
out=${2:?expected a folder for the results}
shards=${3:?expected the number of shards}
shift 3
seq 0 $((shards - 1)) | parallel --halt soon,fail=1 --workdir "$PWD" "$@" \
  "${HIL_BENCH:-hil-bench}" campaign "$campaign" --shard "{}/$shards" --threads 1 --out "$out" --resume
name=$(basename "$campaign" .toml)
"${HIL_BENCH:-hil-bench}" campaign merge "$out/$name.sqlite" "$out/$name"-*-of-"$shards.sqlite"
