#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A real Slurm on this machine alone, with a few made-up nodes of one core.

Everything of it lies in one new folder and listens on ports that were free, so several checkouts
can have theirs at the same time. The daemons stay in the foreground as children of the process
that starts them and are told by the kernel to end with it, however it ends.

Use: with FakeCluster() as cluster: ..., or by hand
    fake_cluster.py [NODES]     starts one, opens a shell in it, and takes it down afterwards
"""
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
CLIENTS = ("sbatch", "squeue", "sinfo", "scontrol", "scancel")
SEARCH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


class Unavailable(Exception):
    """No Slurm can be started here; says why."""


def end_with_parent():
    PR_SET_PDEATHSIG = 1
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def free_ports(n):
    sockets = []
    for _ in range(n):
        s = socket.socket()
        s.bind(("127.0.0.1", 0))
        sockets.append(s)
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def can_name_hosts():
    """Whether a process may have a host name of its own: then nodes do not look like one machine."""
    done = subprocess.run(["unshare", "--uts", "hostname", "n1"], capture_output=True)
    return done.returncode == 0


CONFIG = """\
ClusterName=sturz
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
# cred_expire: a requeued job would otherwise wait two minutes before it starts again
AuthInfo=socket={base}/munge/socket,cred_expire=5
SlurmctldPidFile={base}/run/slurmctld.pid
SlurmdPidFile={base}/run/slurmd.%n.pid
SlurmctldLogFile={base}/log/slurmctld.log
SlurmdLogFile={base}/log/slurmd.%n.log
StateSaveLocation={base}/state
SlurmdSpoolDir={base}/spool.%n
# No control groups, no accounting: nothing of the machine is needed but its processes.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={base}/log/jobs.txt
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=300
KillWait=5
MinJobAge=600
MaxArraySize={max_array}
JobRequeue=1
PropagateResourceLimits=NONE
"""


class FakeCluster:
    def __init__(self, nodes=4, max_array=1001):
        self.names = [f"n{i}" for i in range(1, nodes + 1)]
        self.max_array = max_array
        self.base, self.children = None, {}

    def __enter__(self):
        if os.geteuid() != 0:
            raise Unavailable("Slurm's daemons need root here")
        absent = [p for p in DAEMONS + CLIENTS if not shutil.which(p, path=SEARCH)]
        if absent:
            raise Unavailable(f"not installed: {' '.join(absent)}")
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def environment(self, **more):
        return dict(os.environ, SLURM_CONF=str(self.config), PATH=SEARCH, **more)

    def start(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="sturz-slurm-"))
        self.base.chmod(0o711)
        for name in ("munge", "run", "log", "state", *(f"spool.{n}" for n in self.names)):
            (self.base / name).mkdir(mode=0o711)
        self.config = self.base / "slurm.conf"
        port, *node_ports = free_ports(1 + len(self.names))
        host = socket.gethostname().split(".")[0]
        text = CONFIG.format(host=host, port=port, base=self.base, max_array=self.max_array)
        for name, node_port in zip(self.names, node_ports):
            text += (f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={node_port} CPUs=1 "
                     f"RealMemory=8000 State=UNKNOWN\n")
        text += f"PartitionName=main Nodes={','.join(self.names)} Default=YES MaxTime=INFINITE State=UP\n"
        self.config.write_text(text)
        key = self.base / "munge/key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.daemon("munged", ["munged", "--foreground", "--force", f"--key-file={key}",
                               f"--socket={self.base}/munge/socket", f"--pid-file={self.base}/run/munged.pid",
                               f"--log-file={self.base}/log/munged.log", f"--seed-file={self.base}/munge/seed"])
        self.until(lambda: (self.base / "munge/socket").exists(), 10, "munged")
        self.daemon("slurmctld", ["slurmctld", "-D", "-c", "-f", str(self.config)])
        self.own_names = can_name_hosts()
        for name in self.names:
            words = ["slurmd", "-D", "-f", str(self.config), "-N", name]
            if self.own_names:
                words = ["unshare", "--uts", "sh", "-c", f'hostname {name} && exec "$@"', "sh", *words]
            self.daemon(name, words)
        self.until(lambda: self.ask("sinfo", "-h", "-t", "idle", "-o", "%D", check=False).strip()
                   == str(len(self.names)), 30, "slurmd")

    def daemon(self, name, words):
        log = open(self.base / "log" / f"{name}.out", "wb")
        self.children[name] = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                               env=self.environment(), start_new_session=True,
                                               preexec_fn=end_with_parent)

    def until(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            for name, child in self.children.items():
                if child.poll() is not None:
                    raise Unavailable(f"{name} ended: " + (self.base / "log" / f"{name}.out").read_text()[-500:])
            if time.monotonic() > end:
                raise Unavailable(f"{what} was not ready within {seconds} s")
            time.sleep(0.1)

    def ask(self, *words, check=True):
        done = subprocess.run(words, env=self.environment(), text=True, capture_output=True)
        if check and done.returncode != 0:
            raise RuntimeError(f"{words}: {done.stdout}{done.stderr}")
        return done.stdout

    def processes(self):
        """Process numbers of all that knows this cluster: its daemons, their helpers, jobs."""
        mark = f"SLURM_CONF={self.config}".encode()
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and int(entry.name) != os.getpid() \
                        and mark in (entry / "environ").read_bytes().split(b"\0"):
                    found.append(int(entry.name))
            except OSError:
                pass
        return found

    def stop(self):
        if self.base is None:
            return
        if "slurmctld" in self.children:
            self.ask("scancel", "--user=root", check=False)
            time.sleep(0.5)
        for child in reversed(self.children.values()):
            child.terminate()
        for child in self.children.values():
            try:
                child.wait(5)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()
        for pid in self.processes():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        shutil.rmtree(self.base, ignore_errors=True)
        self.base, self.children = None, {}


def by_hand():
    with FakeCluster(int(sys.argv[1]) if len(sys.argv) > 1 else 4) as cluster:
        print(cluster.ask("sinfo"), end="")
        print(f"SLURM_CONF={cluster.config}; the cluster ends with this shell")
        subprocess.run([os.environ.get("SHELL", "bash")], env=cluster.environment())


if __name__ == "__main__":
    try:
        by_hand()
    except Unavailable as why:
        sys.exit(f"no cluster: {why}")
