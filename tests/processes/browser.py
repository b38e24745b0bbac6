"""Starts headless Chromium (Debian's chromium and chromium-driver) for the tests of pages."""

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

DESKTOP, PHONE = (1280, 800), (390, 844)
PATIENCE_S = 60


def open_browser(folder):
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", f"--user-data-dir={folder}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def set_size(browser, size, dark=False):
    width, height = size
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                            {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})


def wait(browser, script, what):
    return WebDriverWait(browser, PATIENCE_S, 0.05).until(lambda _: browser.execute_script("return " + script), what)


def widths(browser):
    """(width that the content needs, width of the window) in pixels."""
    return tuple(browser.execute_script("return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"))
