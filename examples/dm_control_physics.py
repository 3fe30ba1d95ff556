"""dm_control's Physics of a scene, with named measurements."""

from mjsim import GAITS, SURFACES, Robot, Scene
from mjsim.simulation.physics import Physics


def main() -> float:
    physics = Physics.of(Scene(ground=SURFACES["gelatin"]))
    gait = GAITS["wave"]
    for stage in gait.stages:
        physics.set_control([Robot().peak_pressure * fraction for fraction in stage])
        physics.step(nstep=400)  # 2 s
        left, right = physics.contact_lengths()
        print(
            f"t = {physics.time():4.1f} s  {1e3 * physics.displacement():+6.2f} mm  "
            f"{1e3 * physics.height():5.1f} mm high  sides {1e3 * left:.0f}, {1e3 * right:.0f} mm"
        )
    return physics.displacement()


if __name__ == "__main__":
    main()
