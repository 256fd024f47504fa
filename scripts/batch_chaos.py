"""Batches under random disturbances, for scripts/measure_batch.

local(): two runners on a small disk of its own. Runners and tasks get SIGKILL and SIGTERM, the disk is filled and
emptied again, the clock of a runner jumps by hours. One of the runners has process numbers of its own and counts as
another machine. slurm(): array jobs get scancel and requeue, their runners and tasks SIGKILL, the node goes down and
comes back. While it lasts `status` is asked again and again, and what it tells is judged by what is on the disk.
"""
import collections
import os
import random
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

from batch_tools import call, checked, differences, done_files, equal, files, outputs, plan, status

CLOCK = "libfaketimeMT.so.1"
DISK_MIB = 96
JUMPS = ["-30d", "-7h", "-90m", "+0", "+20m", "+5h", "+2d"]
STALE_S = 300  # claims of other machines count as running for so long


class Watch:
    """Asks for the status and judges it."""

    def __init__(self, program, folder):
        self.program, self.folder, self.asked, self.wrong = program, folder, 0, []
        self.foreign_kills = []  # when runners of another machine were killed

    def ask(self, runners):
        before = len(done_files(self.folder))
        told = status(self.program, self.folder)
        after = len({Path(k).parent for k in outputs(self.folder)})
        now = time.monotonic()
        silent = sum(now - at < STALE_S + 1 for at in self.foreign_kills)
        self.asked += 1
        for is_right, what in (
                (told["done"] + told["running"] + told["failed"] + told["waiting"] == told["tasks"], "counts"),
                (told["abandoned"] <= told["waiting"], "abandoned"),
                (before <= told["done"] <= after, "done"),
                (told["running"] <= runners + silent, "running"),
                (all(self.is_killed(f) for f in told["failures"]), "failed")):
            if not is_right:
                self.wrong.append((what, told))
        return told

    @staticmethod
    def is_killed(failure):
        """Three kills of one task: the one reason to fail that there is here."""
        return failure["how"] == "signal" and failure["tries"] >= 3

    def verdict(self, clean):
        """After the last run: every output once and right, nothing left over."""
        told = status(self.program, self.folder)
        left = [p for p in files(self.folder) if re.search(r"\.tmp/|\.part$|/claims/", str(p))]
        complete = told["done"] == told["tasks"] == len(done_files(self.folder))
        for what, then in self.wrong[:3]:
            print(f"  status was wrong, {what}: {then}")
        for path in left[:10]:
            print(f"  left over: {path.relative_to(self.folder)}")
        for line in differences(self.folder, clean)[:10]:
            print(f"  {line}")
        return (f"outputs {'equal' if complete and equal(self.folder, clean) else 'DIFFERENT'}, {len(left)} files left "
                f"over, `status` wrong in {len(self.wrong)} of {self.asked} asks")


