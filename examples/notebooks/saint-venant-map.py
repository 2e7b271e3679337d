# %% [markdown]
# # Saint-Venant's problem: a map of contact times
#
# A rigid mass strikes a bar whose far end is fixed, leaves it, and may be struck again by the vibrating end. When is it
# in contact, for 201 ratios of the masses? Times are in passages L/c; mu is the mass of the bar over the striker's.

# %%
import numpy as np
import matplotlib.pyplot as plt
import wavestep as ws

ratios = np.geomspace(0.1, 10, 201)  # striker over bar
histories = [ws.scene("saint-venant", mu=1 / ratio).events() for ratio in ratios]
contacts = [
    [(float(a.time), float(b.time)) for a, b in zip(h.events[::2], h.events[1::2])] for h in histories
]
again = np.array([len(times) - 1 for times in contacts])
print(f"{len(ratios)} ratios; struck again: {(again > 0).sum()}, at most {again.max()} times")

# %%
figure, axes = plt.subplots(figsize=(7, 4.4))
for order, label in enumerate(["first contact", "second contact"]):
    spans = np.array([times[order] if order < len(times) else (np.nan, np.nan) for times in contacts])
    if np.isfinite(spans).any():
        axes.fill_between(ratios, *spans.T, color=f"C{order}", alpha=0.6, linewidth=0.5, label=label)
axes.set(xscale="log", xlabel="mass of the striker over mass of the bar", ylabel="time in L/c")
axes.legend(loc="upper left")
figure.tight_layout()
assert again.max() == 1  # two contacts at most

# %% [markdown]
# The front that the mass sent off returns at t = 2, 4, 6 … and raises the force by 2 each time. Where the force just
# fails to vanish before such an arrival, the contact lasts on, and the release jumps. At smaller ratios near by, a
# second contact fills the gap. Bisection finds where the release leaves the window from 2 to 4:

# %%
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
equal = contacts[int(abs(ratios - 1).argmin())][0][1]
print(f"contact time at equal masses: {release(1):.15f}")
assert release(1) == 3.067667641618306 and abs(release(1) - 3 - np.exp(-2) / 2) < 1e-15
assert abs(equal - release(1)) < 1e-12
