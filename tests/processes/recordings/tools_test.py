"""Tests what docs/recordings.md says about other programs: tools_test.py HIL_BENCH CASE. Real programs (tshark, pandas) read the files."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "docs" / "examples" / "recordings"
HIL_BENCH = sys.argv[1]
SIGNALS = ("AlignAttitude.heading_deg", "AlignAttitude.coasting", "AlignVelocityNE.velocity_east_mps", "AlignVelocityD.cause_time_us",
           "MasterInsLatitude.latitude_deg", "MasterInsLatitude.height_m", "AlignAttitudeSigma.attitude_sigma_down_rad")

# Every kind of signal: byte orders, signs, lengths up to 64 bits, floats, multiplexing, J1939, value names.
ODD_DBC = r"""BU_: A
BO_ 291 Mixed: 8 A
 SG_ u12 : 0|12@1+ (0.5,-3) [0|0] "km/h" A
 SG_ s7 : 12|7@1- (1,0) [0|0] "" A
 SG_ motorola : 31|13@0- (0.25,1) [0|0] "" A
 SG_ last : 56|8@1+ (1,0) [0|0] "" A
BO_ 292 Wide: 8 A
 SG_ u64 : 0|64@1+ (1,0) [0|0] "" A
BO_ 293 WideSigned: 8 A
 SG_ s64 : 7|64@0- (1,0) [0|0] "" A
BO_ 294 Floats: 8 A
 SG_ f : 0|32@1- (1,0) [0|0] "" A
 SG_ g : 39|32@0- (2,1) [0|0] "" A
BO_ 295 Long: 8 A
 SG_ s40 : 3|40@1- (1,0) [0|0] "" A
BO_ 296 Mux: 4 A
 SG_ page M : 16|8@1+ (1,0) [0|0] "" A
 SG_ one m1 : 0|8@1+ (1,0) [0|0] "" A
 SG_ two m2 : 24|8@1+ (1,0) [0|0] "" A
BO_ 2566844926 CCVS1: 8 A
 SG_ Speed : 8|16@1+ (0.00390625,0) [0|250] "km/h" A
