# %% [markdown]
# # Percussive drilling: efficiency against the stiffness of the rock
#
# A piston strikes a rod, and the bit presses on rock that resists as a spring. The efficiency is the largest energy in
# the rock during the first wave, over the kinetic energy of the piston. Soft rock gives way and takes little; hard rock
# sends the wave back. Which rock suits the drill, and what does a heavy bit change?

# %%
import numpy as np
import matplotlib.pyplot as plt
import wavestep as ws

DRILL = """scene "Percussive drill"
symbol k > 0
material steel { modulus = 210 GPa, density = 7850 kg/m^3 }
bar     piston { material = steel, diameter = 30 mm, length = 300 mm, velocity = 8 m/s }
bar     rod    { material = steel, diameter = 30 mm, length = 1500 mm }
BIT
support rock   { stiffness = k*1 kN/mm }
line    free - piston | rod - JOINT rock - free
observe rock_energy = energy(rock)
"""
BIT = "bar bit { material = steel, diameter = 60 mm, length = 100 mm }"
plain = DRILL.replace("BIT", "").replace("JOINT", "")
heavy = DRILL.replace("BIT", BIT).replace("JOINT", "bit -")

area, c = np.pi * 0.03**2 / 4, np.sqrt(210e9 / 7850)
Z = area * 7850 * c  # impedance of piston and rod
T = 2 * 0.3 / c  # length of the pulse
energy = 7850 * area * 0.3 * 8**2 / 2
print(f"pulse {T * 1e6:.1f} µs, Z/T = {Z / T * 1e-6:.1f} kN/mm, energy of the blow {energy:.2f} J")

# %% [markdown]
# Where piston and rod have the same impedance and there is no bit, the incident pulse is a rectangle of length T. The
# spring at the end of the rod answers with an exponential, and its energy is largest at the end of the pulse. With
# κ = kT/Z the efficiency is 2/κ (1 − exp(−κ))². Its maximum is 81.5 % at κ = 1.256: a rectangular pulse never gives
# more to a rock that is a spring. A bit shapes the pulse, so the bound does not hold with one.
#
# The maxima of the scenes are proven ones of the first 650 µs, before the wave is back for a second time.

# %%
def efficiency(scene, k):
    return float(ws.read(scene, k=k).signal("rock_energy").maximum(0, "650 us").value) / energy

kappa = np.geomspace(0.1, 20, 41)
stiffness = kappa * Z / T * 1e-6  # kN/mm
without = np.array([efficiency(plain, k) for k in stiffness])
formula = 2 / kappa * (1 - np.exp(-kappa)) ** 2
print("agrees with the formula to 12 places:", np.allclose(without, formula, rtol=0, atol=1e-12))

# %%
with_bit = np.array([efficiency(heavy, k) for k in stiffness])
figure, axes = plt.subplots()
axes.semilogx(stiffness, 100 * formula, color="0.7", linewidth=5, label="2/κ (1 − exp(−κ))²")
axes.semilogx(stiffness, 100 * without, label="no bit")
axes.semilogx(stiffness, 100 * with_bit, label="bit of 60 mm by 100 mm")
axes.set(xlabel="stiffness of the rock in kN/mm", ylabel="efficiency in %", ylim=(0, 100))
axes.legend()
figure.tight_layout()
for name, found in [("without", without), ("with", with_bit)]:
    best = found.argmax()
    print(f"{name} bit: {100 * found[best]:.1f} % at {stiffness[best]:.0f} kN/mm")

# %% [markdown]
# Without a bit the scene gives the formula, and stays below its bound. A bit is better in hard rock, worse in soft:

# %%
assert abs(without - formula).max() < 1e-12
assert 0.81 < without.max() < 0.8146
assert with_bit[-1] > without[-1] and with_bit[0] < without[0]
