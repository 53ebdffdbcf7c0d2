"""Bridge: worlds, robots and sensors in pybullet; it needs the extra ``symboslam[sim]``."""