SIG_VALTYPE_ 294 f : 1;
SIG_VALTYPE_ 294 g : 1;
VAL_ 291 s7 -1 "minus \"one\"" ;
VAL_ 292 u64 18446744073709551615 "not available" ;
BA_DEF_ "ProtocolType" STRING ;
BA_ "ProtocolType" "J1939";
"""
ODD_LOG = """(1.000000) can0 123#FEF107FF8000002A
(2.000000) can0 123#FEF1
(3.000000) can0 124#FFFFFFFFFFFFFFFF
(4.000000) can0 124#406ABFE7E6120600
(5.000000) can0 125#FFFFFFFFFFFFFFFE
(6.000000) can0 125#8000000000000000
(7.000000) can0 126#CDCCCC3DC0200000
(8.000000) can0 127#F8FFFFFFFF070000
(9.000000) can0 127#0800000000040000
(10.000000) can0 128#05070211
(11.000000) can0 128#05070111
(12.000000) can0 128#0507
(13.000000) can0 18FEF100#FF0010FFFFFFFFFF
(14.000000) can0 18FEF200#FF0010FFFFFFFFFF
"""
ODD_SHOWN = """Mixed
u12: 252 km/h
s7: -1 (minus "one")
motorola: -3
last: 42
Mixed
u12: 252 km/h
s7: missing, the frame is too short
motorola: missing, the frame is too short
last: missing, the frame is too short
Wide
u64: 18446744073709551615 (not available)
Wide
u64: 1709632800123456
WideSigned
s64: -2
WideSigned
s64: -9223372036854775808
Floats
f: 0.100000001490116
g: -4
Long
s40: -1
Long
s40: -549755813887
Mux
page: 2
two: 17
Mux
page: 1
one: 5
Mux
page: missing, the frame is too short
CCVS1
Speed: 16 km/h"""


class InFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_in_folder(self, *words):
        done = subprocess.run(words, cwd=self.folder, capture_output=True, timeout=200, check=False, text=True)
        self.assertEqual(done.returncode, 0, (words, done.stderr[-1000:]))
        return done.stdout

    def decoded(self):
        """Records a run, and returns the rows of its CSV."""
        flight = ROOT / "bench" / "flights" / "transfer_alignment_quick.toml"
        subprocess.run([HIL_BENCH, "run", flight, "--bus", "in-process", "--log", "run.log"], cwd=self.folder, capture_output=True, check=False)
        self.run_in_folder(HIL_BENCH, "decode", "run.log", "--dbc", ROOT / "dbc" / "canhil.dbc", "--format", "csv", "--out", "run.csv")
        with open(self.folder / "run.csv", newline="") as file:
            return list(csv.DictReader(file))


class Pandas(InFolder):
    def test_the_example_prints_the_last_heading_of_each_second(self):
        newest = {}
        for row in self.decoded():
            if row["AlignAttitude.heading_deg"]:
                newest[int(float(row["t_s"]))] = float(row["AlignAttitude.heading_deg"])
        lines = self.run_in_folder("/usr/bin/python3", EXAMPLES / "heading.py", "run.csv").splitlines()
        self.assertEqual(lines[0].split(), ["t_s", "heading_deg", "sigma_deg"])
        self.assertEqual([float(line.split()[1]) for line in lines[1:]], list(newest.values()))
        self.assertGreater(float(lines[-1].split()[2]), 0)


class PlotJuggler(InFolder):
    def test_the_layout_has_columns_with_values(self):
        rows = self.decoded()
        layout = xml.etree.ElementTree.parse(EXAMPLES / "plotjuggler.xml").getroot()
        curves = [curve.get("name") for curve in layout.iter("curve")]
        self.assertGreater(len(curves), 5)
        for curve in curves:
            self.assertTrue(any(row[curve] for row in rows), curve)
        self.assertIn(layout.find("Plugins/plugin[@ID='DataLoad CSV']/default").get("time_axis"), rows[0])
        for splitter in layout.iter("DockSplitter"):
            self.assertEqual(int(splitter.get("count")), len(splitter.findall("DockArea")))


class Wireshark(InFolder):
    def script(self, dbc, name):
        self.run_in_folder(HIL_BENCH, "dbc", "wireshark", dbc, "--out", name)
        return f"lua_script:{name}"

    def test_tshark_shows_the_values_of_the_table(self):
        rows = self.decoded()
        self.run_in_folder(HIL_BENCH, "log", "convert", "run.log", "run.pcap")
        fields = [word for signal in SIGNALS for word in ("-e", f"dbc_canhil.{signal}")]
        script = self.script(ROOT / "dbc" / "canhil.dbc", "canhil.lua")
        shown = self.run_in_folder("tshark", "-X", script, "-r", "run.pcap", "-T", "fields", "-E", "separator=,", *fields).splitlines()
        self.assertEqual(len(shown), len(rows))
        compared = 0
        for row, line in zip(rows, shown):
            for signal, cell in zip(SIGNALS, line.split(",")):
                self.assertEqual(cell == "", row[signal] == "", (signal, line))
                if cell:
                    compared += 1
                    self.assertTrue(math.isclose(float(cell), float(row[signal]), rel_tol=1e-13), (signal, cell, row[signal]))
        self.assertGreater(compared, 1000)

    def test_tshark_shows_every_kind_of_signal(self):
        (self.folder / "odd.dbc").write_text(ODD_DBC)
        (self.folder / "odd.log").write_text(ODD_LOG)
        self.run_in_folder(HIL_BENCH, "log", "convert", "odd.log", "odd.pcap")
        script = self.script("odd.dbc", "odd.lua")
        text = self.run_in_folder("tshark", "-X", script, "-r", "odd.pcap", "-O", "dbc_odd", "-V")
        names = ("Mixed", "Wide", "WideSigned", "Floats", "Long", "Mux", "CCVS1")
        shown, inside = [], False
        for line in text.splitlines():
            inside = line in names or (inside and line.startswith("    "))
            if inside:
                shown.append(line.strip())
        self.assertEqual("\n".join(shown), ODD_SHOWN)
        chosen = self.run_in_folder("tshark", "-X", script, "-r", "odd.pcap", "-Y", "dbc_odd.Mixed.s7 == -1", "-T", "fields", "-e", "frame.number")
        self.assertEqual(chosen.split(), ["1"])


unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
