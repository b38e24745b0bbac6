# Runs a Slurm cluster on this machine until the shell that sources this file ends. It needs no service manager, uses only loopback addresses and free
# ports, keeps everything in one temporary folder, and runs as the current user.
#   cluster_start       sets $cluster (the folder) and SLURM_CONF; sbatch, squeue, ... then use this cluster
#   cluster_run         COMMAND...: runs the command; unlike in a plain call, the shell handles signals while the command runs
#   cluster_stop        ends all processes of the cluster and removes the folder; also called whenever the shell ends
#   cluster_processes   prints the ids of all processes of the cluster: daemons, steps, jobs. They are found by SLURM_CONF in their environment.

cluster_processes() {
  (
    unset SLURM_CONF # otherwise the search would also find its own processes
    grep -lzsxF "SLURM_CONF=$cluster/slurm.conf" /proc/[0-9]*/environ | cut -d/ -f3
  ) || true
}

cluster_fail() {
  echo "slurm cluster: $*" >&2
  tail -n 20 "$cluster"/*.log >&2
  exit 1
}

# cluster_daemon NAME COMMAND...: starts a daemon in the background, with a log of its own.
cluster_daemon() {
  local name=$1
  shift
  SLURM_CONF=$cluster/slurm.conf "$@" >"$cluster/$name.log" 2>&1 </dev/null &
}

# cluster_wait WHAT COMMAND...: repeats the command until it succeeds, for at most 60 s. WHAT is for the error message.
cluster_wait() {
  local what=$1 deadline=$((SECONDS + 60))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < deadline)) || cluster_fail "no $what within 60 s"
    sleep 0.1
  done
}

cluster_start() {
  cluster=$(mktemp -d)
  trap cluster_stop EXIT
  trap 'exit 129' HUP
  trap 'exit 130' INT
  trap 'exit 143' TERM
  # If the shell is killed without running its trap, the following process stops the cluster. It also ends when the
  # folder has been removed.
  setsid --fork bash -c 'source "$1"; cluster=$2
    while kill -0 "$3" && [[ -d "$cluster" ]]; do sleep 0.2; done; cluster_stop' \
    - "${BASH_SOURCE[0]}" "$cluster" $$ >/dev/null 2>&1 </dev/null
  mkdir "$cluster/state" "$cluster/spool"
  local user host ports
  user=$(id -un) host=$(uname -n | cut -d. -f1)
  ports=$(python3 -c 'import socket
s = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
print(*(x.getsockname()[1] for x in s))')
  cat >"$cluster/slurm.conf" <<EOF
ClusterName=canhil
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports% *}
SlurmdPort=${ports#* }
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$cluster/munge.socket
CredType=cred/munge
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
ReturnToService=2
SchedulerParameters=sched_min_interval=0,sched_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=5 State=UP
EOF
  mungekey --create --keyfile "$cluster/munge.key" || cluster_fail "mungekey failed"
  cluster_daemon munged munged --foreground --force --key-file "$cluster/munge.key" --socket "$cluster/munge.socket" \
    --pid-file "$cluster/munged.pid" --seed-file "$cluster/munged.seed" --log-file "$cluster/munged.log"
  cluster_wait "answer of munged" munge --socket "$cluster/munge.socket" --no-input
  cluster_daemon slurmctld slurmctld -D -f "$cluster/slurm.conf" -i
  cluster_daemon slurmd slurmd -D -f "$cluster/slurm.conf" -N "$host"
  export SLURM_CONF=$cluster/slurm.conf
  cluster_wait "idle node" eval '[[ $(sinfo --noheader --format %t) == idle ]]'
}

cluster_run() {
  "$@" &
  wait $!
}

cluster_stop() {
  trap - EXIT
  [[ -d "${cluster:-}" ]] || return 0
  local signal left
  for signal in TERM KILL; do
    for _ in {1..50}; do
      left=$(cluster_processes)
      if [[ -z "$left" ]]; then
        rm -rf "$cluster"
        return 0
      fi
      kill -s $signal $left 2>/dev/null || true
      sleep 0.1
    done
  done
  echo "slurm cluster: processes are left: $left" >&2
  return 1
}
