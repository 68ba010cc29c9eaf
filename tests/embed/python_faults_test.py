# SPDX-License-Identifier: Apache-2.0
"""The Python module: faults, interrupts, threads.

in: the module in the path -> out: exit 0. docs/python.md
"""

import math
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np
import pileus

from python_scenes import CUMULUS, POSITION, RAYMARCH, TARGET, open_session


class Versions(unittest.TestCase):
    def test_a_module_of_an_old_pybind11_refuses_numpy_2_in_one_line(self):
        built = pileus._core.pybind11
        for version in ("2.0.0", "10.1"):
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "numpy.py"), "w", encoding="ascii") as file:
                    file.write(f'__version__ = "{version}"\n')
                package = os.path.dirname(os.path.dirname(pileus.__file__))
                done = subprocess.run(
                    [sys.executable, "-c", "import pileus._core"], stderr=subprocess.PIPE, text=True,
                    env={**os.environ, "PYTHONPATH": folder + os.pathsep + package})
            if built >= (2, 12):
                self.assertNotIn("allowed: pybind11", done.stderr)
                continue
            self.assertEqual(
                done.stderr.splitlines()[-1],
                f"ImportError: pileus: NumPy {version} with a module that pybind11 {built[0]}.{built[1]} has "
                "built, allowed: pybind11 2.12 or newer, or NumPy 1")


class Faults(unittest.TestCase):
    def test_classes(self):
        for raised, also in ((pileus.BadInput, ValueError), (pileus.Limit, MemoryError),
                             (pileus.Io, OSError)):
            self.assertTrue(issubclass(raised, also) and issubclass(raised, pileus.Error))
        with self.assertRaisesRegex(pileus.BadInput, "nothing.toml: no such file"):
            pileus.Scene("nothing.toml")
        with self.assertRaisesRegex(pileus.BadInput, "(?s)camera.position_m: missing.*x: unknown"):
            pileus.Scene("[camera]\nx = 1\n")
        with self.assertRaises(pileus.Limit):
            pileus.World(pileus.Scene(CUMULUS), memory_limit=1000)
        with self.assertRaisesRegex(pileus.BadInput, "sse9"):
            pileus.World(pileus.Scene(CUMULUS), isa="sse9")
        with self.assertRaises(pileus.BadInput):
            pileus.Scene(CUMULUS, {"sun.elevation_deg": 91})
        with self.assertRaises(pileus.BadInput):
            pileus.Scene(CUMULUS, "sun.elevation_deg=1")
        with self.assertRaises(TypeError):
            pileus.World(pileus.Scene(CUMULUS), threads="two")

    def test_a_fault_leaves_the_session_as_it_was(self):
        session = open_session()
        first = session.render(hash=True).hash
        for wrong in (lambda: session.set_sun(0, 91), lambda: session.set_sun(0),
                      lambda: session.set_camera(TARGET, TARGET),
                      lambda: session.set_camera(POSITION, (1, 2)),
                      lambda: session.set_camera(POSITION, TARGET, size=(40000, 2)),
                      lambda: session.set_ground(2), lambda: session.set_frame(-1),
                      lambda: session.set_placement(yaw_deg=math.nan),
                      lambda: session.set_placement((0, 0, -1e4)),
                      lambda: session.set_environment(np.ones((4, 4, 3))),
                      lambda: session.set_environment(np.ones((4, 0, 3))),
                      lambda: session.set_camera(POSITION, TARGET, near=2, far=1),
                      lambda: session.set_camera(POSITION, TARGET, height=math.nan),
                      lambda: session.render(exposure=math.nan),
                      lambda: session.set_lamps([{"type": "lamp"}]),
                      lambda: session.set_lamps([{"type": "point"}]),
                      lambda: session.set_lamps([{"type": "directional", "radius": 1}]),
                      lambda: session.set_lamps([{"type": "spot", "position": (1, 2, 3)}]),
                      lambda: session.set_matrices(np.eye(3), np.eye(4)),
                      lambda: session.set_depth(np.ones((14, 24)), "buffer"),
                      lambda: session.render(blend="under")):
            with self.assertRaises(pileus.BadInput):
                wrong()
        self.assertEqual(session.render(hash=True).hash, first)

    def test_overrides_are_toml(self):
        listed = pileus.Scene(CUMULUS, ["camera.resolution=[5,4]", "method.name=raymarch"])
        kept = pileus.Scene(CUMULUS, {"camera.resolution": np.array([5, 4]), **RAYMARCH,
                                      "medium.0.phase": {"type": "isotropic"},
                                      "sun.elevation_deg": np.float32(20)})
        for scene in (listed, kept):
            self.assertEqual(pileus.Session(pileus.World(scene)).size, (5, 4))
        # Of cells that are too deep to keep light in each is three along every edge.
        self.assertEqual(listed.plan()["cells"], (72, 72, 48))

    def test_ctrl_c_ends_a_step(self):
        session = open_session("path")
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            session.step(2**32 - 1)
        timer.join()
        session.step(1)
        self.assertGreater(session.progress.units, 0)
        self.assertGreater(session.render()[..., :3].max(), 0)

    def test_a_doubtful_picture_warns(self):
        session = open_session("collectors", **{"medium.0.extinction_per_m": 1e-9})
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            session.render()
        self.assertTrue(all(w.category is pileus.PictureWarning for w in told))


class Threads(unittest.TestCase):
    def test_two_sessions_of_one_world(self):
        world = pileus.World(pileus.Scene(CUMULUS, RAYMARCH))
        expected = {}
        for method in ("raymarch", "path"):
            expected[method] = pileus.render(CUMULUS, overrides={"method.name": method}, hash=True).hash
        found, faults = {"raymarch": set(), "path": set()}, []

        def work(method):
            try:
                scene = pileus.Scene(CUMULUS, {"method.name": method})
                session = pileus.Session(world, scene, threads=1)
                for _ in range(5):
                    session.set_frame(1)
                    session.render()
                    session.set_frame(0)
                    session.step()
                    found[method].add(session.render(hash=True).hash)
            except Exception as fault:  # pylint: disable=broad-except
                faults.append(fault)

        threads = [threading.Thread(target=work, args=(m,)) for m in found]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])
        for method, hashes in found.items():
            self.assertEqual(hashes, {expected[method]})

    def test_python_runs_while_the_library_works(self):
        session = open_session("path")
        ended, counted = threading.Event(), 0
        worker = threading.Thread(target=lambda: (session.step(300), ended.set()))
        worker.start()
        refused = 0
        while not ended.is_set():
            counted += 1
            try:
                session.render()
            except pileus.BadInput:
                refused += 1
            ended.wait(0.001)
        worker.join()
        self.assertGreater(counted, 5)
        self.assertGreater(refused, 0)  # one session serves one thread at a time
        self.assertGreaterEqual(session.progress.units, 1)

    def test_a_world_outlives_its_name(self):
        session = open_session()
        scene = pileus.Scene(CUMULUS, RAYMARCH)
        other = pileus.Session(session.world, scene)
        first = session.render(hash=True).hash
        del session, scene
        self.assertEqual(other.render(hash=True).hash, first)


if __name__ == "__main__":
    unittest.main()
