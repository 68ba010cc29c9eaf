# SPDX-License-Identifier: Apache-2.0
"""The Python module: the program's bits, memory written in place, what a session is set to.

in: PILEUS_PROGRAM, the module in the path -> out: exit 0. docs/python.md
"""

import json
import math
import os
import subprocess
import tempfile
import unittest

import numpy as np
import pileus

from python_scenes import BOX, CUMULUS, POSITION, RAYMARCH, TARGET, open_session


def program_report(folder, method):
    """What the program reports of the same scene, written to a picture as well."""
    scene = os.path.join(folder, "scene.toml")
    with open(scene, "w", encoding="ascii") as file:
        file.write(CUMULUS)
    picture = os.path.join(folder, method + ".pfm")
    text = subprocess.run(
        [os.environ["PILEUS_PROGRAM"], "render", scene, "-o", picture, "--report", "-", "-q", "--threads", "1",
         "--set", f'method.name="{method}"'],
        check=True, stdout=subprocess.PIPE).stdout
    return json.loads(text), picture


class Program(unittest.TestCase):
    def test_every_method_gives_the_bits_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            for method in ("raymarch", "path", "collectors"):
                with self.subTest(method):
                    theirs, _ = program_report(folder, method)
                    session = open_session(method) if method != "path" else pileus.Session(
                        pileus.World(pileus.Scene(CUMULUS, {"method.name": method})))
                    done = session.step()
                    self.assertEqual(done, session.progress.whole if session.progress.unit else 0)
                    self.assertEqual(session.render(hash=True).hash, theirs["digests"]["image"])
                    ours = session.report()
                    self.assertEqual(ours["hash"], theirs["hash"])
                    for key in ("photons", "generations", "paths", "samples_per_pixel", "energy",
                                "scatterings", "collectors", "seed", "method"):
                        self.assertEqual(ours[key], theirs[key], key)

    def test_the_array_holds_what_the_program_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            _, file = program_report(folder, "raymarch")
            with open(file, "rb") as pfm:
                for _ in range(3):
                    pfm.readline()
                theirs = np.frombuffer(pfm.read(), "<f4").reshape(14, 24, 3)[::-1]
            np.testing.assert_array_equal(pileus.render(CUMULUS, overrides=RAYMARCH)[..., :3], theirs)

    def test_figures_are_those_of_compare(self):
        with tempfile.TemporaryDirectory() as folder:
            files, pictures = [], []
            for method in ("raymarch", "path"):
                files.append(program_report(folder, method)[1])
                pictures.append(pileus.render(CUMULUS, overrides={"method.name": method}))
            text = subprocess.run([os.environ["PILEUS_PROGRAM"], "compare", *files, "--json"],
                                  check=True, stdout=subprocess.PIPE).stdout
            theirs = json.loads(text)
            # A .pfm has no alpha.
            ours = pileus.compare(pictures[0][..., :3], pictures[1][..., :3])
            for key in ("identical", "pixels", "cloud_pixels", "not_finite", "rmse", "relmse",
                        "relmse_trimmed", "bias", "largest", "percentile_999",
                        "relative_percentile_999"):
                self.assertEqual(getattr(ours, key), theirs[key], key)
            self.assertEqual(list(ours.largest_at), theirs["largest_at"])
            self.assertEqual(ours.mean, theirs["a"]["mean"])
            self.assertEqual(ours.flip, theirs["flip"]["mean"])
            self.assertEqual(ours.flip_percentile_99, theirs["flip"]["percentile_99"])
            self.assertLess(pileus.compare(*pictures, flip=False).cloud_pixels, ours.pixels)
        same = pileus.compare(pictures[0], pictures[0], flip=False)
        self.assertTrue(same.identical and same.relmse == 0 and math.isnan(same.flip))


