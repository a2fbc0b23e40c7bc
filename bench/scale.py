"""What many machines bring: a model of parts, fitted on this machine, held against runs that it was not fitted to, and asked
about clusters. `python bench/scale.py check` and `python bench/scale.py cluster`, after `cargo build --release`.

Needs nothing but Python. All times are processor time of `tracer`, on a machine that others use, too; a part has one thread.
The formulas stand in `docs/scale.md`.
"""

import argparse
import heapq
import json
import math
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRACER = os.environ.get("TRACER", str(ROOT / "target/release/tracer"))
SIZE = 512
SAMPLES = 64
# Numbers of parts that the model is fitted to, and those that it predicts.
FITTED = (1, 2, 4, 8)
PREDICTED = (16, 32)
WORKERS = 2


def processor(arguments):
    """Seconds of the processor that `tracer` takes, its threads and the system's work for it included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([TRACER, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if run.returncode:
        sys.exit(f"tracer {' '.join(arguments)}: {run.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


class Parts:
    """Renders parts of a scene, and keeps what each took."""

    def __init__(self, scene, split, samples=SAMPLES, size=SIZE):
        self.scene, self.split, self.samples, self.size = scene, split, samples, size
        self.folder = tempfile.TemporaryDirectory()

    def file(self, k, n):
        return pathlib.Path(self.folder.name, f"{k}of{n}.tracer")

    def seconds(self, k, n):
        settings = ["--size", f"{self.size}x{self.size}", "--samples", str(self.samples), "--split", self.split]
        name = ["--part", f"{k}/{n}", "-o", str(self.file(k, n))]
        return processor(["render", self.scene, *settings, *name, "-j", "1", "--quiet"])

    def all(self, n):
        return [self.seconds(k, n) for k in range(1, n + 1)]

    def merged(self, n):
        """Seconds to merge n parts, the least of some runs, and their bytes."""
        files = [self.file(k, n) for k in range(1, n + 1)]
        out = str(pathlib.Path(self.folder.name, "out.pfm"))
        seconds = min(processor(["merge", *map(str, files), "-o", out]) for _ in range(5))
        return seconds, sum(file.stat().st_size for file in files)


def fit(points):
    """Least squares of y over the numbers x of each point (x, y), each by the inverse of y: what counts is the relative error."""
    count = len(points[0][0])
    rows = [
        [sum(x[i] * x[j] / y**2 for x, y in points) for j in range(count)] + [sum(x[i] / y for x, y in points)]
        for i in range(count)
    ]
    for i in range(count):
        rows[i] = [each / rows[i][i] for each in rows[i]]
        for j in range(count):
            if j != i:
                rows[j] = [a - rows[j][i] * b for a, b in zip(rows[j], rows[i])]
    return [row[-1] for row in rows]


def costs(k, n, split):
    """What the k-th of n parts pays for: its start, its share of the work, and passes (by samples; each has a guide of
    its own and ends at a power of two) or borders (by rows; blocks across them are done by both)."""
    if split == "rows":
        return 1, 1 / n, (k > 1) + (k < n)
    first, end = SAMPLES * (k - 1) // n, SAMPLES * k // n
    return 1, 1 / n, sum(1 for p in range(-1, 32) if first < 2 ** (p + 1) and int(2**p) < end)


def merging(merges, size):
    """Seconds to merge parts of so many bytes, from (seconds, bytes) of others: what the picture takes, and a rate. Parts by
    rows have the same bytes together, however many there are, and tell no rate."""
    sizes = [each for _, each in merges]
    if max(sizes) < 1.5 * min(sizes):
        return sum(seconds for seconds, _ in merges) / len(merges)
    start, per_byte = fit([((1, each), seconds) for seconds, each in merges])
    return start + per_byte * size


def makespan(seconds, workers):
    """When the last part is done where each worker takes the next part as soon as it is free."""
    free = [0.0] * workers
    for each in seconds:
        heapq.heappush(free, heapq.heappop(free) + each)
    return max(free)


def compare(what, predicted, found, failures):
    off = predicted / found - 1
    print(f"  {what}: predicted {predicted:.2f} s, found {found:.2f} s, off by {100 * off:+.1f} %", flush=True)
    if abs(off) > 0.15:
        failures.append(what)


def check(scenes):
    failures = []
    for scene in scenes:
        for split in ("samples", "rows"):
            name = f"{pathlib.Path(scene).stem}, parts by {split}"
            print(name, flush=True)
            parts = Parts(scene, split)
            points, merges = [], []
            for n in FITTED:
                points += [(costs(k + 1, n, split), seconds) for k, seconds in enumerate(parts.all(n))]
                merges.append(parts.merged(n))
            start, work, more = fit(points)
            each = "pass" if split == "samples" else "border"
            print(f"  a part of 1/n: {start:.3f} s + {work:.2f} s / n + {more:.3f} s a {each}")
            for n in PREDICTED:
                predicted = [sum(map(math.prod, zip((start, work, more), costs(k, n, split)))) for k in range(1, n + 1)]
                found = parts.all(n)
                compare(f"{n} parts, all", sum(predicted), sum(found), failures)
                at_once = [makespan(seconds, WORKERS) for seconds in (predicted, found)]
                compare(f"{n} parts on {WORKERS} machines", *at_once, failures)
                seconds, size = parts.merged(n)
                compare(f"{n} parts merged", merging(merges, size), seconds, failures)
    # A scene of which nothing is known but a pilot: few samples, which cost minutes where the picture costs days.
    for scene in scenes:
        pilot = {n: Parts(scene, "samples", samples=n).seconds(1, 1) for n in (2, 8)}
        each = (pilot[8] - pilot[2]) / 6
        start = pilot[2] - 2 * each
        print(f"{pathlib.Path(scene).stem} from a pilot of 2 and 8 samples: {start:.3f} s + {each:.3f} s a sample")
        found = Parts(scene, "samples").all(16)
        compare("its 16 parts, all", 16 * start + SAMPLES * each, sum(found), failures)
    if failures:
        sys.exit(f"off by more than 15 %: {', '.join(failures)}")


def cluster_run(random_, nodes, parts, at):
    """Seconds until the last part is there, and which share of the nodes' time went into samples.

    A machine takes the next part as soon as it is free. It reads the scene's files through a file system that all share,
    renders at its own speed, dies now and then and is replaced; whoever goes on has the film of at most `every` seconds
    before."""
    work, start, bytes_read, bytes_part = at.work, at.start, at.read, at.part
    speed = [math.exp(random_.gauss(0, at.spread)) for _ in range(nodes)]
    free = [(random_.uniform(0, at.queue), node) for node in range(nodes)]
    heapq.heapify(free)
    # Each reads with its share of the file system, and never faster than its own link.
    rate = min(at.link, at.shared / min(nodes, parts))
    last = 0.0
    for _ in range(parts):
        now, node = heapq.heappop(free)
        left = work / parts / speed[node]
        while True:
            now += bytes_read / rate + start / speed[node]
            dies = random_.expovariate(1 / at.lives)
            if dies >= left:
                break
            # What was done since the last film is lost; whoever goes on starts anew, and reads the film.
            left -= dies - min(dies, random_.uniform(0, at.every))
            now += dies + at.requeue
        now += left + bytes_part / rate
        last = max(last, now)
        heapq.heappush(free, (now, node))
    return last, work / (nodes * last)


def merging_time(parts, at):
    """Seconds to merge so many parts by one machine, and by as many as their root first, the longer of the two rounds twice."""
    of = lambda count: at.merge_start + count * at.part / min(at.link, at.merge)
    return of(parts), 2 * of(math.ceil(math.sqrt(parts)))


def cluster(at):
    print(f"work {at.work / 3600:.0f} h of one node, files {at.read / 1e9:.1f} GB, a part {at.part / 1e6:.0f} MB\n")
    print("| nodes | parts | rendered, h | merged at once, min | in two steps, min | speed-up | of it in samples |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for nodes in (1, 4, 16, 64, 256, 1000):
        for parts in (nodes, 4 * nodes, 16 * nodes):
            runs = [cluster_run(random.Random(seed), nodes, parts, at) for seed in range(at.runs)]
            seconds, share = (sorted(run[k] for run in runs)[len(runs) // 2] for k in range(2))
            at_once, in_steps = merging_time(parts, at)
            speed_up = at.work / (seconds + min(at_once, in_steps))
            print(
                f"| {nodes} | {parts} | {seconds / 3600:.2f} | {at_once / 60:.1f} | {in_steps / 60:.1f} | "
                f"{speed_up:.0f} | {100 * share:.0f} % |",
                flush=True,
            )


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = options.add_subparsers(dest="command", required=True)
    checked = commands.add_parser("check", help="fits the model to 1, 2, 4, 8 parts and predicts 16 and 32")
    checked.add_argument("scene", nargs="*", help="scenes; figure 4 and the cat planet where none is given")
    asked = commands.add_parser("cluster", help="simulates clusters of 1 to 1000 nodes")
    number = lambda name, default, text: asked.add_argument(f"--{name}", type=float, default=default, help=f"{text} [{default:g}]")
    number("work", 7 * 86400, "seconds that one node takes for all samples")
    number("start", 20, "seconds to read, compile and build")
    number("read", 2e9, "bytes of the scene's files")
    number("part", 4e8, "bytes of a part")
    number("shared", 5e9, "bytes a second that the file system gives all")
    number("link", 1e9, "bytes a second that it gives one")
    number("merge", 5e8, "bytes a second that merge reads")
    number("merge_start", 10, "seconds of merge beside")
    number("spread", 0.1, "standard deviation of the logarithm of nodes' speeds")
    number("queue", 300, "seconds until the last node starts")
    number("lives", 30 * 86400, "mean seconds until a node dies")
    number("requeue", 120, "seconds until another takes its place")
    number("every", 60, "seconds between films")
    asked.add_argument("--runs", type=int, default=15, help="simulated runs, of which the median is told [15]")
    chosen = options.parse_args()
    if chosen.command == "check":
        check(chosen.scene or [str(ROOT / "scenes/fig4.ron"), str(ROOT / "scenes/gallery/cat_planet.ron")])
    else:
        cluster(chosen)


if __name__ == "__main__":
    main()
