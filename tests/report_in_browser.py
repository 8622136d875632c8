#!/usr/bin/env python3
"""Opens reports in headless Chromium, 1280 and 400 pixels wide, and says what a reader would miss there.

    tests/report_in_browser.py REPORT.html...

A report passes if the console stays silent, nothing is fetched, each picture has a size and each image its pixels, the
page does not scroll sideways, and no text is smaller than LEAST pixels. PNGs of what was seen lie beside each report.
"""

import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

WIDTHS = [1280, 400]
# Pixels of the smallest letters; books' footnotes have 9 to 10.
LEAST = 8.0

# Runs inside the report, in a frame as wide as the screen it is meant for: Chromium's own window has a least width.
LOOK = """
<script>
const wrong = [];
addEventListener('error', event => wrong.push('error: ' + (event.message || event.target.tagName)), true);
addEventListener('securitypolicyviolation', event => wrong.push('fetches ' + event.blockedURI));
addEventListener('load', () => {
  const pictures = [...document.querySelectorAll('figure svg, figure img')];
  for (const picture of pictures) {
    const { width, height } = picture.getBoundingClientRect();
    const name = (picture.getAttribute('aria-label') || picture.alt || '?').slice(0, 60);
    if (width < 100 || height < 50) wrong.push(`${name}: ${width} x ${height} pixels`);
    if (picture.tagName === 'IMG' && !(picture.complete && picture.naturalWidth > 0)) wrong.push(`${name}: not drawn`);
    if (picture.tagName === 'svg' && picture.querySelectorAll('text, circle, rect, polyline').length < 5)
      wrong.push(`${name}: empty`);
  }
  let least = Infinity;
  for (const text of document.querySelectorAll('p, td, th, h1, h2, figcaption, svg text')) {
    const frame = text.ownerSVGElement;
    const scale = frame ? frame.getBoundingClientRect().width / frame.viewBox.baseVal.width : 1;
    const size = scale * parseFloat(getComputedStyle(text).fontSize);
    least = Math.min(least, size);
  }
  const page = document.documentElement;
  if (page.scrollWidth > innerWidth) wrong.push(`scrolls sideways: ${page.scrollWidth} pixels in ${innerWidth}`);
  if (!(least >= %LEAST%)) wrong.push(`letters of ${least.toFixed(1)} pixels`);
  if (!pictures.length) wrong.push('no pictures');
  const seen = { width: innerWidth, height: page.scrollHeight, pictures: pictures.length, least, wrong };
  parent.postMessage(JSON.stringify(seen), '*');
});
</script>
""".replace("%LEAST%", str(LEAST))

FRAME = """<!DOCTYPE html><meta charset="utf-8"><body style="margin:0">
<iframe style="border:0;width:{width}px;height:{height}px" srcdoc="{page}"></iframe>
<script>addEventListener('message', event => {{ document.body.dataset.seen = event.data; }});</script></body>"""

# Everything that the page needs is in it.
POLICY = '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; img-src data:; style-src \'unsafe-inline\'; script-src \'unsafe-inline\'">'


def chromium(folder, *options):
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
               f"--user-data-dir={folder}/profile", "--enable-logging=stderr", "--virtual-time-budget=20000"]
    return subprocess.run([*command, *options], capture_output=True, text=True, timeout=180)


def look(report, width):
    text = report.read_text(encoding="utf-8").replace("<head>", "<head>" + POLICY + LOOK, 1)
    with tempfile.TemporaryDirectory() as folder:
        frame = pathlib.Path(folder, "frame.html")

        def browse(height, *options):
            frame.write_text(FRAME.format(width=width, height=height, page=html.escape(text)), encoding="utf-8")
            return chromium(folder, *options, frame.as_uri())

        said = browse(900, "--dump-dom")
        found = re.search(r'data-seen="([^"]*)"', said.stdout)
        if not found:
            return [f"the page did not load:\n{said.stderr[-2000:]}"], None
        seen = json.loads(html.unescape(found.group(1)))
        wrong = seen["wrong"] + [line for line in said.stderr.splitlines() if "CONSOLE" in line]
        height = min(int(seen["height"]), 12000)
        picture = report.with_name(f"{report.stem}-{width}.png")
        browse(height, f"--screenshot={picture}", f"--window-size={max(width, 500)},{height}")
        if not picture.exists():
            wrong.append("no screenshot")
        return wrong, seen


def main():
    reports = [pathlib.Path(name) for name in sys.argv[1:]]
    if not reports:
        sys.exit(__doc__)
    failed = False
    for report in reports:
        for width in WIDTHS:
            wrong, seen = look(report, width)
            failed |= bool(wrong)
            summary = f"{seen['pictures']} pictures, letters of {seen['least']:.1f} pixels and more" if seen else ""
            print(f"{report} at {width}: {'; '.join(wrong) or 'passed, ' + summary}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
