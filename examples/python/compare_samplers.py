"""Point sequences compared as one plot: ./nook python examples/python/compare_samplers.py SCENE -o samplers.png

Each sampler's error against its time, in pictures of one scene, by nook's study (docs/study.md): half as much
error for twice the time is a slope of -1, of independent samples it is -1/2. Lines end where the budget does.
"""

import argparse

import nook


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", default="samplers.png")
    parser.add_argument("--budget", type=float, default=30, help="seconds, about")
    parser.add_argument("--samplers", nargs="*", default=[], help="all if none is named")
    parser.add_argument("--max-spp", type=int, default=1024)
    options = parser.parse_args()
    scene = nook.Scene(options.scene)
    sampling = "lobe" if scene.info["effects"][0]["type"] == "ro" else "cosine"
    study = nook.study(
        scene, options.budget, samplers=options.samplers, samplings=sampling, max_spp=options.max_spp, progress=True
    )
    axes = study.plot()
    axes.set_title(f"{options.scene}, {sampling} sampling")
    axes.figure.savefig(options.output, dpi=100)
    of = study.columns
    for name in study.methods:
        rows = of["method"] == name
        best = of["rmse"][rows].argmin()
        print(f"{name:40} RMSE {of['rmse'][rows][best]:.5f} in {of['wall_seconds'][rows][best]:.3f} s")


if __name__ == "__main__":
    main()
