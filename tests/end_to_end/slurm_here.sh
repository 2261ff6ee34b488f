# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# A Slurm cluster of this machine only, for the duration of a test: on 127.0.0.1, with keys, state and logs in a folder.
export PATH=$PATH:/usr/sbin

hasSlurm() {
    local program
    for program in munged slurmctld slurmd sbatch srun squeue; do
        command -v "$program" >/dev/null || return 1
    done
}

# startSlurm FOLDER: starts it and sets SLURM_CONF for its commands. Fails if it does not start.
startSlurm() {
    local folder=$1 port=$((20000 + $$ % 10000 * 2)) user host
    user=$(id -un) host=$(hostname -s)
    mkdir -p "$folder/state" "$folder/spool"
    chmod a+x "$folder" # munged requires that all users can reach its socket
    (umask 077 && head -c 128 /dev/urandom >"$folder/munge.key")
    export SLURM_CONF=$folder/slurm.conf
    cat >"$SLURM_CONF" <<CONF
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=4096
SlurmdParameters=config_overrides
PartitionName=here Nodes=ALL Default=YES
CONF
    munged --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
        --log-file="$folder/munged.log" --seed-file="$folder/munge.seed" && slurmctld -c && slurmd || return 1
    for _ in $(seq 100); do
        sinfo -h -t idle 2>/dev/null | grep idle >/dev/null && return
        sleep 0.1
    done
    return 1
}

# stopSlurm FOLDER: stops its daemons.
stopSlurm() {
    local daemon
    for daemon in slurmd slurmctld munged; do
        [ ! -s "$1/$daemon.pid" ] || kill "$(cat "$1/$daemon.pid")" 2>/dev/null || true
    done
    for _ in $(seq 100); do
        [ -e "$1/slurmctld.pid" ] || [ -e "$1/slurmd.pid" ] || [ -e "$1/munged.pid" ] || return 0
        sleep 0.1
    done
}