class Arrays(unittest.TestCase):
    def setUp(self):
        self.session = open_session()
        self.picture = self.session.render()

    def test_new_arrays(self):
        for name, dtype in (("rgba32f", np.float32), ("rgba16f", np.float16), ("rgba8", np.uint8)):
            made = self.session.render(format=name)
            self.assertEqual((made.shape, made.dtype), ((14, 24, 4), dtype))
            self.assertTrue(made.flags.owndata and made.flags.c_contiguous)
        np.testing.assert_array_equal(self.session.render(format="rgba16f"),
                                      self.picture.astype(np.float16))
        self.assertIs(self.session.render(colour=False, depth=True).colour, None)

    def test_memory_of_the_caller_is_written_in_place(self):
        for dtype in (np.float32, np.float16, np.uint8):
            with self.subTest(dtype):
                fresh = self.session.render(np.empty((14, 24, 4), dtype))
                # Rows with a margin on both sides, from memory that is filled with a mark.
                around = np.full((18, 31, 4), 77, dtype)
                inside = around[2:16, 3:27]
                before = inside.__array_interface__["data"]
                self.assertIs(self.session.render(inside), inside)
                self.assertEqual(inside.__array_interface__["data"], before)
                np.testing.assert_array_equal(around[2:16, 3:27], fresh)
                around[2:16, 3:27] = 77
                self.assertTrue((around == 77).all())
                # Rows from the bottom up, by a negative stride and by the option: twice is once.
                self.session.render(around[::-1][2:16, 3:27])
                np.testing.assert_array_equal(around[2:16, 3:27], fresh[::-1])
                self.session.render(inside, bottom_up=True)
                np.testing.assert_array_equal(inside, fresh[::-1])
                self.session.render(around[::-1][2:16, 3:27], bottom_up=True)
                np.testing.assert_array_equal(around[2:16, 3:27], fresh)

    def test_depths_in_place(self):
        wide = np.zeros((14, 40), np.float32)
        got = self.session.render(depth=wide[:, 8:32], hash=True)
        new = self.session.render(depth=True, depth_kind="view_z")
        np.testing.assert_array_equal(got.colour, self.picture)
        self.assertTrue((wide[:, 8:32] > 0).all() and (wide[:, :8] == 0).all())
        near = np.isfinite(new.depth)
        self.assertTrue((new.depth[near] <= got.depth[near]).all() and near.any())
        np.testing.assert_array_equal(near, np.isfinite(got.depth))

    def test_what_cannot_be_written_in_place_is_refused_and_left_alone(self):
        s, f4 = self.session, np.float32
        read_only = np.zeros((14, 24, 4), f4)
        read_only.flags.writeable = False
        flipped = np.zeros((14, 24, 4), f4)[::-1]
        for refused, what in (
                (np.zeros((14, 24, 3), f4), "shape"), (np.zeros((24, 14, 4), f4), "shape"),
                (np.zeros((14, 24, 4)), "float64"), (np.zeros((14, 24, 4), ">f4"), ">f4"),
                (read_only, "read only"), (np.zeros((14, 24, 5), f4)[..., :4], "lie close"),
                (np.zeros((24, 14, 4), f4).transpose(1, 0, 2), "lie close"),
                (np.zeros((14, 48, 4), f4)[:, ::2], "lie close"),
                (np.lib.stride_tricks.as_strided(np.zeros((1, 24, 4), f4), (14, 24, 4),
                                                 (0, 16, 4)), "overlap"), ([[1]], "list")):
            with self.subTest(what), self.assertRaisesRegex(pileus.BadInput, what):
                s.render(refused)
        with self.assertRaisesRegex(ValueError, "the same way"):
            s.render(flipped, depth=np.zeros((14, 24), f4))
        with self.assertRaisesRegex(ValueError, "format rgba8"):
            s.render(flipped, format="rgba8")
        self.assertTrue((flipped == 0).all())

    def test_over_is_blended_with_what_the_array_holds(self):
        own = np.full((14, 24, 4), 0.5, np.float32)
        media = self.session.render(blend="media")
        self.session.render(own, blend="over")
        np.testing.assert_allclose(own, media + (1 - media[..., 3:]) * 0.5, rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(self.session.render(blend="over"), media, rtol=1e-6)


class Settings(unittest.TestCase):
    def test_matrices_are_rows_and_columns_of_numpy(self):
        session = open_session()
        session.set_camera((300, -4000, 256), (0, 100, 1024), fov_deg=40, size=(24, 14))
        expected = session.render()
        eye, target = np.array([300, -4000, 256.0]), np.array([0, 100, 1024.0])
        back = (eye - target) / np.linalg.norm(eye - target)
        right = np.cross([0, 0, 1], back)
        right /= np.linalg.norm(right)
        view = np.eye(4)
        view[:3, :3] = [right, np.cross(back, right), back]
        view[:3, 3] = -view[:3, :3] @ eye
        f, near, far = 1 / math.tan(math.radians(20)), 1.0, 1e5
        opengl = np.array([[f * 14 / 24, 0, 0, 0], [0, f, 0, 0],
                           [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)],
                           [0, 0, -1, 0]])
        vulkan = opengl.copy()
        vulkan[2, 2:] = far / (near - far), far * near / (near - far)
        for projection, clip in ((opengl, "minus_one"), (vulkan, "zero")):
            session.set_camera(POSITION, TARGET)
            self.assertGreater(np.abs(session.render() - expected).max(), 0.05)
            session.set_matrices(view, projection, clip=clip)
            np.testing.assert_allclose(session.render(), expected, atol=2e-3)
            # Its depth buffer, there and back.
            depth = session.render(depth=True, depth_kind="buffer").depth
            self.assertTrue(((depth >= 0) & (depth <= 1)).all())
            metres = session.render(depth=True).depth
            session.set_depth(depth, "buffer")
            np.testing.assert_allclose(session.render(depth=True).depth, metres, rtol=2e-2)
            session.set_depth(None)
        with self.assertRaises(pileus.BadInput):
            session.set_matrices(view.T, opengl)

    def test_lights_ground_placement_size(self):
        session = open_session()
        first = session.render(hash=True).hash
        seen = {first}

        def changed():
            now = session.render(hash=True).hash
            self.assertNotIn(now, seen)
            seen.add(now)

        session.set_sun(120, 20, [1, 0.5, 0.25])
        changed()
        session.set_sun(None)
        changed()
        session.set_environment([0.0625, 0.125, 0.5])
        changed()
        session.set_environment(None)
        session.set_ground(None)
        self.assertEqual(np.abs(session.render()[..., :3]).max(), 0)
        session.set_environment(0.5)
        changed()
        session.set_lamps([{"type": "point", "position": (100, -250, 1200), "intensity": 1e6},
                            {"type": "spot", "position": (-1500, 0, 900), "direction": (1, 0, 0),
                             "cone_deg": 20, "intensity": [1e6, 0, 0]},
                            {"type": "directional", "azimuth_deg": 90, "irradiance": 0.5}])
        changed()
        session.set_lamps([])
        session.set_environment([0.0625, 0.125, 0.25])
        session.set_sun(120, 35)
        session.set_ground(0.25, altitude=0)
        self.assertEqual(session.render(hash=True).hash, first)
        session.set_placement((200, 0, 0), yaw_deg=30)
        changed()
        session.set_placement()
        session.set_camera(POSITION, TARGET, height=2000, size=(31, 7))
        self.assertEqual(session.size, (31, 7))
        self.assertEqual(session.render().shape, (7, 31, 4))
        session.set_camera(POSITION, TARGET, size=(24, 14))
        self.assertEqual(session.render(hash=True).hash, first)
        session.set_depth(np.full((14, 24), 1.0))
        self.assertEqual(session.render()[..., 3].max(), 0)
        with self.assertRaisesRegex(pileus.BadInput, "shape"):
            session.set_depth(np.ones((24, 14)))
        session.set_camera(POSITION, TARGET)
        session.set_depth(np.ones((14, 48))[:, ::2])
        self.assertEqual(session.stats.prepared, 1)

    def test_layers_and_media(self):
        layers = {"output.layers": ["depth", "optical_depth", "transmittance"], **RAYMARCH}
        session = pileus.Session(pileus.World(pileus.Scene(CUMULUS, layers)), layers=True)
        first = session.render(layers=["tau", "T", "A"], hash=True)
        self.assertEqual(first.hash, session.render(hash=True).hash)
        np.testing.assert_allclose(first.layers["T"], np.exp(-first.layers["tau"]), atol=1e-4)
        np.testing.assert_allclose(first.layers["A"], 1 - first.layers["T"], atol=1e-4)
        with self.assertRaisesRegex(pileus.BadInput, "frame.layers"):
            session.render(layers=["sun.R"])
        thin = pileus.Scene(CUMULUS, {"medium.0.extinction_per_m": 0.001, **layers})
        session.set_media(thin)
        wanted = pileus.Session(pileus.World(thin)).render(hash=True).hash
        self.assertEqual(session.render(hash=True).hash, wanted)
        with self.assertWarns(DeprecationWarning):
            session.set_lights([])

    def test_sky_maps(self):
        scene = pileus.Scene(CUMULUS.replace("radiance = [0.0625, 0.125, 0.25]",
                                             "radiance = [0, 0, 0]"), {"method.name": "path"})
        session = pileus.Session(pileus.World(scene))
        session.set_sun(None)
        sky = np.zeros((8, 16, 3), np.float32)
        sky[:4] = 1, 2, 3
        session.set_environment(sky)
        session.step(2)
        one = session.render()
        self.assertGreater(one[..., 2].max(), 2.9)
        session.set_environment(sky, scale=2, rotation_deg=90)
        session.set_sun(None)  # the checks of other settings know the map as well
        session.set_environment(sky, scale=2)
        session.step(2)
        np.testing.assert_allclose(session.render()[..., :3], 2 * one[..., :3], rtol=1e-5)
        session.set_environment(None)
        session.step(2)
        self.assertEqual(session.render()[..., :3].max(), 0)
        for bad in (np.zeros((8, 16, 4)), [1, 2], np.zeros((0, 0, 3)), -sky, sky * math.nan):
            with self.assertRaises(pileus.BadInput):
                session.set_environment(bad)

    def test_densities_run_z_y_x(self):
        scene = pileus.Scene(BOX)
        values = np.zeros((2, 3, 4), np.float32)
        values[1, :, :] = 1  # the upper half
        picture = pileus.Session(pileus.World(scene, density={0: values})).render()
        self.assertGreater(picture[2, 4, 3], 0.5)
        self.assertLess(picture[5, 4, 3], 0.2)
        values[:] = 0
        values[:, :, 3] = 1  # the east, at the right
        # Any kind of numbers and order in memory.
        odd = np.asfortranarray(values.astype(np.float64))
        picture = pileus.Session(pileus.World(scene, density={0: odd})).render()
        self.assertGreater(picture[3, 5, 3], picture[3, 3, 3] + 0.2)
        for bad in ({0: -values}, {1: values}, {0: values[0]}, {0: values * math.nan}):
            with self.assertRaises(pileus.BadInput):
                pileus.World(scene, density=bad)


if __name__ == "__main__":
    unittest.main()
