"""A worked example for Python: how deep does the light of a morning reach into maize?

Run it as it stands, or cell by cell (`# %%`) in an editor that knows notebooks:

    PYTHONPATH=build/release/python /usr/bin/python3 scenes/light_by_leaf.py [FIGURE.png] [ERROR]

It draws PAR through the canopy at three times of a day, and what the leaves of each rank absorb.
"""

# %% Requirements: sunfleck, numpy, matplotlib
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import sunfleck

figure_file = sys.argv[1] if len(sys.argv) > 1 else "light_by_leaf.png"
error = float(sys.argv[2]) if len(sys.argv) > 2 else 0.01

# %% One canopy, kept with its tree and device: other light costs only its tracing
scene = pathlib.Path(__file__).with_name("maize_sparse.toml")
canopy = sunfleck.Simulation(scene)
print(f"{canopy.triangles} triangles on {canopy.device['name']}")

# %% Three times of 8 August at Beijing; the beam grows with the sine of the sun's elevation, the sky stays
place = {"latitude": 40.02, "longitude": 116.28}
results = {}
for clock in ("06:30", "08:30", "12:00"):
    moment = f"2002-08-08T{clock}:00+08:00"
    elevation, _ = sunfleck.sun_position(moment, **place)
    light = {"name": "PAR", "direct": 420.0 * np.sin(np.radians(elevation)), "diffuse": 60.0}
    results[clock] = canopy.run(
        sun={"time": moment, **place}, sky={"model": "uniform"}, band=[light], error=error, triangle_errors=False
    )
    balance = results[clock].bands["PAR"]
    print(f"{clock}  sun {elevation:4.1f} deg  PAR {balance['incident']:6.1f} W m-2, absorbed by leaves {balance['absorbed_vegetation']:6.1f}")

# %% Flux absorbed by the leaves of each rank, per leaf area, averaged over plants
def by_rank(result):
    organs = result.organs
    leaf = organs["organ"] == "leaf"
    ranks = np.unique(organs["rank"][leaf])
    means = []
    for rank in ranks:
        of_rank = leaf & (organs["rank"] == rank)
        means.append(np.average(organs["PAR_absorbed"][of_rank], weights=organs["area_m2"][of_rank]))
    return ranks, np.array(means)


# %% The figure
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), constrained_layout=True)
for clock, result in results.items():
    profile = result.profile
    share = profile["PAR_down"] / profile["PAR_down"][-1]
    left.fill_betweenx(
        profile["height_m"],
        share - profile["PAR_down_error"] / profile["PAR_down"][-1],
        share + profile["PAR_down_error"] / profile["PAR_down"][-1],
        alpha=0.3,
    )
    left.plot(share, profile["height_m"], label=clock)
    right.plot(*by_rank(result), marker="o", label=clock)
left.set(xlabel="PAR that comes down, share of the incident", ylabel="height, m", xlim=(0, 1.02), ylim=(0, None))
right.set(xlabel="leaf rank, from the ground", ylabel="absorbed PAR, W m$^{-2}$ of leaf", ylim=(0, None))
right.legend(title="8 August", frameon=False)
figure.savefig(figure_file, dpi=150)
print(figure_file)
