"""Map building: from what robots drove and saw to one landmark map, without an oracle (design 7)."""