def children(process):
    try:
        return [int(p) for p in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
    except OSError:
        return []


def strike(process, number):
    try:
        os.kill(process, number)
        return True
    except ProcessLookupError:
        return False


class Disk:
    """A small disk; where mounting is not permitted, a folder that cannot be filled."""

    def __init__(self, folder):
        self.folder = folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        self.is_small = call("mount", "-t", "tmpfs", "-o", f"size={DISK_MIB}m", "tmpfs", folder).returncode == 0

    def fill(self):
        with open(self.folder / "ballast", "wb", buffering=0) as ballast:
            try:
                while True:
                    ballast.write(bytes(1 << 16))
            except OSError:
                pass

    def empty(self):
        (self.folder / "ballast").unlink(missing_ok=True)

    def close(self):
        if self.is_small:
            checked("umount", self.folder)


def clock_environment(file):
    """By libfaketime: only the clock of the day is false, not the steady one and not that of files."""
    library = next(Path("/usr/lib").glob(f"*/faketime/{CLOCK}"), None)
    if not library:
        return None
    file.write_text("+0")
    return {**os.environ, "LD_PRELOAD": str(library), "FAKETIME_TIMESTAMP_FILE": str(file), "FAKETIME_NO_CACHE": "1",
            "FAKETIME_DONT_FAKE_MONOTONIC": "1", "NO_FAKE_STAT": "1", "FAKE_UTIME": "1"}


def left_by_clocks():
    """What libfaketime leaves of processes that were killed."""
    return set(Path("/dev/shm").glob("*faketime_*"))


class Runner:
    """`batch run` with a false clock where there can be one, as of another machine where asked."""

    AWAY = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]

    def __init__(self, program, folder, environment, away):
        self.away = away
        words = [program, "batch", "run", folder, "--all", "--jobs", "1", "--stale", "1"]
        self.shell = subprocess.Popen([*(self.AWAY if away else []), *map(str, words)], env=environment,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def is_over(self):
        return self.shell.poll() is not None

    def process(self):
        return (children(self.shell.pid) or [None])[0] if self.away else self.shell.pid

    def strike(self, number):
        process = self.process()
        return process is not None and strike(process, number)

    def strike_task(self, number):
        return any([strike(task, number) for task in children(self.process() or 0)])

    def close(self):
        if not self.is_over():
            self.strike(signal.SIGTERM)
        try:
            self.shell.wait(20)
        except subprocess.TimeoutExpired:
            self.shell.kill()
            self.shell.wait()


class Local:
    def __init__(self, args, out, toml, draw):
        self.disk, self.draw, self.program = Disk(out / "disk"), draw, args.program
        self.folder = plan(self.program, toml, self.disk.folder)
        self.watch, self.clock = Watch(self.program, self.folder), out / "clock"
        self.environment = clock_environment(self.clock)
        self.can_be_away = call(*Runner.AWAY, "true").returncode == 0
        self.shared = left_by_clocks()
        self.runners, self.said, self.counts = [], collections.Counter(), collections.Counter()
        self.kinds = ["SIGKILL runner", "SIGTERM runner", "SIGKILL task", "SIGTERM task"]
        self.kinds += ["full disk"] * 2 if self.disk.is_small else []
        self.kinds += ["clock jump"] * 2 if self.environment else []

    def keep_running(self):
        """A runner here and one of another machine."""
        for runner in [r for r in self.runners if r.is_over()]:
            lines = runner.shell.stderr.read().strip().splitlines()
            self.said[lines[-1].replace(str(self.folder), "DIR") if lines else "killed"] += 1
            self.runners.remove(runner)
        for away in (False, True):
            if sum(r.away == away for r in self.runners) == 0 and (self.can_be_away or not away):
                self.runners.append(Runner(self.program, self.folder, self.environment, away))

    def disturb(self):
        kind, runner = self.draw.choice(self.kinds), self.draw.choice(self.runners)
        number = signal.SIGKILL if "KILL" in kind else signal.SIGTERM
        if kind == "full disk":
            self.full_disk()
        elif kind == "clock jump":
            self.clock.write_text(self.draw.choice(JUMPS))
        elif not (runner.strike_task(number) if "task" in kind else runner.strike(number)):
            return
        elif kind == "SIGKILL runner" and runner.away:
            self.watch.foreign_kills.append(time.monotonic())
        self.counts[kind] += 1

    def full_disk(self):
        self.disk.fill()
        time.sleep(self.draw.uniform(0.3, 1.5))
        self.watch.ask(len(self.runners))
        self.keep_running()  # on the full disk
        time.sleep(self.draw.uniform(0.1, 0.5))
        self.disk.empty()

    def close(self):
        for runner in self.runners:
            runner.close()
        self.disk.close()
        for path in left_by_clocks() - self.shared:
            path.unlink(missing_ok=True)

    def missing(self):
        out = [] if self.disk.is_small else ["no full disk: mount is not permitted"]
        out += [] if self.environment else ["no clock jumps: libfaketime is not there"]
        return out + ([] if self.can_be_away else ["no other machine: unshare is not permitted"])


def pace(draw, told, left, seconds):
    """Until the next disturbance, so that they spread over the batch."""
    return max(0.1, (told["tasks"] - told["done"]) * seconds / max(1, left) * draw.uniform(0.2, 1.4))


def local(args, out, toml, clean, seconds, count):
    chaos = Local(args, out, toml, random.Random(args.seed))
    try:
        told = chaos.watch.ask(0)
        while told["done"] < told["tasks"] and sum(chaos.counts.values()) < count:
            chaos.keep_running()
            time.sleep(pace(chaos.draw, told, count - sum(chaos.counts.values()), seconds))
            told = chaos.watch.ask(len(chaos.runners))
            chaos.disturb()
        for runner in chaos.runners:
            runner.close()
        checked(args.program, "batch", "run", chaos.folder, "--all", "--jobs", 2, "--again", "--stale", 1)
        for line, times in chaos.said.most_common():
            print(f"  {times} runners ended: {line}")
        return line_of("local runners", told["tasks"], chaos.counts, chaos.watch.verdict(clean), chaos.missing())
    finally:
        chaos.close()


class Slurm:
    def __init__(self, args, out, toml, draw, environment):
        shutil.rmtree(out / "slurm_chaos", ignore_errors=True)
        self.draw, self.program, self.environment = draw, args.program, environment
        self.folder = plan(self.program, toml, out / "slurm_chaos")
        self.watch, self.counts, self.submits = Watch(self.program, self.folder), collections.Counter(), 0
        self.node = self.ask("sinfo", "-h", "-N", "-o", "%N").split()[0]
        self.kinds = ["scancel"] * 2 + ["requeue"] * 3 + ["node down"] * 2 + ["SIGKILL runner", "SIGKILL task"]

    def ask(self, *command):
        return call(*command, env=self.environment).stdout

    def jobs(self, *states):
        """Numbers of elements of arrays, such as 12_3."""
        lines = self.ask("squeue", "-h", "-r", "-t", ",".join(states), "-o", "%i").split()
        return [line for line in lines if "_" in line]

    def keep_queued(self):
        """Submits what is left where the queue is empty; jobs that were requeued need not wait for two minutes."""
        for job in self.ask("squeue", "-h", "-r", "-t", "PENDING", "-o", "%i %r").splitlines():
            if job.endswith(" BeginTime"):
                call("scontrol", "update", f"JobId={job.split()[0]}", "StartTime=now", env=self.environment)
        if not self.ask("squeue", "-h").strip():
            call(self.program, "batch", "submit", self.folder, "--slurm", "--chunk-minutes", "0.1",
                 env=self.environment)
            self.submits += 1

    def disturb(self):
        kind, running = self.draw.choice(self.kinds), self.jobs("RUNNING")
        if not running:
            return
        job = self.draw.choice(running)
        if kind == "node down":
            self.node_down()
        elif kind == "scancel":
            checked("scancel", job, env=self.environment)
        elif kind == "requeue":
            if call("scontrol", "requeue", job, env=self.environment).returncode:
                return
        elif not self.kill(kind):
            return
        self.counts[kind] += 1

    def node_down(self):
        update = ["scontrol", "update", f"NodeName={self.node}"]
        checked(*update, "State=DOWN", "Reason=chaos", env=self.environment)
        time.sleep(self.draw.uniform(0.2, 2))
        self.watch.ask(os.cpu_count())
        for _ in range(60):  # it may have come back by itself
            call(*update, "State=RESUME", env=self.environment)
            if "down" not in self.ask("sinfo", "-h", "-N", "-o", "%t"):
                return
            time.sleep(0.5)

    def kill(self, kind):
        claims = status(self.program, self.folder)["runningTasks"]
        runners = [c["process"] for c in claims if self.is_ours(c["process"])]
        if not runners:
            return False
        runner = self.draw.choice(runners)
        if kind == "SIGKILL runner":
            return strike(runner, signal.SIGKILL)
        return any([strike(task, signal.SIGKILL) for task in children(runner)])

    def is_ours(self, process):
        try:
            return str(self.folder).encode() in Path(f"/proc/{process}/cmdline").read_bytes()
        except OSError:
            return False

    def finish(self):
        """Without disturbances, until all is done."""
        for _ in range(600):
            if self.watch.ask(os.cpu_count())["waiting"] == 0 and not self.jobs("RUNNING", "PENDING", "COMPLETING"):
                return
            self.keep_queued()
            time.sleep(1)


def slurm(args, out, toml, clean, seconds, count, environment):
    chaos = Slurm(args, out, toml, random.Random(args.seed), environment)
    told = chaos.watch.ask(0)
    while told["done"] < told["tasks"] and sum(chaos.counts.values()) < count:
        chaos.keep_queued()
        time.sleep(pace(chaos.draw, told, count - sum(chaos.counts.values()), seconds))
        told = chaos.watch.ask(os.cpu_count())
        chaos.disturb()
    chaos.finish()
    call("scancel", "--me", env=environment)
    verdict = chaos.watch.verdict(clean)
    return line_of(f"Slurm, {chaos.submits} times submitted", told["tasks"], chaos.counts, verdict, [])


def line_of(who, tasks, counts, verdict, missing):
    kinds = ", ".join(f"{n} {kind}" for kind, n in sorted(counts.items()))
    return "; ".join([f"- {tasks} tasks by {who}, {sum(counts.values())} disturbances ({kinds}): {verdict}", *missing])
