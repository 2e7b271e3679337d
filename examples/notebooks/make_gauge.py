"""Makes gauge.csv: what two strain gauges of a Hopkinson bar would record, with noise and a late trigger."""

import pathlib

import numpy as np

import wavestep as ws

SPECIMEN, VELOCITY, TRIGGER, NOISE = 37.4, 9.83, 3.2e-6, 15.0  # kN/mm, m/s, s, microstrain

if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    p = ws.read(here / "hopkinson.wave", k=SPECIMEN, V=VELOCITY)
    clock = np.arange(120e-6, 620e-6, 1e-6)
    noise = np.random.default_rng(1872).normal(0, NOISE, (2, len(clock)))
    gauges = [p.signal(name)(clock + TRIGGER) for name in ("gauge_incident", "gauge_output")]
    rows = np.column_stack([clock * 1e6, *(1e6 * np.array(gauges) + noise)])
    header = "made by make_gauge.py\ntime_us,incident_microstrain,output_microstrain"
    np.savetxt(here / "gauge.csv", rows, "%.1f", delimiter=",", header=header)
