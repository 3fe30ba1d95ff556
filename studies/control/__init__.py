"""Controllers that sense what a robot could, in theory and in MuJoCo."""
