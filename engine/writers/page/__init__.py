"""The parts of the HTML page: a template, a style, scripts, and the data put into them."""
