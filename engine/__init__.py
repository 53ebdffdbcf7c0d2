"""The numeric side: landmark maps, evidence, segmentation, explanations, readers and writers."""
