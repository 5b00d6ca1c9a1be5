"""A stenosis, measured.

A phantom of 8 mm with a stenosis of 4 mm: its diameter along the vessel, with the uncertainty as a band.
Needs `lumencut[plot]`.
"""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

import lumencut
from lumencut import phantom

tube = phantom.stenosis()
profile = lumencut.measure(tube.volume, tube.tree[0])
print(profile.stenosis(at=31.0, reference=52.0))

figure = Figure(figsize=(10, 3.6), layout="constrained")
profile.plot(figure.add_subplot())
canvas = FigureCanvasAgg(figure)
canvas.draw()
Image.fromarray(np.asarray(canvas.buffer_rgba())).save("phantom_stenosis.webp")
