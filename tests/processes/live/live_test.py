"""Tests the server of the live view over HTTP and WebSocket: live_test.py HIL_BENCH CASE."""

import json
import pathlib
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True
from client import Bench, FLIGHTS, ROOT, WebSocket, connect, exchange, get  # noqa: E402

HIL_BENCH = sys.argv[1]
QUICK = FLIGHTS / "transfer_alignment_quick.toml"
LOCKSTEP = ("run", QUICK, "--lockstep", "--live-hold")
MOST = 16  # the number of connections that the bench accepts


class Page(unittest.TestCase):
    def test_is_there_with_all_its_files_and_asks_for_nothing_else(self):
        with Bench(HIL_BENCH, *LOCKSTEP) as bench:
            for target, kind in (("/", "text/html"), ("/style.css", "text/css"), ("/script.js", "text/javascript"), ("/chart.js", "text/javascript")):
                status, headers, body = get(bench.port, target)
                self.assertEqual(status, 200, target)
                self.assertTrue(headers["content-type"].startswith(kind), target)
                self.assertIn("default-src 'none'", headers["content-security-policy"])
                self.assertEqual(len(body), int(headers["content-length"]))
                if target != "/chart.js":  # its licence contains addresses
                    self.assertNotIn(b"http", body.replace(b"http-equiv", b""), target)
            bench.await_line("(page stays)")
            code, out = bench.interrupt()
            self.assertEqual(code, 3, out)  # not measured, because lockstep does not judge timing

    def test_a_port_in_use_is_refused_in_one_line(self):
        with Bench(HIL_BENCH, *LOCKSTEP) as bench:
            second = subprocess.run([HIL_BENCH, "run", QUICK, "--live", str(bench.port)], capture_output=True, text=True, timeout=60)
            self.assertEqual(second.returncode, 2)
            self.assertEqual(second.stdout, "")
            self.assertRegex(second.stderr, rf"\Ahil-bench: --live {bench.port}: the port is in use, expected .*\n\Z")

    def test_wrong_options_are_refused_in_one_line(self):
        for words, what in ((["--live", "70000"], "70000"), (["--live", "abc"], "abc"), (["--live-hold"], "--live"),
                            (["--live", "0", "--live-address", "nowhere"], "nowhere")):
            with self.subTest(words):
                refused = subprocess.run([HIL_BENCH, "run", QUICK, *words], capture_output=True, text=True, timeout=60)
                self.assertEqual(refused.returncode, 2)
                self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)
                self.assertIn(what, refused.stderr)


class Refusals(unittest.TestCase):
    def test_pages_of_other_sites(self):
        with Bench(HIL_BENCH, *LOCKSTEP) as bench:
            here = f"http://127.0.0.1:{bench.port}"
            self.assertEqual(get(bench.port, Host="evil.example")[0], 421)
            self.assertEqual(get(bench.port, Origin="http://evil.example")[0], 403)
            for headers, status in (({"Origin": "http://evil.example"}, 403), ({"Origin": "null"}, 403),
                                    ({"Host": f"evil.example:{bench.port}", "Origin": f"http://evil.example:{bench.port}"}, 421)):
                with self.subTest(headers), self.assertRaises(ConnectionError) as refused:
                    WebSocket(bench.port, **headers)
                self.assertEqual(refused.exception.args[0], status)
            WebSocket(bench.port, Origin=here).close()

    def test_what_is_no_request_for_the_page(self):
        with Bench(HIL_BENCH, *LOCKSTEP) as bench:
            self.assertEqual(get(bench.port, "/nothing")[0], 404)
            self.assertEqual(get(bench.port, "/../page.html")[0], 404)
            self.assertEqual(get(bench.port, "/live")[0], 426)
            for method in ("POST", "HEAD", "DELETE", "OPTIONS"):
                self.assertEqual(get(bench.port, method=method)[0], 405)
            self.assertIn(get(bench.port, "/" + "x" * 20_000)[0], (0, 400))
            self.assertIn(get(bench.port, X="y" * 20_000)[0], (0, 400))
            self.assertIn(exchange(bench.port, b"\x00\xff" * 100 + b"\r\n\r\n")[0], (0, 400))
            body = b"GET / HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nContent-Length: 1000000\r\n\r\n" % bench.port
            self.assertIn(exchange(bench.port, body + b"z" * 1000)[0], (0, 400, 413))
            speaks = WebSocket(bench.port)
            speaks.send(b"x" * 100)
            while speaks.message() is not None:
                pass  # ends when the bench closes the connection; the bench does so because the client sent data
            self.assertEqual(get(bench.port)[0], 200)

    def test_without_the_token(self):
        with Bench(HIL_BENCH, *LOCKSTEP, live=("--live", "0", "--live-address", "0.0.0.0")) as bench:
            self.assertRegex(bench.query, r"\A\?token=[0-9a-f]{32}\Z")
            for target in ("/", "/chart.js", "/?token=", "/?token=" + "0" * 32):
                self.assertEqual(get(bench.port, target)[0], 403, target)
            with self.assertRaises(ConnectionError):
                WebSocket(bench.port)
            status, _, page = get(bench.port, "/" + bench.query)
            self.assertEqual(status, 200)
            self.assertIn(f'src="script.js{bench.query}"'.encode(), page)
            self.assertTrue(WebSocket(bench.port, "/live" + bench.query).message())

    def test_more_connections_than_there_are_places(self):
        with Bench(HIL_BENCH, *LOCKSTEP) as bench:
            first = [WebSocket(bench.port) for _ in range(MOST)]
            self.assertTrue(all(one.message() for one in first))
            with self.assertRaises(ConnectionError):
                WebSocket(bench.port)
            self.assertEqual(get(bench.port)[0], 0)
            for one in first[:4]:
                one.close()
            for _ in range(100):  # the bench detects the closed connections with a delay
                if get(bench.port)[0] == 200:
                    break
                time.sleep(0.05)
            self.assertEqual(get(bench.port)[0], 200)
            silent = [connect(bench.port) for _ in range(MOST)]  # the bench disconnects silent clients
            for one in silent:
                one.settimeout(30)
                self.assertEqual(one.recv(1), b"")
            self.assertEqual(get(bench.port)[0], 200)


