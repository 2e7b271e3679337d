# %% [markdown]
# # A Hopkinson test: the specimen's stiffness from a gauge
#
# Two gauges on a split Hopkinson bar: one halfway along the incident bar, one on the output bar, 500 mm behind the
# specimen. The record is noisy and its clock starts a few microseconds off. Wanted: the stiffness of the specimen.
# The record is synthetic, so that we know what has to come out.

# %%
import numpy as np
import matplotlib.pyplot as plt
from scipy.optimize import least_squares
import wavestep as ws
from make_gauge import NOISE, SPECIMEN, VELOCITY

clock, incident, output = np.loadtxt("gauge.csv", delimiter=",").T  # µs, microstrain
print(f"{len(clock)} samples, {clock[0]:.0f} to {clock[-1]:.0f} µs")

# %% [markdown]
# ## The striker's velocity
#
# Striker and bar have the same impedance, so the incident pulse is a plateau of strain −V/(2c). Its mean gives V.

# %%
c = np.sqrt(210e9 / 7850)
plateau = incident[(clock > 155) & (clock < 255)]
V = -2 * c * plateau.mean() * 1e-6
error = 2 * c * plateau.std(ddof=1) / np.sqrt(len(plateau)) * 1e-6
print(f"V = {V:.3f} ± {error:.3f} m/s")

# %% [markdown]
# ## The fit
#
# The scene `hopkinson.wave` has the symbols k and V. Each trial of the optimizer is an exact solution, so the residuals
# are noise alone and hold no error of a mesh. Two unknowns: the stiffness, and how late the trigger is.

# %%
def gauge(name, k, late):
    return 1e6 * ws.read("hopkinson.wave", k=k, V=V).signal(name)((clock + late) * 1e-6)

fit = least_squares(lambda x: gauge("gauge_output", *x) - output, [60, 0], x_scale=[10, 1], diff_step=1e-4)
k, late = fit.x
sigma = np.sqrt(2 * fit.cost / (len(clock) - 2))
deviation = sigma * np.sqrt(np.diag(np.linalg.inv(fit.jac.T @ fit.jac)))
print(f"k = {k:.2f} ± {deviation[0]:.2f} kN/mm, trigger late by {late:.2f} ± {deviation[1]:.2f} µs")
print(f"residuals {sigma:.2f} microstrain")

# %%
figure, (top, bottom) = plt.subplots(2, sharex=True, height_ratios=[3, 1], figsize=(7, 4.6))
for values, name, label in [(incident, "gauge_incident", "incident bar"), (output, "gauge_output", "output bar")]:
    top.plot(clock, gauge(name, k, late), linewidth=2.5, alpha=0.7, label=f"{label}, exact with the fitted k")
    top.plot(clock, values, color="black", linewidth=0.4, label="record" if values is output else None)
bottom.plot(clock, output - gauge("gauge_output", k, late), color="C1", linewidth=0.6)
top.set(ylabel="strain in microstrain")
bottom.set(xlabel="time of the record in µs", ylabel="output,\nresidual")
top.legend(ncols=3, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1))
figure.tight_layout()

# %% [markdown]
# The residuals are as large as the noise and show no trend. The stiffness is found again within three standard
# deviations, and the three come to a few per cent:

# %%
assert abs(V - VELOCITY) < 3 * error
assert abs(k - SPECIMEN) < 3 * deviation[0] < 0.04 * SPECIMEN
assert abs(sigma / NOISE - 1) < 0.15
