"""Runs the structure check on this tree, and shows on artificial trees that it detects each violation."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import structure  # noqa: E402  (found beside this file)

ROOT = Path(__file__).resolve().parents[3]
DBC = """BO_ 129 SlaveImuDeltaV: 8 SlaveImu
 SG_ delta_v_x_mps : 12|17@1- (2e-05,0) [-1.31|1.31] "m/s" Target
BO_ 386 MasterInsAttitude: 8 MasterIns
BA_ "E2eDataId" BO_ 129 16513;
"""
# A small tree that satisfies every rule; each case below violates one rule.
GOOD = {
    "dbc/canhil.dbc": DBC,
    "dbc/wire/frame.hpp": '#include "messages/canhil.hpp"\n'
                          "#include <cstdint>\n#include <tl/expected.hpp>\n",
    "dbc/wire/time_base.hpp": "#pragma once\n",
    "dbc/ports/port.hpp": '#include "dbc/wire/frame.hpp"\n',
    "target/main.cpp": '#include "dbc/ports/port.hpp"\n#include "target/device/device.hpp"\n',
    "target/device/device.hpp": '#include "dbc/wire/frame.hpp"\n#include "target/estimators/wind/filter.hpp"\n',
    "target/estimators/filtering/update.hpp": "#include <Eigen/Core>\n#include <array>\n",
    "target/estimators/wind/filter.hpp": '#include "target/estimators/filtering/update.hpp"\n'
                                         '#include "target/estimators/wind/model.hpp"\n',
    "target/estimators/wind/model.hpp": "#include <cmath>\n",
    "target/estimators/los_rate/model.hpp": '// #include "dbc/wire/frame.hpp"\n',
    "bench/main.cpp": '#include "bench/drive/runner.hpp"\n',
    "bench/drive/runner.hpp": '#include "bench/nodes/node.hpp"\n#include "target/device/device.hpp"\n',
    "bench/nodes/node.hpp": '#include "bench/world/truth.hpp"\n#include "dbc/wire/frame.hpp"\n',
    "bench/world/truth.hpp": "#include <fmt/format.h>\n",
    "bench/checks/timing.hpp": '#include "bench/world/truth.hpp"\nint limit = 129;\nauto m = "id = 129";\n',
    "docs/architecture.md": "See https://example.org/work/page and $HOME/work/x.\n",
}


def breaches_of(changes):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**GOOD, **changes}.items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return structure.check(folder)


class Tree(unittest.TestCase):
    def test_keeps_the_rules(self):
        self.assertTrue((ROOT / "dbc/canhil.dbc").is_file(), f"{ROOT} is not the project")
        breaches = structure.check(ROOT)
        self.assertFalse(breaches, "\n" + "\n".join(breaches))


class Checker(unittest.TestCase):
    def test_accepts_a_tree_that_keeps_the_rules(self):
        self.assertEqual(breaches_of({}), [])

    def expect(self, expected, changes):
        breaches = breaches_of(changes)
        self.assertTrue(any(expected in b for b in breaches), f"expected '{expected}' among {breaches}")

    def expect_include(self, name, included):
        line = f"#include {included}\n" if included.startswith("<") else f'#include "{included}"\n'
        self.expect(f"{name}:1: includes", {name: line})

    def test_estimators_stand_alone(self):
        wind = "target/estimators/wind/filter.hpp"
        for other in ("target/estimators/los_rate/model.hpp", "dbc/wire/frame.hpp", "messages/canhil.hpp",
                      "target/device/device.hpp", "bench/world/truth.hpp", "<fmt/format.h>", "<boost/asio.hpp>", "<math.h>", "<unistd.h>",
                      "<sys/time.h>", "<dbc/wire/frame.hpp>", "../los_rate/model.hpp", "model.hpp"):
            with self.subTest(other):
                self.expect_include(wind, other)
        self.expect_include("target/estimators/filtering/update.hpp", "target/estimators/wind/model.hpp")
        self.expect_include("target/estimators/all.hpp", "target/estimators/wind/model.hpp")

    def test_only_its_folder_names_a_plant(self):
        glide = {"bench/plant/glide/glide.hpp": "class Glider {};\n", "bench/plant/registry.cpp": "int glide = &glide::table;\n"}
        self.assertEqual(breaches_of(glide | {"bench/drive/flight.cpp": "int glider, glides;\n"}), [])
        for line in ("// The glide ends.\n", "int Glide;\n", 'auto key = "glide";\n', "GlidePlan plan;\n"):
            with self.subTest(line):
                self.expect("bench/drive/flight.cpp:1: names", glide | {"bench/drive/flight.cpp": line})

    def test_what_works_on_quantities_names_no_estimator(self):
        wind = {"bench/estimators/wind/wind.hpp": "int wind;\n"}
        for name in ("bench/campaign/series.cpp", "bench/quantities/samples.cpp", "bench/report/series.cpp", "bench/report/csv.cpp"):
            for text in ('auto name = "wind";\n', "auto f() { return seen.wind.size(); }\n", "messages::WindUpdate update;\n",
                         '#include "bench/estimators/wind/wind.hpp"\n'):
                with self.subTest(name=name, text=text):
                    self.expect(f"{name}:1: names", {**wind, name: text})
        self.assertEqual(breaches_of({**wind, "bench/campaign/series.cpp": "int window;  // not wind\n",
                                      "bench/estimators/wind/wind.cpp": "int wind;\n"}), [])

    def test_an_estimator_is_known_to_its_folder_and_the_registry_alone(self):
        odometry = {"bench/estimators/odometry/odometry.cpp": "using Group = AnswerGroup<OdometrySpeed, OdometryState>;\n",
                    "bench/estimators/registry.cpp": "const Estimator& one = odometry;\n",
                    "bench/papers/odometry/claims.cpp": 'auto name = "odometry";\n'}
        self.assertEqual(breaches_of({**odometry, "bench/drive/x.cpp": 'int odometry = 0; auto s = "odometry of a car";\n'}), [])
        for name in ("bench/protocol/monitor.cpp", "bench/checks/kinds/error.cpp", "bench/scenario/target_setup.cpp", "bench/nodes/registry.cpp"):
            for text in ('if (name == "odometry") return;\n', "auto speed = from_frame<OdometrySpeed>(frame);\n"):
                with self.subTest(name=name, text=text):
                    self.expect(f"{name}:1: names", {**odometry, name: text})

    def test_a_sensor_is_known_to_the_registry_alone(self):
        gps = {"bench/sensors/gps.hpp": "struct GpsSettings {};\nextern const struct Kind gps;\n", "bench/sensors/gps.cpp": '#include "bench/sensors/gps.hpp"\n',
               "bench/sensors/registry.cpp": '#include "bench/sensors/gps.hpp"\n'}
        self.assertEqual(breaches_of({**gps, "bench/nodes/gps.cpp": '#include "bench/sensors/gps.hpp"\n'}), [])
        for name in ("bench/drive/flight.cpp", "bench/report/summary.cpp", "bench/sensors/ssbl.cpp", "bench/nodes/registry.cpp"):
            with self.subTest(name):
                self.expect(f"{name}:1: includes bench/sensors/gps.hpp", {**gps, name: '#include "bench/sensors/gps.hpp"\n'})
        self.expect("bench/scenario/x.cpp:2: names GpsSettings", {**gps, "bench/scenario/x.cpp": "// GpsSettings\nGpsSettings all;\n"})

    def test_whose_dbc_it_is_only_bindings_and_the_protocol_know(self):
        for text in ("for (const auto& one : messages::all_messages) use(one);\n", "auto own = bindings::canhil();\n",
                     "auto& of = dynamic_cast<const mapping::Mapping&>(*scenario.binding);\n"):
            for name in ("bench/report/text.cpp", "bench/drive/session.cpp", "bench/faults/read.cpp", "bench/commands/run.cpp"):
                with self.subTest(name=name, text=text):
                    self.expect(f"{name}:1: names", {name: text})
            self.assertEqual(breaches_of({"bench/drive/mapped_dialect.cpp": text, "bench/bindings/canhil.cpp": text}), [])

    def test_a_sensor_knows_no_frame(self):
        for other in ("dbc/wire/frame.hpp", "bench/nodes/node.hpp"):
            with self.subTest(other):
                self.expect_include("bench/sensors/gps.cpp", other)
                self.expect_include("bench/faults/sensors/values.cpp", other)

    def test_dbc_knows_neither_side(self):
        for other in ("target/device/device.hpp", "bench/world/truth.hpp", "tests/unit/made.hpp"):
            with self.subTest(other):
                self.expect_include("dbc/wire/frame.hpp", other)

    def test_target_does_not_know_the_bench(self):
        for name in ("target/device/device.hpp", "target/main.cpp"):
            with self.subTest(name):
                self.expect_include(name, "bench/world/truth.hpp")
        self.expect_include("target/device/device.hpp", "target/options.hpp")

    def test_bench_knows_the_target_by_its_frames(self):
        for name in ("bench/main.cpp", "bench/nodes/node.hpp", "bench/world/truth.hpp", "bench/checks/timing.hpp"):
            with self.subTest(name):
                self.expect_include(name, "target/device/device.hpp")
        for name in ("bench/drive/runner.hpp", "bench/campaign/shard.hpp"):
            with self.subTest(name):
                self.expect_include(name, "target/estimators/wind/filter.hpp")
        self.assertEqual(breaches_of({"bench/drive/shard.hpp": '#include "target/device/device.hpp"\n'}), [])

    def test_checks_reach_neither_nodes_nor_target(self):
        timing = "bench/checks/timing.hpp"
        self.expect("reaches bench/nodes/node.hpp", {timing: '#include "bench/nodes/node.hpp"\n'})
        self.expect("reaches target/device/device.hpp", {timing: '#include "bench/drive/runner.hpp"\n'})

    def test_folders_form_no_cycle(self):
        self.expect("a cycle of folders", {"bench/world/truth.hpp": '#include "bench/nodes/node.hpp"\n'})
        self.expect("a cycle of folders", {"dbc/wire/time_base.hpp": '#include "dbc/parser/parse.hpp"\n',
                                           "dbc/parser/parse.hpp": '#include "dbc/ports/port.hpp"\n'})

        self.assertEqual(breaches_of({"bench/world/truth.hpp": '#include "bench/world/motion/turn.hpp"\n',
                                      "bench/world/motion/turn.hpp": '#include "bench/world/earth.hpp"\n'}), [])

    def test_folders_are_not_deep(self):
        def tower(floors):
            return {f"bench/floor{i}/x.hpp": f'#include "bench/floor{i + 1}/x.hpp"\n' for i in range(floors - 1)}

        self.assertEqual(breaches_of(tower(9)), [])
        self.expect("10 folders, expected at most 9", tower(10))

    def test_every_spelling_of_an_include_is_seen(self):
        for line in ('#include"bench/world/truth.hpp"', '  #  include\t"bench/world/truth.hpp" // why',
                     '/* x */ #include "bench/world/truth.hpp"', 'auto s = "/*";\n#include "bench/world/truth.hpp"'):
            with self.subTest(line):
                self.expect("includes bench/world/truth.hpp", {"dbc/wire/frame.hpp": line + "\n"})
        self.expect("includes by a macro", {"dbc/wire/frame.hpp": "#include HEADER\n"})

    def test_files_stay_readable(self):
        self.expect("401 lines", {"bench/world/truth.hpp": "\n" * 401})
        self.assertEqual(breaches_of({"bench/world/truth.hpp": "\n" * 400}), [])

    def test_names_say_something(self):
        for name in ("bench/world/utils.hpp", "bench/common/a.hpp", "target/device/frame_helper.cpp",
                     "dbc/wire/node_base.hpp", "tests/unit/BusManager/a.cpp".lower().replace("bus", "bus_")):
            with self.subTest(name):
                self.expect(f"{name}: named", {name: ""})
        self.expect("must end in .hpp or .cpp", {"bench/world/a.h": ""})
        self.assertEqual(breaches_of({"dbc/parser/database.hpp": ""}), [])

    def test_text_names_no_machine(self):
        for path in ("/" + "work/main", "/" + "home/someone/x", "/" + "root/x"):
            with self.subTest(path):
                self.expect("docs/x.md:2: ", {"docs/x.md": f"one\nsee {path}/y\n"})

    def test_tests_that_a_page_names_are_there(self):
        page = {"docs/duty.md": "one\nkept by `Wind.Blows`\n"}
        self.expect("docs/duty.md:2: there is no test Wind.Blows", page)
        self.assertEqual(breaches_of({**page, "tests/wind_test.cpp": "TEST(Wind, Blows) {}\n"}), [])

    def test_dbc_is_the_only_truth(self):
        for line in ("if (frame.id == 0x081) {}", "constexpr auto x = 0x182U;", "const int imu_id = 129;",
                     "case 386:", "send(Frame{.id = 129});", "e2e(0x4081);", "double scale = 2e-5;",
                     "x * 0.00002  // no", "int cycle_time_ms = 10;"):
            with self.subTest(line):
                changes = {"bench/world/truth.hpp": line + "\n"}
                if line.startswith("x *"):  # a number alone is not recognised as an id
                    self.assertEqual(breaches_of(changes), [])
                else:
                    self.expect("bench/world/truth.hpp:1: ", changes)
        self.assertEqual(breaches_of({"dbc/wire/frame.hpp": "auto id = 0x081;\n"}), [])


if __name__ == "__main__":
    unittest.main()
