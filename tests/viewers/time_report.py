#!/usr/bin/env python3
"""Measures a report in Debian's Chromium, headless: when it is first painted, when it is whole, and how many frames a
second the slider shows. Prints the figures; nothing passes or fails.

usage: time_report.py REPORT.html [--webgl] [--screenshot PICTURE.png]

--webgl: by WebGL even where no graphics card serves it (a page takes the plain canvas then). Compare figures of one machine only, and of one
that does nothing else. No test of its own: it takes what check_report.py takes.
"""
import argparse
import base64
import os
import time
from pathlib import Path

from check_report import browser

# The slider is moved once a frame of the screen, as a hand would, and what was painted is read back.
SLIDE = """
  const done = arguments[0], stage = document.querySelector(".stage"), slider = document.querySelector("input[type=range]");
  const begun = performance.now(), shown = [], last = Number(slider.max);
  const step = (now) => {
    shown.push(now);
    if (performance.now() - begun > 4000) return done({frames: shown.length - 1, seconds: (shown.at(-1) - shown[0]) / 1000});
    slider.value = shown.length % (last + 1);
    slider.dispatchEvent(new Event("input", {bubbles: true}));
    const gl = stage.firstChild.getContext("webgl");
    if (gl) gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    else stage.firstChild.getContext("2d").getImageData(0, 0, 1, 1);
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);"""


def processor_seconds(root):
    """Of a process and all that it started, so far; it does not depend on what else the machine does."""
    stats = {}
    for process in Path("/proc").glob("[0-9]*"):
        try:
            fields = (process / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        stats[int(process.name)] = (int(fields[1]), int(fields[11]) + int(fields[12]))
    known = {root}
    while True:
        more = {one for one, (parent, _) in stats.items() if parent in known} - known
        if not more:
            return sum(stats[one][1] for one in known if one in stats) / os.sysconf("SC_CLK_TCK")
        known |= more


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("report", type=Path)
    parser.add_argument("--webgl", action="store_true")
    parser.add_argument("--screenshot", type=Path)
    arguments = parser.parse_args()
    driver = browser("--enable-unsafe-swiftshader")
    driver.set_script_timeout(60)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": 1280, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    driver.get(arguments.report.resolve().as_uri() + ("#webgl" if arguments.webgl else ""))
    seconds = lambda text: driver.execute_script(f"return {text}") / 1000
    begun = time.monotonic()
    while driver.execute_script("return document.documentElement.dataset.block") is None and time.monotonic() - begun < 120:
        time.sleep(0.05)
    times = driver.execute_script("return Object.fromEntries(performance.getEntriesByType('paint').map((one) => [one.name, one.startTime]))")
    painter = driver.execute_script("return document.documentElement.dataset.painter")
    discs, frames = driver.execute_script("return [Report.facts.run.frames.discs, Report.facts.run.frames.list.length]")
    print(f"{arguments.report.name}: {arguments.report.stat().st_size / 1e6:.2f} MB, {discs:,} discs, {frames} frames, drawn by {painter}")
    print(f"first text painted after {times.get('first-contentful-paint', float('nan')) / 1000:.2f} s")
    print(f"block painted after {seconds('Report.shownAt'):.2f} s")
    print(f"a frame takes {driver.execute_script('return Report.shownBlock.timed()'):.1f} ms")
    before = processor_seconds(driver.service.process.pid)
    slid = driver.execute_async_script(SLIDE)
    used = processor_seconds(driver.service.process.pid) - before
    print(f"slider: {slid['frames'] / slid['seconds']:.1f} frames a second over {slid['seconds']:.1f} s, "
          f"{1000 * used / slid['frames']:.0f} ms of one processor each, the whole browser counted")
    if arguments.screenshot:
        arguments.screenshot.write_bytes(base64.b64decode(driver.execute_cdp_cmd("Page.captureScreenshot", {"format": "png", "captureBeyondViewport": True})["data"]))
    driver.quit()


if __name__ == "__main__":
    main()
