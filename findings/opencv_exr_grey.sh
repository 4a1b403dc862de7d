#!/bin/sh
# OpenCV 4.14.0 reads a white EXR picture as 1.09 when it is asked for grey.
#
# One would guess: cv2.imread(name, cv2.IMREAD_ANYDEPTH) of a picture whose R, G and B are all 1 gives 1, as weights of luminance sum to 1, and
# red, green and blue alone give .21, .72 and .07 (or .30, .59 and .11).
# What happens: they give .64, .30 and .15. These are the x coordinates of the chromaticities of Rec. 709's red, green and blue
# (.64, .33), (.30, .60) and (.15, .06); their sum is 1.09. Red counts twice as much as green.
# Who is bitten: whoever reads depth maps, masks or ambient occlusion, stored as three equal channels, as one channel: all values are 9 % too large, and
# nothing above 1 is clipped, so that it shows in no picture.
# Found while the documentation on reading EXR files was written; cv2.IMREAD_UNCHANGED has the values as they are.
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q numpy==2.2.6 OpenEXR==3.5.3 opencv-python-headless==4.14.0.94
OPENCV_IO_ENABLE_OPENEXR=1 venv/bin/python - <<'END'
import cv2
import numpy as np
import OpenEXR

print("OpenCV", cv2.__version__)
expected = {(1, 0, 0): .64, (0, 1, 0): .30, (0, 0, 1): .15, (1, 1, 1): 1.09, (.5, .5, .5): .545}
for colour, value in expected.items():
    rgb = np.empty((2, 2, 3), np.float32)
    rgb[...] = colour
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": rgb}) as file:
        file.write("picture.exr")
    grey = float(cv2.imread("picture.exr", cv2.IMREAD_ANYDEPTH)[0, 0])
    print(f"R, G, B = {colour}: grey {grey:.4f}, all channels {cv2.imread('picture.exr', cv2.IMREAD_UNCHANGED)[0, 0]}")
    assert abs(grey - value) < 1e-5, "it has changed"
END
# Seen, with OpenCV 4.14.0 of PyPI's opencv-python-headless 4.14.0.94:
#   R, G, B = (1, 0, 0): grey 0.6400, all channels [0. 0. 1.]
#   R, G, B = (0, 1, 0): grey 0.3000, all channels [0. 1. 0.]
#   R, G, B = (0, 0, 1): grey 0.1500, all channels [1. 0. 0.]
#   R, G, B = (1, 1, 1): grey 1.0900, all channels [1. 1. 1.]
#   R, G, B = (0.5, 0.5, 0.5): grey 0.5450, all channels [0.5 0.5 0.5]
