#!/bin/sh
# cluster.sh ISOROLL - the job scripts of examples/18_chaotic_share on a real Slurm of one machine: an array with its
# merging, and MPI; a time limit in the middle. It starts munged, slurmctld and slurmd with files and ports of its
# own, and stops them at the end. It needs root. If Debian's packages are missing, it installs them.
ISO_SOURCE=${ISO_SOURCE:-$(cd "$(dirname "$0")/.." && pwd)}
. "$ISO_SOURCE/tests/cli/lib.sh"
programs=$(dirname "$isoroll")

[ "$(id -u)" -eq 0 ] || impossible Slurm "a Slurm can be started by root alone"
[ -x "$programs/isoroll-mpi" ] || impossible Slurm "isoroll-mpi is not built"
command -v mpirun >/dev/null || impossible Slurm "mpirun is not installed"
PATH=$programs:$PATH:/usr/sbin
export PATH OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
if ! command -v slurmctld >/dev/null || ! command -v slurmd >/dev/null || ! command -v munged >/dev/null; then
    command -v apt-get >/dev/null || impossible Slurm "slurmctld, slurmd or munged is missing"
    apt-get update -qq >/dev/null 2>&1
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge >/dev/null 2>&1 ||
        impossible Slurm "slurm-wlm and munge cannot be installed"
fi

# --- a Slurm of one machine; it stops when this script ends, whichever way
daemons=
export SLURM_CONF="$work/slurm.conf" # before the trap: it must not reach another Slurm
stop_daemons() {
    scancel --user=root 2>/dev/null
    # shellcheck disable=SC2086 # a list
    [ -z "$daemons" ] || kill $daemons 2>/dev/null
    for pid in $daemons; do
        tries=0
        while kill -0 "$pid" 2>/dev/null && [ $tries -lt 50 ]; do sleep 0.1 && tries=$((tries + 1)); done
    done
    cd / && rm -rf "$work"
}
trap stop_daemons EXIT

host=$(hostname -s)
processors=$(nproc)
chmod 755 "$work"
mkdir state spool
dd if=/dev/urandom of=munge.key bs=1 count=1024 2>/dev/null
chmod 400 munge.key
cat >slurm.conf <<CONF
ClusterName=isoroll
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$((20000 + $$ % 20000))
SlurmdPort=$((40000 + $$ % 20000))
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=2
MpiDefault=none
ReturnToService=2
MinJobAge=600
KillWait=20
OverTimeLimit=0
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=$processors State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
munged --foreground --force --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munged.pid" \
    --log-file="$work/munged.log" --seed-file="$work/munge.seed" >munged.out 2>&1 &
daemons=$!
sleep 1
slurmctld -D -c -f "$SLURM_CONF" >slurmctld.log 2>&1 &
daemons="$daemons $!"
slurmd -D -f "$SLURM_CONF" -N "$host" >slurmd.log 2>&1 &
daemons="$! $daemons"

# within SECONDS COMMAND...: waits until the command succeeds
within() {
    tries=$((2 * $1))
    shift
    until "$@"; do
        [ $tries -gt 0 ] || return 1
        tries=$((tries - 1))
        sleep 0.5
    done
}
no_jobs() { list=$(squeue -h 2>/dev/null) && [ -z "$list" ]; }
waits() { list=$(squeue -h -t PENDING 2>/dev/null) && [ -n "$list" ]; }

ready() { sinfo -h -o %t 2>/dev/null | grep -q idle; }
within 30 ready || { tail -n 3 munged.out slurmctld.log slurmd.log; impossible Slurm "Slurm does not start here"; }

# --- the scripts as they are, with their own sweep at full length
mkdir jobs && cd jobs && cp "$ISO_SOURCE"/examples/18_chaotic_share/*.yaml "$ISO_SOURCE"/examples/18_chaotic_share/*.sbatch .
sed 's/turns: 1000/turns: 100/' sweep.yaml >short.yaml
sweep=$(length short.yaml sweep.yaml)
run 0 sweep "$sweep" -o plain.h5
array=$(sbatch --parsable array.sbatch "$sweep")
check "the array is taken" test -n "$array"
sbatch --dependency="afterany:$array" merge.sbatch >out 2>err || fail "the merge is not taken"
sbatch mpi.sbatch "$sweep" >out 2>err || fail "the job of MPI is not taken"
check "all jobs end" within 600 no_jobs
cat share.*.log merge.log mpi.log >err 2>/dev/null
check "array: five parts, merged: the bytes of a plain run" cmp share.h5 plain.h5
check "MPI: the bytes of a plain run" cmp share.mpi.h5 plain.h5

# --- as at a time limit: scancel sends the signal; the job goes back to the queue and ends at its second try
rm -f share.mpi.h5 mpi.log
sed 's/turns: 1000/turns: 2000/; s/starts: 100/starts: 20/' sweep.yaml >limit.yaml
printf 'chunk: 1\n' >>limit.yaml
run 0 sweep limit.yaml -o limit.h5
job=$(sbatch --parsable mpi.sbatch limit.yaml)
check "a limit: the job begins" within 60 test -s share.mpi.h5.csv.part
sleep 1
scancel --batch --signal=USR1 "$job"
check "a limit: the job is in the queue again" within 60 waits
check "a limit: the rows are kept" grep -q "stopped by SIGTERM or SIGUSR1: .* are in 'share.mpi.h5.csv.part'" mpi.log
sleep 3 # in the second in which it was stopped slurmd takes it for a job that was killed
scontrol update JobId="$job" StartTime=now # Slurm would let it wait for two minutes
check "a limit: the job ends" within 300 no_jobs
cp mpi.log err
check "a limit: the bytes of a plain run" cmp share.mpi.h5 limit.h5
finish
