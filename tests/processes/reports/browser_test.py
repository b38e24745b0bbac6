"""The page of a run in Chromium: browser_test.py HIL_BENCH [--keep FOLDER]

--keep: also stores the pictures of the page that stand in the documentation in FOLDER. They show flights of docs/tutorial.md in virtual time with
their seeds, so that every machine gets the same curves.
"""

import argparse
import functools
import http.server
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from browser import DESKTOP, PHONE, open_browser, set_size, wait, widths  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
STRICT = "sandbox; default-src 'none'; img-src 'self'; style-src 'self';"  # what Jenkins sends with archived files
FAULT = '[[fault]]\nname = "gyro bias"\nkind = "bias"\nquantity = "imu.rate.z"\nby_degps = 0.2\nfrom_s = 15\n'


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves a folder; under /strict/ the same files with the content policy of a CI server."""

    def translate_path(self, path):
        return super().translate_path(path.removeprefix("/strict"))

    def end_headers(self):
        if self.path.startswith("/strict"):
            self.send_header("Content-Security-Policy", STRICT)
        super().end_headers()

    def log_message(self, *_):
        pass


class Browser(unittest.TestCase):
    keep = None

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=cls.folder))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.report = cls.fly("run", "--bus", "in-process?bitrate=500000")
        cls.browser = open_browser(cls.folder / "profile")

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.shutdown()
        cls.temporary.cleanup()

    @classmethod
    def fly(cls, name, *arguments, flight="transfer_alignment"):
        """Flies a flight, that of the tutorial if none is named; writes its page to NAME.html. Returns its report."""
        page, report = cls.folder / f"{name}.html", cls.folder / f"{name}.json"
        done = subprocess.run([HIL_BENCH, "run", f"bench/flights/{flight}.toml", *arguments, "--html", page, "--json", report],
                              cwd=ROOT, capture_output=True, text=True)
        if done.returncode not in (0, 1, 3):  # pass, fail, not measured
            raise AssertionError(done.stderr)
        return json.loads(report.read_text())

    def open(self, name="run", size=DESKTOP, strict=False, dark=False):
        set_size(self.browser, size, dark)
        self.browser.get(f"http://127.0.0.1:{self.server.server_port}{'/strict' if strict else ''}/{name}.html")
        if not strict:
            wait(self.browser, "document.documentElement.dataset.plots > 0", "the script did not run")

    def series(self, quantity):
        return next(one for one in self.report["series"] if one["quantity"] == quantity)

    def plot(self, quantity):
        """The figure of a quantity over the whole run, in the middle of the window."""
        index = self.report["series"].index(self.series(quantity))
        figure = self.browser.find_element(By.ID, f"series-{index}")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", figure)
        return figure

    def place(self, figure, x, y):
        """The place of shares of the plotted area, relative to the middle of the drawing: what ActionChains wants."""
        return self.browser.execute_script("""
            const [svg, x, y] = arguments, inner = svg.querySelector("svg"), [left, top, width, height] = ["x", "y", "width", "height"].map(
              name => Number(inner.getAttribute(name))), box = svg.viewBox.baseVal, shown = svg.getBoundingClientRect();
            return [Math.round(((left + x * width) / box.width - 0.5) * shown.width), Math.round(((top + y * height) / box.height - 0.5) * shown.height)]""",
                                           self.drawing(figure), x, y)

    def drawing(self, figure):
        return figure.find_element(By.CSS_SELECTOR, "svg.lines")

    def view(self, figure):
        """The range of the axes: from, to, low, high."""
        x, y, width, height = map(float, figure.find_element(By.CSS_SELECTOR, "svg svg").get_dom_attribute("viewBox").split())
        return x, x + width, -y - height, -y

    def readout(self, figure):
        lines = figure.find_element(By.CSS_SELECTOR, ".readout").text.splitlines()
        return float(lines[0].split()[0]), dict(line.split(": ", 1) for line in lines[1:])

    def expect_value(self, figure, series):
        """The cursor shows the values of its time."""
        t_s, values = self.readout(figure)
        index = min(range(len(series["t_s"])), key=lambda i: abs(series["t_s"][i] - t_s))
        self.assertAlmostEqual(series["t_s"][index], t_s, places=4)
        shown = [float(word) for word in re.findall(r"-?[\d.]+(?:e[-+]\d+)?", values["estimate less truth"])]
        self.assertAlmostEqual(shown[0], series["low"][index], delta=5e-5 * abs(shown[0]) + 1e-12)
        self.assertAlmostEqual(shown[-1], series["high"][index], delta=5e-5 * abs(shown[-1]) + 1e-12)
        if series["sigma"][index] is not None:
            sigma = float(values["±3 sigma, as reported"].split()[0])
            self.assertAlmostEqual(sigma, 3 * series["sigma"][index], delta=1e-4 * sigma)
        return t_s

    def expect_fits(self, where):
        needed, there = widths(self.browser)
        self.assertLessEqual(needed, there, where)

    def test_fits_and_draws_its_curves_with_and_without_the_strict_policy(self):
        for strict in (False, True):
            for size in (DESKTOP, PHONE):
                where = f"strict: {strict}, {size}"
                self.open(size=size, strict=strict)
                self.browser.execute_cdp_cmd("DOM.getDocument", {})
                self.expect_fits(where)
                if strict:
                    messages = [entry["message"] for entry in self.browser.get_log("browser")]
                    self.assertTrue(any("style-src" in one for one in messages), f"the policy forbids nothing: {messages}")
                paths = self.curves_as_seen()
                self.assertGreater(len(paths), 2 * len(self.report["series"]), where)
                for one in paths:
                    self.assertTrue(one["seen"], f"{where}: {one}")

    def curves_as_seen(self):
        """Each curve of the plots, and whether it has a colour and a size on the screen."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll("svg.lines svg path[data-kind]")].map(path => {
              const style = getComputedStyle(path), box = path.getBoundingClientRect();
              return {curve: path.closest("article").querySelector("h3").textContent, stroke: style.stroke,
                      seen: style.stroke.startsWith("rgb(") && parseFloat(style.strokeWidth) > 1 && box.width + box.height > 20}; })""")

    def test_everything_opened_fits(self):
        for strict in (False, True):
            self.open(size=PHONE, strict=strict)
            for one in self.browser.find_elements(By.CSS_SELECTOR, "summary"):
                one.click()
            self.expect_fits(f"strict: {strict}")

    def test_tables_have_borders_and_outcomes_a_colour_under_the_strict_policy(self):
        self.open(strict=True)
        border, colour, words = self.browser.execute_script("""
            const cell = document.querySelector("#checks td"), outcome = document.querySelector("#checks font");
            return [getComputedStyle(cell).borderTopWidth, getComputedStyle(outcome).color, outcome.textContent]""")
        self.assertEqual(border, "1px")
        self.assertEqual(colour, "rgb(0, 96, 62)")
        self.assertEqual(words, "✓ pass")

    def test_the_cursor_shows_the_values_of_all_curves(self):
        self.open()
        series, figure = self.series("heading error"), self.plot("heading error")
        ActionChains(self.browser).move_to_element_with_offset(self.drawing(figure), *self.place(figure, 0.7, 0.3)).perform()
        first = self.expect_value(figure, series)
        self.assertAlmostEqual(first, 14, delta=0.2)  # of 20 s
        ActionChains(self.browser).move_to_element(figure.find_element(By.TAG_NAME, "h3")).perform()
        self.assertFalse(figure.find_element(By.CSS_SELECTOR, ".readout").is_displayed())

    def test_zooms_by_dragging_by_wheel_and_by_keys(self):
        self.open()
        series, figure = self.series("heading error"), self.plot("heading error")
        drawing, home = self.drawing(figure), self.view(figure)
        ActionChains(self.browser).move_to_element_with_offset(drawing, *self.place(figure, 0.8, 0.5)).click_and_hold() \
            .move_to_element_with_offset(drawing, *self.place(figure, 0.95, 0.52)).release().perform()
        from_s, to_s, low, high = self.view(figure)
        self.assertAlmostEqual(from_s, 16, delta=0.2)
        self.assertAlmostEqual(to_s, 19, delta=0.2)
        inside = [value for i, t_s in enumerate(series["t_s"]) if from_s <= t_s <= to_s for value in (series["low"][i], 3 * series["sigma"][i])]
        self.assertLess(high, 1.3 * max(inside))  # the other axis fits the curves
        self.assertGreaterEqual(high, max(inside))
        self.assertGreaterEqual(-low, max(inside))
        labels = [one.text for one in drawing.find_elements(By.CSS_SELECTOR, ".marks text")]
        self.assertIn("17", labels)
        self.assertIn("0", labels)
        ActionChains(self.browser).move_to_element_with_offset(drawing, *self.place(figure, 0.5, 0.5)).perform()
        self.assertAlmostEqual(self.expect_value(figure, series), 17.5, delta=0.2)
        ActionChains(self.browser).double_click().perform()
        self.assertEqual(self.view(figure), home)

        # A box zooms both axes.
        ActionChains(self.browser).move_to_element_with_offset(drawing, *self.place(figure, 0.1, 0.2)).click_and_hold() \
            .move_to_element_with_offset(drawing, *self.place(figure, 0.4, 0.8)).release().perform()
        box = self.view(figure)
        self.assertAlmostEqual(box[0], 2, delta=0.2)
        self.assertAlmostEqual((box[3] - box[2]) / (home[3] - home[2]), 0.6, delta=0.02)
        whole = figure.find_element(By.CSS_SELECTOR, ".whole")
        self.assertTrue(whole.is_displayed())
        whole.click()
        self.assertEqual(self.view(figure), home)
        self.assertFalse(whole.is_displayed())

        # The wheel scrolls the page; with Ctrl, it zooms.
        x, y = self.browser.execute_script("const box = arguments[0].getBoundingClientRect(); return [box.left + box.width * 0.6, box.top + box.height / 2]", drawing)
        self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": -200, "modifiers": 2})
        wait(self.browser, "document.querySelectorAll('.whole:not([hidden])').length == 1", "the wheel does not zoom")
        after = self.view(figure)
        self.assertAlmostEqual((after[1] - after[0]) / (home[1] - home[0]), 0.5, delta=0.02)

        # The keys do the same.
        self.browser.execute_script("arguments[0].focus()", drawing)
        ActionChains(self.browser).send_keys("0").perform()
        self.assertEqual(self.view(figure), home)
        ActionChains(self.browser).send_keys(Keys.ARROW_RIGHT * 5).perform()
        before = self.readout(figure)[0]
        ActionChains(self.browser).send_keys(Keys.ARROW_LEFT).perform()
        self.assertLess(self.readout(figure)[0], before)
        self.expect_value(figure, series)
        ActionChains(self.browser).send_keys("+").perform()
        self.assertLess(self.view(figure)[1], 11)
        ActionChains(self.browser).send_keys("-", "-").perform()
        self.assertEqual(self.view(figure), home)

    def test_the_legend_switches_curves_by_click_and_key(self):
        self.open()
        figure = self.plot("heading error")
        button = next(one for one in figure.find_elements(By.CSS_SELECTOR, ".legend button") if "3 sigma" in one.text)
        curve = self.drawing(figure).find_element(By.CSS_SELECTOR, f"svg [data-curve='{button.get_attribute('data-curve')}']")
        self.assertNotEqual(curve.get_dom_attribute("display"), "none")
        button.click()
        self.assertEqual(curve.get_dom_attribute("display"), "none")
        self.assertEqual(button.get_attribute("aria-pressed"), "false")
        ActionChains(self.browser).move_to_element_with_offset(self.drawing(figure), *self.place(figure, 0.7, 0.3)).perform()
        self.assertEqual(list(self.readout(figure)[1]), ["estimate less truth"])
        button.send_keys(Keys.SPACE)
        self.assertNotEqual(curve.get_dom_attribute("display"), "none")

    def test_touch(self):
        self.open(size=PHONE)
        self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": True})
        try:
            series, figure = self.series("heading error"), self.plot("heading error")
            middle = self.browser.execute_script(
                "const box = arguments[0].getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]", self.drawing(figure))

            def touch(kind, x=None):
                points = [] if x is None else [dict(zip("xy", map(sum, zip(middle, self.place(figure, x, 0.5)))))]
                self.browser.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

            touch("touchStart", 0.5)
            touch("touchEnd")
            self.assertAlmostEqual(self.expect_value(figure, series), 10, delta=0.2)
            touch("touchStart", 0.5)
            for x in (0.55, 0.6, 0.7, 0.75):
                touch("touchMove", x)
            touch("touchEnd")
            self.assertAlmostEqual(self.view(figure)[0], 10, delta=0.3)
            self.assertAlmostEqual(self.view(figure)[1], 15, delta=0.3)
            self.expect_fits("zoomed on a phone")
        finally:
            self.browser.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": False})

    def test_the_frames_around_the_worst_value_are_folded_at_their_check(self):
        self.open()
        check = next(one for one in self.report["checks"] if one["name"] == "error attitude.heading")
        row = self.browser.find_element(By.XPATH, "//tr[td/a='error attitude.heading']/following-sibling::tr[1]")
        table = row.find_element(By.TAG_NAME, "table")
        details = row.find_element(By.TAG_NAME, "details")
        self.assertIsNone(details.get_attribute("open"))
        row.find_element(By.TAG_NAME, "summary").click()
        self.assertEqual(details.get_attribute("open"), "true")
        marked = float(table.find_element(By.TAG_NAME, "b").text)
        self.assertAlmostEqual(marked, check["worst_at_s"], delta=0.011)  # a period of the samples
        self.assertIn("heading_deg", table.text)
        self.expect_fits("with frames")

    def test_pictures(self):
        if not self.keep:
            return
        faults = self.folder / "gyro.toml"
        faults.write_text(FAULT)
        self.fly("fault", "--bus", "in-process", "--faults", faults)
        bias = self.folder / "bias.toml"  # as in docs/examples/python/test_bias.py
        bias.write_text('[[fault]]\nname = "bias"\nkind = "bias"\nquantity = "seeker.error_pitch"\nby_mrad = 4\nfrom_s = 2.5\nto_s = 2.7\n')
        self.fly("python", "--bus", "in-process", "--faults", bias, flight="los_quick")
        only = "section:not(#{}),nav{{display:none}}".format
        no_head = "h1,.sub,.verdict,h2{display:none}body{padding-top:0}"
        self.picture("report_pass", 1000, only("checks"), height=920)
        self.picture("report_estimates", 1000, only("estimates") + no_head + ".figure:nth-of-type(n+5){display:none}")
        self.picture("report_latency", 1000, only("timing") + no_head, height=1120)
        self.picture("report_fault", 1000, only("estimates") + "h2,h3:not(.figure h3),.note,.figure:first-of-type,.figure:nth-of-type(n+4){display:none}",
                     page="fault")
        self.picture("report_fail", 420, only("checks"), page="fault", dark=True, height=1250)
        self.picture("report_cursor", 1000, only("estimates") + no_head, act=self.zoom_with_cursor)
        self.picture("report_frames", 1000, only("checks") + no_head, act=self.open_frames, height=760)
        self.picture("python_fail", 1000, only("estimates") + "h1,.sub,h3:not(.figure h3),.note,.figure:first-of-type,.figure:nth-of-type(n+4){display:none}",
                     page="python")
        self.picture("report_strict", 1000, None, strict=True, height=760)

    def picture(self, name, width, style, page="run", act=None, height=None, **how):
        """Takes a picture of a page; the CSS in `style` hides other parts of it. Without a height, all of it."""
        self.open(page, (width, 800), **how)
        self.browser.execute_script("""
            const sub = document.querySelector(".sub"); // without the time at which the page was made
            sub.innerHTML = sub.innerHTML.replace(/ · [-\\d<>wbr]+T[\\d:<>wbr]+Z/, "");
            if (arguments[0]) document.head.appendChild(document.createElement("style")).textContent = arguments[0]""", style)
        if act:
            act()
        height = height or self.browser.execute_script("return Math.ceil(document.body.getBoundingClientRect().height) - 40")
        self.browser.execute_script("scrollTo(0, 0)")
        set_size(self.browser, (width, height), how.get("dark", False))
        time.sleep(0.5)
        self.browser.save_screenshot(str(pathlib.Path(self.keep) / f"{name}.png"))

    def zoom_with_cursor(self):
        figure = self.plot("heading error")
        self.browser.execute_script("""
            const figure = arguments[0], second = figure.nextElementSibling;
            for (const one of document.querySelectorAll("#estimates .figure, #estimates h3:not(.figure h3)"))
              if (one !== figure && one !== second) one.remove();""", figure)
        drawing = self.drawing(figure)
        ActionChains(self.browser).move_to_element_with_offset(drawing, *self.place(figure, 0.56, 0.5)).click_and_hold() \
            .move_to_element_with_offset(drawing, *self.place(figure, 0.8, 0.52)).release() \
            .move_to_element_with_offset(drawing, *self.place(figure, 0.3, 0.5)).perform()

    def open_frames(self):
        rows = self.browser.find_elements(By.CSS_SELECTOR, "#checks table:not(.frames) > tbody > tr")
        self.browser.execute_script("for (const row of arguments[0]) row.remove()", rows[:1] + rows[5:])
        rows[2].find_element(By.TAG_NAME, "summary").click()

    def test_the_script_has_no_errors(self):
        self.browser.get_log("browser")
        self.open()
        severe = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]
        self.assertEqual(severe, [])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hil_bench")
    parser.add_argument("--keep", metavar="FOLDER")
    arguments, rest = parser.parse_known_args()
    HIL_BENCH, Browser.keep = arguments.hil_bench, arguments.keep
    unittest.main(argv=[sys.argv[0], *rest])
