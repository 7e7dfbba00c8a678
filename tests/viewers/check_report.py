#!/usr/bin/env python3
"""Opens reports in Debian's Chromium, headless: nothing fails, the slider moves the block, texts can be read.

usage: check_report.py PERFORA WRITE_SYNTHETIC PINNED_DATA FOLDER

Reports are made of a made-up run (WRITE_SYNTHETIC) and of the pinned study, sweep, ensemble and calibration. Exit code
77 (CTest: skipped) where Chromium or selenium is missing.
"""
import base64
import subprocess
import sys
import time
from pathlib import Path

SKIPPED = 77

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: python3-selenium is missing (./setup.sh --viewers)")
    sys.exit(SKIPPED)

CHROMIUM, DRIVER = Path("/usr/bin/chromium"), Path("/usr/bin/chromedriver")
failures = []


def expect(condition, what):
    if not condition:
        failures.append(what)
        print("FAILED:", what)


def browser(*flags):
    options = Options()
    options.binary_location = str(CHROMIUM)
    for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", *flags):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(str(DRIVER)), options=options)


def show(driver, page, width, theme="light", place=""):
    """Loads the page and waits until it is drawn; returns the seconds that took."""
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": theme}]})
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    begun = time.monotonic()
    driver.get("about:blank")  # another place in the same page would load nothing
    driver.get(page.resolve().as_uri() + place)
    while time.monotonic() - begun < 120:
        if driver.execute_script("return document.documentElement.dataset.ready") is not None:
            break
        time.sleep(0.05)
    time.sleep(0.5)  # what was asked for with the last frame of the screen
    return time.monotonic() - begun


def check_page(driver, page, width, theme):
    what = f"{page.name} at {width} px, {theme}"
    show(driver, page, width, theme)
    expect(driver.execute_script("return document.documentElement.dataset.ready") == "yes", f"{what}: was not drawn whole")
    severe = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(not severe, f"{what}: errors on the console: {severe}")
    wide = driver.execute_script("return document.documentElement.scrollWidth")
    expect(wide <= width, f"{what}: {wide} px wide, so it must be scrolled sideways")
    small = driver.execute_script("""
        return [...document.querySelectorAll("main *")].filter((one) => one.childNodes.length && [...one.childNodes].some(
            (child) => child.nodeType === 3 && child.textContent.trim() !== "")).map((one) => parseFloat(getComputedStyle(one).fontSize))
            .reduce((least, size) => Math.min(least, size), 99)""")
    expect(small >= 12, f"{what}: text of {small} px")
    contrast = driver.execute_script("""
        const light = (colour) => { const c = colour.match(/[0-9.]+/g).slice(0, 3).map((v) => { v /= 255; return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
                                    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
        const style = getComputedStyle(document.body), soft = getComputedStyle(document.querySelector(".soft"));
        const ratio = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        return [ratio(light(style.color), light(style.backgroundColor)), ratio(light(soft.color), light(style.backgroundColor))];""")
    expect(min(contrast) >= 4.5, f"{what}: contrast of text to ground {contrast}, wanted 4.5 (WCAG AA)")
    empty = driver.execute_script("""
        return [...document.querySelectorAll(".plot canvas")].filter((one) => {
          const data = one.getContext("2d").getImageData(0, 0, one.width, one.height).data;
          return !data.some((value) => value !== 0);
        }).map((one) => one.getAttribute("aria-label"))""")
    expect(not empty, f"{what}: charts without a line: {empty}")
    # Chart.js takes the ends of an axis from the first and the last point of a series.
    outside = driver.execute_script("""
        return Object.values(Chart.instances).filter((chart) => chart.data.datasets.some((one) => one.data.some((point) => point && point.x !== undefined && ["x", "y"].some(
          (axis) => point[axis] < chart.scales[axis].min || point[axis] > chart.scales[axis].max)))).map((chart) => chart.canvas.getAttribute("aria-label"))""")
    expect(not outside, f"{what}: charts with points beyond their axes: {outside}")


def picture(driver):
    """The block as it is on the screen."""
    stage = driver.find_element(By.CSS_SELECTOR, ".stage")
    driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", stage)
    time.sleep(0.3)
    return base64.b64decode(stage.screenshot_as_base64)


def check_viewer(driver, page, painter, place=""):
    what = f"{page.name} by {painter}"
    show(driver, page, 1280, place=place)
    expect(driver.execute_script("return document.documentElement.dataset.painter") == painter, f"{what}: another painter drew")
    slider = driver.find_element(By.CSS_SELECTOR, "input[type=range]")
    frame = lambda: int(driver.find_element(By.CSS_SELECTOR, ".stage").get_attribute("data-frame"))
    slider.send_keys(Keys.HOME)
    first, first_picture = frame(), picture(driver)
    slider.send_keys(Keys.ARROW_RIGHT)
    expect(first == 0 and frame() == 1, f"{what}: the arrow key went from frame {first} to {frame()}")
    slider.send_keys(Keys.END)
    last = int(slider.get_attribute("max"))
    expect(frame() == last, f"{what}: End shows frame {frame()} of {last}")
    last_picture = picture(driver)
    expect(first_picture != last_picture, f"{what}: the first and the last frame look the same")
    pictures = {last_picture}
    buttons = driver.find_elements(By.CSS_SELECTOR, ".viewer .tools button[aria-pressed]")
    for button in buttons[1:]:
        button.click()
        pictures.add(picture(driver))
    expect(len(pictures) == len(buttons), f"{what}: {len(buttons)} ways to colour give {len(pictures)} pictures")
    severe = [entry["message"] for entry in driver.get_log("browser") if entry["level"] == "SEVERE"]
    expect(not severe, f"{what}: errors on the console: {severe}")


def main():
    perfora, write_synthetic, data, folder = sys.argv[1], sys.argv[2], Path(sys.argv[3]), Path(sys.argv[4])
    if not CHROMIUM.exists() or not DRIVER.exists():
        print("skipped: chromium or chromium-driver is missing (./setup.sh --viewers)")
        return SKIPPED
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([write_synthetic, str(folder)], check=True)
    pages = []
    for name, source in (("run", folder / "R.h5"), ("study", data / "study"), ("sweep", data / "sweep"),
                         ("ensemble", data / "ensemble"), ("calibration", data / "calibration")):
        pages.append(folder / f"{name}.html")
        subprocess.run([perfora, "report", str(source), "-o", str(pages[-1]), "--force", "--quiet"], check=True)
        expect(pages[-1].stat().st_size < 5_000_000, f"{pages[-1].name}: larger than 5 MB")
    driver = browser("--enable-unsafe-swiftshader")
    for page in pages:
        check_page(driver, page, 1280, "light")
    check_page(driver, pages[0], 390, "light")
    check_page(driver, pages[1], 390, "dark")
    check_viewer(driver, pages[0], "canvas")  # the browser draws WebGL without a graphics card, which is slower
    check_viewer(driver, pages[0], "webgl", "#webgl")
    # A browser of before 2023: no DecompressionStream.
    script = driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": "delete window.DecompressionStream;"})
    show(driver, pages[0], 1280)
    expect(driver.execute_script("return document.documentElement.dataset.block") == "shown", "no block without DecompressionStream")
    driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)
    driver.quit()
    driver = browser("--disable-3d-apis", "--disable-gpu")
    check_viewer(driver, pages[0], "canvas")
    driver.quit()
    print("failed" if failures else f"{len(pages)} reports opened, drawn and moved through")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
