"""Map building: what robots drove and saw -> one map of landmarks, without an oracle."""
