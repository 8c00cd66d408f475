# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's page in a browser. Usage: test_report_page.py BUILD_DIR, with PyMeshLab's Python. Leaves
its picture in BUILD_DIR/pictures."""

import json
import os
import re
import shutil
import subprocess
import tempfile

import common
import meshes
from pymeshlab_host import load, run

# What is drawn outside its diagram or its column, how large and how colourful the diagrams are, and which
# numbers are broken into two lines.
LOOK = """<script>
const box = e => e.getBoundingClientRect();
const inside = (a, b) => a.left >= b.left - 1 && a.right <= b.right + 1 && a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
const lines = e => { const r = document.createRange(); r.selectNodeContents(e); return r.getClientRects().length; };
const svgs = [...document.querySelectorAll("svg")];
document.documentElement.dataset.look = JSON.stringify({
  sizes: svgs.map(s => [box(s).width, box(s).height]),
  outside: svgs.flatMap(s => [...s.querySelectorAll("*")].filter(e => !inside(box(e), box(s))).map(e => e.outerHTML)),
  wide: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  colours: new Set([...svgs[0].querySelectorAll("path[fill]")].map(p => getComputedStyle(p).fill)).size,
  broken: [...document.querySelectorAll("td")].map(d => d.textContent && lines(d) > 1 ? d.textContent : "").filter(t => /^[-+.e\\d]+$/.test(t)),
  rows: [...document.querySelectorAll("tr")].filter(r => box(r).height > 0).length});
</script></body>"""


def browse(browser, folder, *arguments):
    return subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
         "--window-size=1280,1800", f"--user-data-dir={folder}/profile", *arguments],
        capture_output=True, text=True, timeout=120)


def looked(browser, folder, page):
    """What the script above finds out in the browser."""
    with open(page, encoding="utf-8") as source:
        text = source.read()
    copy = os.path.join(folder, "looked.html")
    with open(copy, "w", encoding="utf-8") as target:
        target.write(text.replace("</body>", LOOK))
    shown = browse(browser, folder, "--dump-dom", "file://" + copy)
    found = re.search(r'data-look="([^"]*)"', shown.stdout)
    if not found:
        common.skip(f"{browser} shows no page here: {shown.stderr.strip()[-300:]}")
    return json.loads(found.group(1).replace("&quot;", '"').replace("&lt;", "<").replace("&gt;", ">")
                      .replace("&amp;", "&"))


def main():
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if not browser:
        common.skip("no browser (Debian: chromium) is installed")
    pictures = os.path.join(common.BUILD, "pictures")
    os.makedirs(pictures, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "page.html")
        meshes.write_ply(os.path.join(folder, "torus.ply"), meshes.torus())
        run(load(os.path.join(folder, "torus.ply")), report=page)
        look = looked(browser, folder, page)
        print(look)
        assert len(look["sizes"]) == 4 and min(min(size) for size in look["sizes"]) > 200
        assert not look["outside"] and look["wide"] <= 0
        assert look["colours"] >= 3  # a torus has no map that keeps areas and angles
        assert look["rows"] > 60
        picture = os.path.join(pictures, "report.png")
        browse(browser, folder, "--screenshot=" + picture, "file://" + page)
        assert os.path.getsize(picture) > 20000
        # Without a list of cones the column of the numbers is narrower.
        meshes.write_ply(os.path.join(folder, "hill.ply"), meshes.hill())
        run(load(os.path.join(folder, "hill.ply")), report=page, target_curvature="Disk")
        assert not looked(browser, folder, page)["broken"]
    print(f"Drawn by {browser}: {picture}")


main()
