"""What the independent filters share: the command line, and defects that accept must find.

The filters of this folder are written from docs/, the DBC and the corrected equations of the papers, with numerics of their own. They show that accept passes a correct filter
of another maker; with --defect they show that it does not pass a wrong one.
"""

import argparse
import pathlib
import sys

KIT = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/kit"
sys.path.insert(0, str(KIT))

import canhil_target  # noqa: E402  (the folder of the kit had to be named first)

DEFECTS = ("halved_sigma", "sign", "delay")


def defective(filter_class, defect, sign_of, delay_of):
    """The class with one defect. sign_of: signal that is read with the wrong sign; delay_of: signals that are read one sample of their group late."""

    class Defective(filter_class):
        def sample(self, group, values, t_us):
            values = dict(values)
            if defect == "sign" and sign_of in values:
                values[sign_of] = -values[sign_of]
            if defect == "delay":
                late = {name: values[name] for name in delay_of if name in values}
                values.update({name: self.late.get(name, value) for name, value in late.items()})
                self.late.update(late)
            return self.altered(super().sample(group, values, t_us))

        def start(self, algorithm, parameters, initial):
            self.late = {}
            return super().start(algorithm, parameters, initial)

        @staticmethod
        def altered(answer):
            if defect != "halved_sigma" or not answer:
                return answer
            return {name: value / 2 if "sigma" in name else value for name, value in answer.items()}

    return Defective


def main(filter_class, *, sign_of, delay_of, make_target=canhil_target.Target):
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__.splitlines()[0])
    parser.add_argument("--bus", required=True, help="can0, vcan0 or local:NAME; hil-bench appends it")
    parser.add_argument("--defect", choices=DEFECTS, help="make the filter wrong")
    given = parser.parse_args()
    if given.defect:
        filter_class = defective(filter_class, given.defect, sign_of, delay_of)
    sys.exit(canhil_target.serve(filter_class(), given.bus, make_target))