def without_host(report):
    """The report without the entries that differ from run to run."""
    for key in ("wall_s", "timing", "target_timing_us"):
        report.pop(key, None)
    report["provenance"].pop("date")
    return report


class Run(unittest.TestCase):
    def test_is_bit_for_bit_the_same_in_lockstep(self):
        with Bench(HIL_BENCH, "run", QUICK, "--lockstep", "--json", "live.json", "--log", "live.log") as bench:
            code, out = bench.end()
            folder = pathlib.Path(bench.folder.name)
            alone = subprocess.run([HIL_BENCH, "run", QUICK, "--lockstep", "--json", "alone.json", "--log", "alone.log"],
                                   capture_output=True, text=True, timeout=60, cwd=folder)
            self.assertEqual(alone.returncode, code)
            frames = [[line.split()[2:] for line in (folder / name).read_text().splitlines()] for name in ("live.log", "alone.log")]
            self.assertGreater(len(frames[0]), 1000)
            self.assertEqual(frames[0], frames[1])  # without the stamps, which come from the host's clock
            live, without = (without_host(json.loads((folder / name).read_text())) for name in ("live.json", "alone.json"))
            bus = live["provenance"].pop("bus"), without["provenance"].pop("bus")  # a private bus is named after its process
            live["provenance"].pop("adapters"), without["provenance"].pop("adapters")  # these contain the bus name too
            self.assertTrue(all(name.startswith("local:") for name in bus))
            self.assertEqual(live, without)

    def test_shows_a_flight_in_real_time_and_the_numbers_of_its_report_at_the_end(self):
        with Bench(HIL_BENCH, "run", QUICK, "--json", "run.json", "--live-hold") as bench:
            view = WebSocket(bench.port)
            times, before_end = [], None
            while True:
                message = view.message()
                if message["over"]:
                    break
                before_end = message
                times.append(message["flight"]["t_s"])
            self.assertEqual(times, sorted(times))
            self.assertGreater(len(set(times)), 3)  # the page received several updates during the run
            self.assertTrue(before_end["flight"]["series"])
            self.assertTrue(before_end["flight"]["timing"])
            self.assertTrue(all(check["outcome"] is None for check in before_end["flight"]["checks"]))
            bench.await_line("(page stays)")
            report = json.loads(pathlib.Path(bench.folder.name, "run.json").read_text())
            flight = message["flight"]
            self.assertEqual(flight["outcome"], report["verdict"])
            self.assertEqual([check["outcome"] for check in flight["checks"]], [check["outcome"] for check in report["checks"]])
            errors = [series for series in report["series"] if series["kind"] in ("error", "statistic")]
            self.assertEqual([series["name"] for series in flight["series"]], [series["name"] for series in errors])
            for shown, series in zip(flight["series"], errors):
                for key in ("t_s", "low", "high"):
                    self.assertEqual(shown[key], series[key], series["quantity"])
                if series["kind"] == "error":
                    self.assertEqual(shown["sigma"], series["sigma"], series["quantity"])
            self.assertEqual({line["message"] for line in flight["timing"]}, set(report["latency_s"]))
            for line in flight["timing"]:
                of = report["latency_s"][line["message"]]
                self.assertEqual(line["count"], of["count"])
                self.assertAlmostEqual(line["p99_us"] * 1e-6, of["p99"], delta=1e-4 * of["p99"])
                self.assertAlmostEqual(line["max_us"] * 1e-6, of["max"], delta=1e-4 * of["max"])
            self.assertEqual(flight["load"], report["bus_load_line"]["busiest"])
            late = WebSocket(bench.port).until_over()  # a client that connects later receives the same
            self.assertEqual(late["flight"]["series"], flight["series"])
            self.assertEqual(bench.interrupt()[0], {"pass": 0, "fail": 1, "not measured": 3}[report["verdict"]])

    def test_a_flight_that_does_not_begin_says_why(self):
        with Bench(HIL_BENCH, "run", QUICK, "--target", "false") as bench:
            try:
                last = WebSocket(bench.port).until_over()
            except ConnectionError:
                last = None  # the run ended before the client connected
            code, _ = bench.end()
            self.assertEqual(code, 2)
            if last is not None and last["over"]:
                self.assertIn("target", last["ended"])


class Batch(unittest.TestCase):
    def test_shows_a_campaign(self):
        with Bench(HIL_BENCH, "campaign", ROOT / "bench/monte_carlo/quick.toml", "--runs", "12", "--live-hold") as bench:
            last = WebSocket(bench.port).until_over()["batch"]
            self.assertEqual(last["done"], last["total"])
            self.assertGreaterEqual(last["total"], 12)
            self.assertEqual(last["failed"], 0)
            self.assertTrue(last["latest"])
            self.assertEqual(bench.interrupt()[0], {"pass": 0, "fail": 1, "not measured": 3}[last["outcome"]])

    def test_shows_a_matrix_of_faults(self):
        with Bench(HIL_BENCH, "faults", QUICK, "--shard", "0/8", "--live-hold") as bench:
            last = WebSocket(bench.port).until_over()["batch"]
            self.assertEqual(last["done"], last["total"])
            self.assertGreater(last["total"], 1)
            bench.interrupt()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
