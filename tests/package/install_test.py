"""Tests the installed files. Usage: install_test.py CMAKE BUILD SOURCE."""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE = sys.argv[1:4]


def run(*command, code=0, **options):
    ended = subprocess.run(command, capture_output=True, text=True, **options)
    if ended.returncode != code:
        raise AssertionError(f"{command}: exit code {ended.returncode}\n{ended.stdout}{ended.stderr}")
    return ended.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="canhil-install-")
        cls.prefix = os.path.join(cls.folder.name, "usr")
        run(CMAKE, "--install", BUILD, "--prefix", cls.prefix)
        cls.flights = os.path.join(cls.prefix, "share/canhil/flights")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def program(self, name):
        return os.path.join(self.prefix, "bin", name)

    def test_flies_against_the_target_beside_it(self):
        out = run(self.program("hil-bench"), "run", f"{self.flights}/transfer_alignment_quick.toml", "--lockstep",
                  "--log", f"{self.folder.name}/run.pcap", code=3, cwd=self.folder.name)
        self.assertIn("PASS          error attitude.heading", out)

    def test_python_finds_the_package_and_its_plugin(self):
        out = run(sys.executable, "-c", "import canhil, importlib.metadata as m\n"
                  f"print(canhil.run('{self.flights}/los_quick.toml', bus='in-process').verdict)\n"
                  "print(m.version('canhil'), [one.value for one in m.entry_points(group='pytest11') if one.name == 'canhil'])",
                  cwd=self.folder.name, env=os.environ | {"PYTHONPATH": f"{self.prefix}/lib/python3/dist-packages",
                                                          "PATH": f"{self.prefix}/bin:/usr/bin:/bin"})
        version = re.search(r"project\(canhil VERSION (\S+)", open(f"{SOURCE}/CMakeLists.txt").read())[1]
        self.assertEqual(out, f"not measured\n{version} ['canhil.pytest_plugin']\n")

    def test_finds_its_own_data(self):
        out = run(self.program("hil-bench"), "conformance", code=0, cwd=self.folder.name)
        self.assertIn("rules kept", out)
        out = run(self.program("hil-bench"), "accept", "--estimator", "wind", "--family", "protocol", cwd=self.folder.name)
        self.assertNotIn(SOURCE, out)

    def test_knows_no_folder_of_the_build(self):
        for name in glob.glob(f"{self.prefix}/lib/**/*.cmake", recursive=True) + glob.glob(f"{self.prefix}/share/**/*", recursive=True):
            if os.path.isfile(name):
                with open(name, errors="replace") as file:
                    self.assertNotIn(BUILD, file.read(), name)

    def test_a_program_out_of_the_tree_is_built_with_it(self):
        build = f"{self.folder.name}/consumer"
        run(CMAKE, "-S", f"{SOURCE}/tests/package/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", build)
        log = f"{self.folder.name}/consumer.log"
        run(self.program("hil-bench"), "run", f"{self.flights}/transfer_alignment_quick.toml", "--lockstep", "--log", log, code=3)
        self.assertRegex(run(f"{build}/consumer", log), r"^\d\d+ answers; 88 km/h in 8 bytes; gravity 9\.79\d\d m/s\^2\n$")

    def test_the_manual_has_a_page_for_each_command(self):
        commands = re.findall(r"^  ([a-z][a-z-]*) ", run(self.program("hil-bench"), "--help").split("Subcommands:")[1], re.MULTILINE)
        self.assertGreater(len(commands), 12)
        for name in ["hil-bench", "hil-target", "dbcgen"] + [f"hil-bench-{command}" for command in commands]:
            path = f"{self.prefix}/share/man/man1/{name}.1"
            self.assertTrue(os.path.exists(path), path)
            with open(path) as file:
                page = file.read()
            self.assertIn(".SH NAME", page)
            self.assertNotIn(BUILD, page)

    def unit(self):
        path = f"{self.prefix}/lib/systemd/system/hil-target@.service"
        with open(path) as file:
            return path, file.read()

    def test_the_unit_starts_the_program_that_was_installed(self):
        start = re.search(r"^ExecStart=(\S+) (.*)$", self.unit()[1], re.MULTILINE)
        self.assertEqual(start[1], self.program("hil-target"))
        options = re.findall(r"--[a-z-]+", start[2])
        self.assertEqual(options, ["--bus", "--realtime"])
        known = run(start[1], "--help")
        for option in options:
            self.assertIn(f" {option} ", known)

    def test_systemd_takes_the_unit(self):
        def verify(path):
            ended = subprocess.run(["systemd-analyze", "verify", "--man=no", path], capture_output=True, text=True)
            return ended.returncode, ended.stdout + ended.stderr

        path, text = self.unit()
        self.assertEqual(verify(path), (0, ""))
        wrong = f"{self.folder.name}/wrong@.service"
        with open(wrong, "w") as file:
            file.write(text.replace("ProtectHome=", "ProtectHouse="))
        self.assertIn("ProtectHouse", verify(wrong)[1])

    def completed(self, *words):
        script = (f"source {self.prefix}/share/bash-completion/completions/hil-bench; "
                  'COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _canhil; printf "%s\\n" "${COMPREPLY[@]}"')
        return run("bash", "-c", script, "bash", self.program("hil-bench"), *words).split()

    def test_the_shell_completes_commands_and_options(self):
        self.assertIn("run", self.completed("r"))
        self.assertIn("replay", self.completed("r"))
        self.assertEqual(self.completed("run", "--lockst"), ["--lockstep"])
        self.assertEqual(self.completed("log", "conv"), ["convert"])
        self.assertIn("--estimator", self.completed("accept", "--"))


unittest.main(argv=sys.argv[:1])
