"""Mission: robots that search a world, map it and tell what kind of place each part is."""
