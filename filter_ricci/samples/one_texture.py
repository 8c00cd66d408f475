#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""New texture coordinates for a textured mesh, and its texture drawn for them: one_texture.py IN OUT [SIZE].

OUT, a PLY or OBJ file, gets the image beside it: 1024 to 16384 texels wide, as many as keep the detail
of the old textures, or SIZE. With pip install ricciflow-*.whl."""

import os
import sys

from ricciflow import Refused, flatten

if not 3 <= len(sys.argv) <= 4:
    sys.exit(__doc__)
mesh, out = sys.argv[1:3]
size = int(sys.argv[3]) if len(sys.argv) > 3 else 0
image = os.path.abspath(os.path.splitext(out)[0] + ".png")
try:
    result = flatten(mesh, carry_texture=image, texture_size=size or 1024)
    scale = result.results.get("texture_scale", 1.0)
    if not size and scale < 1.0:
        result = flatten(mesh, carry_texture=image, texture_size=min(16384, round(1024 / scale)))
except Refused as refusal:
    sys.exit(f"{mesh}: {refusal}")
result.save(out)
print(image)
if "texture_scale" in result.results:  # not where there were colours only
    print(f"{result.texture_scale:.3g} times the texels per unit of length")
