#!/usr/bin/python3
"""What knowing an error costs: CPU seconds of `nook render --error E` above those of one sample a pixel, over
those of the cheapest fixed spp x directions whose picture has no larger RMSE.

    bench/price_of_knowing.py build/bin/nook [--scenes cbox_ao_cosine spaceship_ao_cosine room_ao] [--rounds 3]

Every setting is rendered once for its RMSE, and those that may be the cheapest are then timed in turn, whole
warm processes, medians of user and system seconds. The RMSE is against two references a and b of half the
directions each: the mean of (x - a)(x - b) is the mean square error of x without the noise of either.
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

SCENES = ["cbox_ao_cosine", "spaceship_ao_cosine", "room_ao"]
FIXED = [(spp, directions) for spp in (4, 8, 16, 32, 64, 128, 256) for directions in (1, 4, 8, 16, 32, 64)
         if 128 <= spp * directions <= 1024]


def cpu_seconds(command):
    """CPU seconds of a command, children's children included."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 5):
        sys.exit(f"{' '.join(command)}: {done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Bench:
    def __init__(self, nook, scene, size, folder):
        self.nook, self.folder = nook, folder
        self.base = [nook, "render", str(scene), "--size", size, "--quiet", "-o"]
        self.references = [self.picture(f"reference{seed}", "--spp", "64", "--directions", "32", "--seed", str(seed))
                           for seed in (1001, 1002)]
        self.of_references = self.square(*self.references)

    def command(self, name, *options):
        return [*self.base, str(self.folder / f"{name}.exr"), *options]

    def picture(self, name, *options):
        cpu_seconds(self.command(name, *options))
        return self.folder / f"{name}.exr"

    def square(self, a, b):
        told = subprocess.run([self.nook, "compare", str(a), str(b), "--json"], capture_output=True, text=True)
        return next(iter(json.loads(told.stdout)["channels"]))["rmse"] ** 2

    def rmse(self, picture):
        a, b = self.references
        square = 0.5 * (self.square(picture, a) + self.square(picture, b) - self.of_references)
        return max(square, 0) ** 0.5


def seconds_in_turn(commands, rounds):
    """The medians of the CPU seconds of several commands."""
    taken = {name: [] for name in commands}
    for command in commands.values():
        cpu_seconds(command)
    for _ in range(rounds):
        for name, command in commands.items():
            taken[name].append(cpu_seconds(command))
    return {name: statistics.median(values) for name, values in taken.items()}


def measure(bench, error, rounds):
    known = ("--error", str(error))
    asked = bench.rmse(bench.picture("known", *known))
    # The fewest directions a number of camera rays needs; what has more rays of both kinds costs more.
    good = []
    for spp, directions in sorted(FIXED, key=lambda f: f[0] * f[1]):
        if any(spp >= s and directions >= d for s, d, _ in good):
            continue
        of_this = bench.rmse(bench.picture("fixed", "--spp", str(spp), "--directions", str(directions)))
        if of_this <= asked:
            good.append((spp, directions, of_this))
    commands = {"one": bench.command("one", "--spp", "1"), "known": bench.command("known", *known)}
    for spp, directions, _ in good:
        commands[f"{spp} x {directions}"] = bench.command("fixed", "--spp", str(spp), "--directions", str(directions))
    seconds = seconds_in_turn(commands, rounds)
    spp, directions, of_fixed = min(good, key=lambda g: seconds[f"{g[0]} x {g[1]}"])
    fixed = seconds[f"{spp} x {directions}"]
    return {"error": error, "rmse": asked, "seconds": seconds["known"], "one": seconds["one"],
            "fixed": f"{spp} x {directions}", "fixed_rmse": of_fixed, "fixed_seconds": fixed,
            "price": (seconds["known"] - seconds["one"]) / (fixed - seconds["one"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nook")
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--size", default="400x300")
    parser.add_argument("--error", type=float, default=0.01)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    scenes = pathlib.Path(__file__).resolve().parent.parent / "scenes"
    print("| scene | `--error`: RMSE | CPU s | cheapest fixed | RMSE | CPU s | one sample | price |\n"
          "|---|---|---|---|---|---|---|---|")
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(options.nook, scenes / f"{name}.toml", options.size, pathlib.Path(folder))
            r = measure(bench, options.error, options.rounds)
        print(f"| {name} | {r['rmse']:.4f} | {r['seconds']:.2f} | {r['fixed']} | {r['fixed_rmse']:.4f} "
              f"| {r['fixed_seconds']:.2f} | {r['one']:.2f} | {r['price']:.2f} |", flush=True)


if __name__ == "__main__":
    main()
