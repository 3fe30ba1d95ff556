"""dm_control's Physics of a scene, with named measurements."""

import numpy as np

from mjsim import GAITS, SURFACES, Robot, Scene
from mjsim.env.physics import Physics


def main() -> float:
    physics = Physics.of(Scene(ground=SURFACES["gelatin"]))
    gait, pressure, step = GAITS["wave"], Robot().peak_pressure, physics.timestep()
    for number in range(1, round(gait.period / step) + 1):
        physics.set_control(pressure * gait.fractions(np.array([number * step]))[0])
        physics.step()
        if number % 400 == 0:
            left, right = physics.contact_lengths()
            moved, high = 1e3 * physics.displacement(), 1e3 * physics.height()
            sides = f"{1e3 * left:.0f} and {1e3 * right:.0f} mm on their side"
            print(f"t = {physics.time():4.1f} s  {moved:+6.2f} mm, {high:4.1f} mm high, {sides}")
    return physics.displacement()


if __name__ == "__main__":
    main()
