"""Small cases of the tests, and what they share."""

import contextlib
import os
import tempfile
import unittest

import cnem


def block(**changes):
    """A punch goes into the left of a block; 21 rows of history."""
    case = {
        "time": {"end": "2 us"},
        "domain": {"material": "lib:304L", "outer": {"rectangle": {"from": "0 0 mm", "to": "4 2 mm"}}},
        "cloud": {"spacing": "0.4 mm"},
        "boundary": {"base": {"pieces": ["bottom"], "symmetry": True}},
        "tools": {"punch": {"rectangle": {"from": "-1 2 mm", "to": "1.1 4 mm"}, "velocity": "0 -30 m/s"}},
        "output": {"history_every": "0.1 us", "picture_fields": ["plastic_strain"]},
    }
    case.update(changes)
    return case


def adapted():
    """The same with a cloud that changes."""
    case = block(
        method={"rereference": {"every": 20, "strain": 0.05}},
        adapt={
            "resample": True,
            "tool_spacing": "0.2 mm",
            "indicator": {"field": "plastic_strain", "h_min": "0.15 mm"},
        },
    )
    case["tools"]["punch"]["velocity"] = "0 -100 m/s"
    return case


def pulled():
    """A block in tension, in equilibrium."""
    return {
        "analysis": {"type": "static"},
        "domain": {"material": "steel", "outer": {"rectangle": {"from": "0 0 mm", "to": cnem.quantity((4.0, 2.0), "mm")}}},
        "cloud": {"spacing": "0.25 mm"},
        "materials": {
            "steel": {
                "density": "7850 kg/m3",
                "elastic": {"young": "210 GPa", "poisson": 0.3},
                "plastic": {"law": "perfect", "yield": "100 MPa"},
            }
        },
        "boundary": {
            "base": {"pieces": "bottom", "displacement": {"x": "0 m", "y": "0 m"}},
            "top": {"pieces": "top", "traction": "0 20 MPa"},
        },
    }


def bits(run, names=("plastic_strain", "temperature", "velocity_y", "stress_xy")):
    """The state and the history, byte by byte."""
    parts = [run.field(name).tobytes() for name in names] + [x.tobytes() for x in run.positions]
    return b"".join(parts + [run.history[name].tobytes() for name in run.history])


@contextlib.contextmanager
def printed():
    """What goes to the descriptors 1 and 2 meanwhile: a list that gets the two texts."""
    texts = []
    kept = [os.dup(fd) for fd in (1, 2)]
    files = [tempfile.TemporaryFile() for _ in kept]
    for fd, file in zip((1, 2), files):
        os.dup2(file.fileno(), fd)
    try:
        yield texts
    finally:
        for fd, old in zip((1, 2), kept):
            os.dup2(old, fd)
            os.close(old)
        for file in files:
            file.seek(0)
            texts.append(file.read().decode())
            file.close()


class InFolder(unittest.TestCase):
    """Each test has an empty folder of its own, and works in it."""

    def setUp(self):
        self._temporary = tempfile.TemporaryDirectory()
        self.folder = self._temporary.name
        self._before = os.getcwd()
        os.chdir(self.folder)

    def tearDown(self):
        os.chdir(self._before)
        self._temporary.cleanup()

    def files(self):
        return sorted(os.path.join(where, name) for where, _, names in os.walk(self.folder) for name in names)


__all__ = ["InFolder", "adapted", "bits", "block", "cnem", "printed", "pulled"]
