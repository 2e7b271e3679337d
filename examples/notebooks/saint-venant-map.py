# %% [markdown]
# # Saint-Venant's problem: a map of contact times
#
# A rigid mass strikes a bar whose far end is fixed, leaves it, and may be struck again by the vibrating end. How long is
# it in contact, and how much of its velocity does it get back, for 2,001 ratios of the masses? A local Dask cluster of
# two workers does the work; a cluster of many machines needs no other line but the one that makes it. Times are in
# passages L/c; mu is the mass of the bar over the striker's.

# %%
import numpy as np
import matplotlib.pyplot as plt
import wavestep as ws
from dask.distributed import Client, LocalCluster

with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster, Client(cluster):
    rows = ws.sweep("saint-venant", {"mu": "1/10..10:2001:log"}, contacts=True, engine="dask", progress=False)
rows = rows.rename(columns=lambda name: name.removesuffix(" hammer-rod"))
assert rows["error"].isna().all()
print(rows.describe().loc[["count", "min", "max"], ["mu", "contacts", "contact time", "restitution"]])

# %% [markdown]
# There are one or two contacts, never three:

# %%
ratio = 1 / rows["mu"]  # striker over bar
twice = rows["contacts"] == 2
assert rows["contacts"].isin([1, 2]).all()
figure, (above, below) = plt.subplots(2, sharex=True, figsize=(7, 5.4))
for axes, column, label in ((above, "contact time", "first contact in L/c"), (below, "restitution", "restitution")):
    for which, colour, count in ((~twice, "C0", "one contact"), (twice, "C1", "two contacts")):
        axes.plot(ratio, rows[column].where(which), colour, label=count)
    axes.set(xscale="log", ylabel=label)
above.legend()
below.set(xlabel="mass of the striker over mass of the bar")
figure.tight_layout()

# %% [markdown]
# The front that the mass sent off returns at t = 2, 4, 6 … and raises the force by 2 each time. Where the force just
# fails to vanish before such an arrival, the contact lasts on, and the release jumps. At smaller ratios near by, a
# second contact fills the gap. The map has these jumps; bisection finds the one at t = 4 to nine digits:

# %%
times = rows["contact time"].to_numpy()
for jump in np.flatnonzero(times[:-1] - times[1:] > 0.1):
    before, after = ratio[jump + 1], ratio[jump]
    print(f"from {times[jump + 1]:.4f} to {times[jump]:.4f} between ratios of {before:.4f} and {after:.4f}")

def release(ratio):
    return float(ws.scene("saint-venant", mu=1 / ratio).events().events[1].time)

low, high = 1.0, 3.0
while high - low > 1e-9:
    middle = (low + high) / 2
    low, high = (middle, high) if release(middle) < 4 else (low, middle)
print(f"the release jumps from {release(low):.6f} to {release(high):.6f} at a ratio of {low:.8f}")

# %% [markdown]
# At equal masses the contact time is 3 + exp(−2)/2:

# %%
print(f"contact time at equal masses: {release(1):.15f}")
assert release(1) == 3.067667641618306 and abs(release(1) - 3 - np.exp(-2) / 2) < 1e-15
assert abs(np.interp(0, np.log(rows["mu"]), times) - release(1)) < 1e-7
