"""Identification of a payload from torques, by the regressor: forces are linear in the inertial parameters."""
import pathlib

import numpy as np

import kte

file = pathlib.Path(__file__).resolve().parents[2] / "tests/data/robots/iiwa14.urdf"
arm = kte.load_robot(file).chain
payload = kte.inertia_3D("tool", mass=2.5, com=[0.02, -0.01, 0.06], inertia=[0.004, 0.005, 0.003])
loaded = kte.Chain(arm, payload)

# Measured: torques with noise of 0.05 Nm along random motions.
random = np.random.default_rng(1)
q, v, a = random.uniform(-1.5, 1.5, size=(3, 2000, 7))
measured = kte.inverse_dynamics(loaded, q, v, a) + random.normal(scale=0.05, size=(2000, 7))

# The last ten columns of the regressor are those of the payload; what the arm itself needs is known.
regressor = kte.torque_regressor(loaded, q, v, a)[:, :, -10:]
found, *_ = np.linalg.lstsq(regressor.reshape(-1, 10), (measured - kte.inverse_dynamics(arm, q, v, a)).ravel(), rcond=None)
true = kte.inertial_parameters(loaded)[-10:]
for name, x, exact in zip("m mc_x mc_y mc_z I_xx I_xy I_yy I_xz I_yz I_zz".split(), found, true):
    print(f"{name:5} {x:9.5f}  (true {exact:8.5f})")
assert np.abs(found - true).max() < 0.01
