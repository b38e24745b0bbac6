"""The live view's page in Chromium: browser_test.py HIL_BENCH [--keep FOLDER]

--keep: also flies a scenario of 20 s with faults, and stores pictures of the page, taken in the middle of the flight, in FOLDER: live_desktop.png, live_phone.png.
"""

import argparse
import json
import pathlib
import sys
import tempfile
import time
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from browser import DESKTOP, PHONE, open_browser, set_size, wait, widths  # noqa: E402
from client import FLIGHTS, Bench  # noqa: E402


def charts(browser):
    """{name of a chart: its properties}: number of points, last value, and whether its canvas shows a curve."""
    return {one["name"]: one for one in browser.execute_script("""
        return [...document.querySelectorAll("#series .chart")].map(box => ({name: box.dataset.quantity,
          points: Number(box.dataset.points), last: Number(box.dataset.last),
          drawn: [...box.querySelector("canvas").getContext("2d").getImageData(0, 0, 300, 150).data].some(byte => byte > 0)}))""")}


class Browser(unittest.TestCase):
    keep = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.browser = open_browser(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.folder.cleanup()

    def press(self, key):
        ActionChains(self.browser).send_keys(key).perform()

    def text(self, identifier):
        return self.browser.find_element(By.ID, identifier).text

    def expect_no_errors(self):
        severe = [entry["message"] for entry in self.browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(severe, [])

    def test_a_flight_from_its_middle_to_its_end(self):
        browser = self.browser
        set_size(browser, DESKTOP)
        with Bench(HIL_BENCH, "run", FLIGHTS / "wind_quick.toml", "--json", "run.json", "--live-hold") as bench:
            browser.get(bench.url)
            wait(browser, "document.querySelectorAll('#series .chart').length > 0", "no charts")
            self.assertIn("running", self.text("state"))
            self.assertTrue(all(one["points"] > 0 for one in charts(browser).values()))

            # The display is paused; the page still receives data.
            self.press(" ")
            self.assertIn("paused", self.text("state"))
            shown, received = self.text("tiles"), browser.execute_script("return document.body.dataset.received")
            wait(browser, f"document.body.dataset.received > {received} + 2", "no messages while it is paused")
            self.assertEqual(self.text("tiles"), shown)
            self.press(" ")
            self.assertNotIn("paused", self.text("state"))
            self.assertNotEqual(self.text("tiles"), shown)

            wait(browser, "document.body.dataset.shown === 'over'", "the end is not shown")
            bench.await_line("(page stays)")
            report = json.loads(pathlib.Path(bench.folder.name, "run.json").read_text())
            self.assertEqual(self.text("state"), report["verdict"])
            self.assertIn(report["reason"], self.text("reason"))
            drawn = charts(browser)
            errors = [series for series in report["series"] if series["kind"] in ("error", "statistic")]
            self.assertEqual(set(drawn), {series["name"] for series in errors})
            for series in errors:
                one = drawn[series["name"]]
                self.assertTrue(one["drawn"], series["quantity"])
                self.assertEqual(one["points"], len(series["t_s"]))
                if series["high"][-1] is not None:
                    self.assertEqual(one["last"], series["high"][-1])
            rows = {row.find_elements(By.TAG_NAME, "td")[0].text: [cell.text for cell in row.find_elements(By.TAG_NAME, "td")]
                    for row in browser.find_elements(By.CSS_SELECTOR, "#timing-table tbody tr")}
            self.assertEqual(set(rows), set(report["latency_s"]))
            for message, cells in rows.items():
                of = report["latency_s"][message]
                self.assertEqual(cells[1], str(of["count"]))
                self.assertAlmostEqual(float(cells[3]), 1e3 * of["p99"], delta=0.0006)
            self.assertEqual(len(browser.find_elements(By.CSS_SELECTOR, "#checks tbody tr")), len(report["checks"]))

            self.press("w")
            self.assertEqual(browser.find_element(By.ID, "range").get_attribute("aria-pressed"), "true")
            self.press("w")
            self.expect_no_errors()

            for size in (DESKTOP, PHONE):  # no element is wider than the page or overlaps another element
                set_size(browser, size)
                time.sleep(0.3)
                self.assertLessEqual(*widths(browser))
                overlapping = browser.execute_script("""
                    const boxes = [...document.querySelectorAll(".tile, .chart, section table")].map(e => e.getBoundingClientRect()).filter(b => b.width);
                    return boxes.filter((a, i) => boxes.some((b, k) => k > i && a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1)).length""")
                self.assertEqual(overlapping, 0)
            set_size(browser, DESKTOP)
            paper = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
            set_size(browser, DESKTOP, dark=True)
            self.assertNotEqual(browser.execute_script("return getComputedStyle(document.body).backgroundColor"), paper)

    def test_another_site_sees_nothing(self):
        with Bench(HIL_BENCH, "run", FLIGHTS / "transfer_alignment_quick.toml", "--lockstep", "--live-hold") as bench:
            self.browser.get("data:text/html,<title>elsewhere</title>")
            report = self.browser.execute_async_script(f"""
                const done = arguments[0], said = [];
                fetch("http://127.0.0.1:{bench.port}/").then(() => said.push("fetched"), () => said.push("no page")).then(() => {{
                  const socket = new WebSocket("ws://127.0.0.1:{bench.port}/live");
                  socket.onopen = () => done([...said, "opened"]);
                  socket.onerror = () => done([...said, "no socket"]);
                }});""")
            self.assertEqual(report, ["no page", "no socket"])

    def test_a_campaign(self):
        with Bench(HIL_BENCH, "campaign", FLIGHTS.parent / "monte_carlo/quick.toml", "--runs", "12", "--live-hold") as bench:
            self.browser.get(bench.url)
            wait(self.browser, "document.body.dataset.shown === 'over'", "the end is not shown")
            self.assertIn("completed", self.text("latest"))
            self.expect_no_errors()

    def test_pictures(self):
        if not self.keep:
            return
        folder = pathlib.Path(self.keep)
        faults = pathlib.Path(self.folder.name, "faults.toml")
        faults.write_text(PICTURED_FAULTS)
        # PICTURED is a relative path, because the picture of the page shows the path.
        (pathlib.Path(self.folder.name) / PICTURED).write_text((FLIGHTS / PICTURED).read_text())
        with Bench(HIL_BENCH, "run", PICTURED, "--faults", faults, "--bus", "local:?bitrate=500000", folder=self.folder.name) as bench:
            set_size(self.browser, DESKTOP)
            self.browser.get(bench.url)
            wait(self.browser, "model.message && model.message.flight.t_s > 13.5", "13.5 s do not come")
            for name, size, dark in (("live_desktop", DESKTOP, False), ("live_phone", PHONE, False), ("live_dark", DESKTOP, True), ("live_phone_dark", PHONE, True)):
                set_size(self.browser, size, dark)
                time.sleep(0.5)
                if not dark or self.all_pictures:
                    self.browser.save_screenshot(str(folder / f"{name}.png"))
                if self.all_pictures:
                    height = self.browser.execute_script("return document.documentElement.scrollHeight")
                    set_size(self.browser, (size[0], height), dark)
                    time.sleep(0.5)
                    self.browser.save_screenshot(str(folder / f"{name}_whole.png"))


PICTURED = "transfer_alignment.toml"
PICTURED_FAULTS = """
[[fault]]
name = "gyro z: bias of 0.2 deg/s"
kind = "bias"
quantity = "imu.rate.z"
by_degps = 0.2
from_s = 9
to_s = 15

[[fault]]
name = "master INS invalid"
kind = "invalid"
node = "master_ins"
from_s = 16
to_s = 17
"""

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("hil_bench")
    parser.add_argument("--keep", metavar="FOLDER")
    parser.add_argument("--all-pictures", action="store_true", help="with --keep: dark ones and whole pages too")
    arguments, rest = parser.parse_known_args()
    HIL_BENCH, Browser.keep, Browser.all_pictures = arguments.hil_bench, arguments.keep, arguments.all_pictures
    unittest.main(argv=[sys.argv[0], *rest])
