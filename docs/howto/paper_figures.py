"""The paper's figures 7 to 10 from Python: python3 paper_figures.py, beside the folder scenarios/."""
# %% one look for all
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import wormdrive

figure, ((fig7, fig8), (fig9, fig10)) = plt.subplots(2, 2, figsize=(11, 8), layout="constrained")
arms = ["07cm_forward", "07cm_backward", "14cm_forward", "14cm_backward"]

# %% fig. 7: motor torque at break-away over the load torque
for arm in arms:
    start = wormdrive.run(f"scenarios/fig07_break_in_{arm}.toml").events
    fig7.plot(start.load_torque_before[0], 1e3 * start.motor_torque_before[0], "o", label=arm.replace("_", " "))
fig7.set(title="Fig. 7: break-in", xlabel="load torque [N m]", ylabel="motor torque [mN m]")

# %% fig. 8: gear angle over a ramp of the motor torque
for arm in arms:
    ramp = wormdrive.run(f"scenarios/fig08_ramp_{arm}.toml").trajectory
    fig8.plot(ramp.motor_torque, ramp.gear_angle, label=arm.replace("_", " "))
fig8.set(title="Fig. 8: torque ramps", xlabel="motor torque [N m]", ylabel="gear angle [rad]")

# %% fig. 9: engagement switching, every event a line
switching = wormdrive.run("scenarios/fig09_switching.toml")
fig9.plot(switching.trajectory.time, switching.trajectory.gear_speed)
fig9.vlines(switching.events.time, *fig9.get_ylim(), colors="0.8", linewidths=0.8)
fig9.set(title="Fig. 9: engagement switching", xlabel="time [s]", ylabel="gear speed [rad/s]")

# %% fig. 10: tracking error under sliding control and PID
for law in ("sliding_014rad_bare", "pid_014rad_bare"):
    loop = wormdrive.run(f"scenarios/fig10_{law}.toml", run={"solver": "taylor"}).controller
    assert loop  # None in a run without a controller
    fig10.plot(loop.time, 1e3 * (loop.gear_angle - loop.reference_angle), label=law.split("_")[0])
fig10.set(title="Fig. 10: tracking", xlabel="time [s]", ylabel="error [mrad]")
figure.get_layout_engine().set(hspace=0.06, wspace=0.04, w_pad=0.1, h_pad=0.1)
for panel in (fig7, fig8, fig10):
    panel.legend(fontsize="small")
figure.savefig("paper_figures.png", dpi=150)
