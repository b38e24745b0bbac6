#!/usr/bin/env bash
# run.sh HIL_BENCH: runs the documented job array on a real Slurm, runs the same campaign in one process, and compares the two result files byte for
# byte.
set -euo pipefail
bench=$(realpath "$1")
root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../..")
export PATH=/usr/bin:/usr/sbin:/bin:/sbin LC_ALL=C.UTF-8
for program in munged mungekey slurmctld slurmd sbatch; do
  command -v $program >/dev/null || { echo "no $program: bash tests/setup/install.sh full installs it" >&2; exit 1; }
done
source "$root/tests/processes/slurm/cluster.sh"

fail() { echo "FAILED: $*" >&2; tail -n 5 "$cluster"/*.out >&2 || true; exit 1; }

cluster_start
cd "$cluster"
campaign=$root/bench/monte_carlo/quick.toml

# Exit code 1 means that a metric of the campaign failed its limit. This test does not judge metrics.
"$bench" campaign "$campaign" --threads 2 --out single.sqlite >single.out || [[ $? == 1 ]] || fail "the campaign in one process"
"$bench" campaign merge single_merged.sqlite single.sqlite

# Slurm numbers these tasks 3, 5, 7, 9; slurm_array.sh must number the shards 0, 1, 2, 3.
export HIL_BENCH=$bench
cluster_run timeout 200 sbatch --wait --array 3-9:2 --output "$cluster/task-%a.out" \
  "$root/docs/examples/slurm_array.sh" "$campaign" results || fail "the job array ended with $?"
[[ $(ls results) == $(printf 'quick-%d-of-4.sqlite\n' 0 1 2 3) ]] || fail "expected four shards, found: $(ls results)"
"$bench" campaign merge array.sqlite results/quick-*-of-4.sqlite
cmp array.sqlite single_merged.sqlite || fail "an array of 4 and one process differ"
[[ -n $(cluster_processes) ]] || fail "the search for processes of the cluster finds none while it runs"

cluster_stop
[[ ! -e "$cluster" && -z $(cluster_processes) ]] || { echo "FAILED: something of the cluster is left" >&2; exit 1; }
