"""The table of all areas: missions in worker processes, figures, pictures, a film, a page."""
