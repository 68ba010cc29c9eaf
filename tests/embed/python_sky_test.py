# SPDX-License-Identifier: Apache-2.0
"""pileus.Sky: a host's picture under air and clouds, what its world gets back, faults in one line.

in: the module in the path -> out: exit 0. docs/python.md
"""

import math
import threading
import unittest

import numpy as np
import pileus

from python_scenes import CUMULUS, POSITION, RAYMARCH, TARGET

_MEDIUM = CUMULUS[CUMULUS.index("[[medium]]"):CUMULUS.index("[collectors]")]
SURROUNDINGS = CUMULUS.replace(_MEDIUM, "")
AIR = SURROUNDINGS.replace("[sky]\nradiance = [0.0625, 0.125, 0.25]", "[atmosphere]\nturbidity = 2")
DATED = AIR.replace("azimuth_deg = 120\nelevation_deg = 35\n", "").replace(
    "turbidity = 2", 'turbidity = 2\ndate = "2024-06-21"\ntime = "12:00"\nlatitude_deg = 48\nlongitude_deg = 11')
LIT = {"raymarch.steps": 40, "raymarch.jitter": "none", **RAYMARCH}


def open_sky(text=SURROUNDINGS, clouds=(), **more):
    # One thread: these pictures are too small for more, and the machine may be busy.
    sky = pileus.Sky(pileus.Scene(text), threads=1, **more)
    if clouds:
        sky.add_kind(cumulus())
        sky.place(clouds)
    return sky


def cumulus():
    return pileus.World(pileus.Scene(CUMULUS, LIT), threads=1)


class Pictures(unittest.TestCase):
    def test_without_clouds_it_is_the_picture_of_the_program(self):
        for text in (SURROUNDINGS, AIR):
            theirs = pileus.render(text, overrides=RAYMARCH, hash=True)
            ours = open_sky(text).render(hash=True)
            self.assertEqual(ours.hash, theirs.hash)
            np.testing.assert_array_equal(ours.colour, theirs.colour)

    def test_a_host_is_seen_through_air_and_clouds(self):
        sky = open_sky(AIR, [{"offset": (0, 0, 0)}])
        own = np.full((14, 24, 4), 0.5, np.float32)
        host = np.full((14, 24), math.inf)
        host[7:] = 2000.0
        self.assertIs(sky.render(own, blend="over", host_depth=host), own)
        alone = sky.render()
        np.testing.assert_array_equal(own[:7, :, :3], alone[:7, :, :3])
        self.assertTrue((own[7:, :, :3] != 0.5).all())
        # Depths stay, and may be rows from the bottom up, by a stride or by the option.
        for given, how in ((None, {}), (host[::-1], {"host_bottom_up": True}),
                           (host.astype(np.float32)[::-1], {"host_bottom_up": True})):
            again = np.full((14, 24, 4), 0.5, np.float32)
            sky.render(again, blend="over", host_depth=given, **how)
            np.testing.assert_array_equal(again, own)
        # What is laid over later is the same but for one alpha of three.
        media = sky.render(blend="media")
        later = media[..., :3] + (1 - media[..., 3:]) * 0.5
        np.testing.assert_allclose(later[7:].mean(-1), own[7:, :, :3].mean(-1), rtol=1e-4)
        drawn = sky.render(colour=False, depth=True, host_depth=host)
        self.assertIsNone(drawn.colour)
        self.assertLessEqual(drawn.depth[7:].max(), 2000.5)
        flipped = np.zeros((14, 24, 4), np.float32)
        sky.render(flipped[::-1], host_depth=host)
        np.testing.assert_array_equal(flipped[::-1], sky.render())
        np.testing.assert_array_equal(flipped, sky.render(bottom_up=True))

    def test_what_is_set_changes_the_picture(self):
        sky = open_sky(clouds=[{"kind": 0}])
        seen = {sky.render(hash=True).hash}

        def changed():
            now = sky.render(hash=True).hash
            self.assertNotIn(now, seen)
            seen.add(now)

        sky.set_sun(200, 20)
        changed()
        sky.set_ground(0.9)
        changed()
        sky.set_environment([0.0625, 0.125, 0.5])
        changed()
        sky.move((300, 0, 0))
        changed()
        sky.place([{"offset": (0, 300, 0), "yaw_deg": 90, "scale": 1.5}])
        changed()
        sky.add_layer(cumulus())
        changed()
        sky.set_frame(3)
        sky.set_camera(POSITION, TARGET, size=(31, 7))
        self.assertEqual(sky.size, (31, 7))
        self.assertEqual(sky.render().shape, (7, 31, 4))
        view = np.eye(4)
        view[:3, :3] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
        sky.set_matrices(view, np.array([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, -1, -2], [0, 0, -1, 0]]))
        changed()

    def test_a_cloud_that_is_half_there(self):
        sky = open_sky(clouds=[{}])
        full = sky.render()
        sky.place([{"presence": 0.5}])
        # Of an alpha near 0 a float keeps 1 less it: to 2^-24.
        np.testing.assert_allclose(sky.render()[..., 3], 0.5 * full[..., 3], rtol=1e-5, atol=1e-7)
        sky.place([])
        self.assertEqual(sky.render()[..., 3].max(), 0)

    def test_the_clock(self):
        sky = open_sky(DATED)
        noon = sky.light_at([(0, 0, 0)])
        sky.set_time(6)
        sky.render()
        evening = sky.light_at([(0, 0, 0)])
        self.assertLess(evening["sun"].sum(), 0.9 * noon["sun"].sum())
        sky.set_time(12)
        sky.render()
        self.assertEqual(sky.light_at([(0, 0, 0)])["sun_share"][0], 0)

    def test_a_report_makes_the_clouds(self):
        sky = open_sky(AIR)
        sky.set_camera((0, 0, 300), (0, 1000, 700), fov_deg=60)
        clear = sky.render()
        self.assertEqual(clear[..., 3].max(), 0)
        sky.set_weather("EGLL 271020Z 24015KT 9999 OVC030 12/08 Q1012", seed=1, elevation=25)
        overcast = sky.render()
        self.assertGreater(overcast[..., 3].mean(), 0.2)
        for wrong, what in (("", "metar"), ("nothing of the kind", "metar"), ("EGLL\0", "zero byte")):
            with self.assertRaisesRegex(pileus.BadInput, what):
                sky.set_weather(wrong)
        self.assertGreater(sky.render()[..., 3].mean(), 0.2)
        sky.set_weather("EGLL 271020Z 24005KT CAVOK 12/08 Q1012")
        self.assertEqual(sky.render()[..., 3].max(), 0)


class Light(unittest.TestCase):
    def setUp(self):
        self.sky = open_sky(AIR, [{"offset": (0, 0, 1000)}])
        self.sky.set_sun(90, 45)
        self.sky.render()

    def test_at_points(self):
        points = np.array([[0, 0, 2000], [3000, 0, 100], [-2000, 0, 0]])
        light = self.sky.light_at(points)
        self.assertEqual({key: value.shape for key, value in light.items()},
                         {"sun_share": (3,), "sun": (3, 3), "level": (3, 3), "extinction_per_m": (3,),
                          "around": (3, 3, 9)})
        self.assertGreater(light["extinction_per_m"][0], 0.001)
        np.testing.assert_array_equal(light["extinction_per_m"][1:], 0)
        self.assertEqual(light["sun_share"][1], 1)
        self.assertLess(light["sun_share"][2], 0.5)
        self.assertTrue((light["sun"][1] > 0).all() and (light["level"] > 0).all())
        # Of a plane that looks up: level light, to what nine numbers lose of it.
        up = math.pi * (light["around"][1] @ np.array([1, 0, 0, 1, 0, 0, 0, 0, 2]))
        np.testing.assert_allclose(up, light["level"][1], rtol=0.1)
        for order in (points.T.copy().T, points.tolist(), points.astype(np.float32)[::1]):
            np.testing.assert_array_equal(self.sky.light_at(order)["sun"], light["sun"])
        self.assertEqual(self.sky.light_at(np.empty((0, 3)))["around"].shape, (0, 3, 9))

    def test_a_map_of_shadows(self):
        sky, how = self.sky, ((-6000, -3000), (6000, 4000), (10, 15))
        shares = sky.shadow(*how)
        self.assertEqual((shares.shape, shares.dtype), ((10, 15), np.float32))
        self.assertTrue(shares.min() < 0.5 and shares.max() == 1)
        # Its texels are places: rows from the north, columns from the west.
        x, y = np.meshgrid(-6000 + 400 * (np.arange(15) + 0.5), 1000 - 400 * (np.arange(10) + 0.5))
        places = np.stack([x, y, np.zeros_like(x)], -1).reshape(-1, 3)
        np.testing.assert_array_equal(sky.light_at(places)["sun_share"].reshape(10, 15), shares)
        np.testing.assert_array_equal(sky.shadow(*how, format="r16f"), shares.astype(np.float16))
        codes = (shares * np.float32(255) + np.float32(0.5)).astype(np.uint8)
        np.testing.assert_array_equal(sky.shadow(*how, format="r8"), codes)
        coloured = sky.shadow(*how, format="rgba8")
        np.testing.assert_array_equal(coloured[..., 1], codes)
        self.assertTrue((coloured[..., 3] == 255).all())
        np.testing.assert_array_equal(sky.shadow(*how, bottom_up=True), shares[::-1])
        # Ground above the clouds is in the sun, heights as a number or of each texel.
        heights = np.zeros((10, 15))
        heights[:4] = 5000
        by_height = sky.shadow(*how, altitude=heights)
        self.assertTrue((by_height[:4] == 1).all())
        np.testing.assert_array_equal(by_height[4:], shares[4:])
        self.assertTrue((sky.shadow(*how, altitude=5000) == 1).all())
        # A few rows of an array of the caller, which is part of a larger one.
        around = np.full((12, 20), -1, np.float32)
        inside = around[1:11, 2:17]
        self.assertIs(sky.shadow(*how[:2], out=inside, first_row=3, rows=4), inside)
        np.testing.assert_array_equal(inside[3:7], shares[3:7])
        self.assertEqual((around == -1).sum(), 240 - 60)

    def test_air(self):
        near, far = self.sky.air((0, 1000, 200), 1000), self.sky.air((0, 1000, 200), 20000)
        for left, light in (near, far):
            self.assertEqual((left.shape, light.shape, left.dtype), ((3,), (3,), np.float32))
        self.assertTrue((far[0] < near[0]).all() and (far[1] > near[1]).all() and (near[0] < 1).all())
        np.testing.assert_array_equal(self.sky.air((0, 0, 1), math.inf)[0], 0)


class Faults(unittest.TestCase):
    def test_each_is_one_line_and_changes_nothing(self):
        sky = open_sky(clouds=[{}])
        before = sky.render(hash=True).hash
        world, f4 = cumulus(), np.float32
        around = (0, 0), (10, 10)
        for what, wrong in (
                ("media", lambda: pileus.Sky(pileus.Scene(CUMULUS))),
                ("sse9", lambda: pileus.Sky(pileus.Scene(AIR), isa="sse9")),
                ("elevation", lambda: sky.set_sun(0, 91)),
                ("date", lambda: sky.set_time(1)),
                ("hours", lambda: sky.set_time(math.nan)),
                ("nan", lambda: sky.move((0, 0, math.nan))),
                ("offset: shape", lambda: sky.move((0, 0))),
                ("atmosphere", lambda: sky.set_weather("EGLL 271020Z 24005KT CAVOK 12/08 Q1012")),
                ("kind", lambda: sky.place([{"kind": 1}])),
                (r"clouds\[1\].size: unknown", lambda: sky.place([{}, {"size": 2}])),
                ("presence", lambda: sky.place([{"presence": 0}])),
                ("presence", lambda: sky.place([{"presence": 1.5}])),
                ("presence", lambda: sky.place([{"presence": math.nan}])),
                ("scale", lambda: sky.place([{"scale": 0}])),
                ("offset: shape", lambda: sky.place([{"offset": (1, 2)}])),
                ("count", lambda: sky.place([{}] * 1001)),
                ("points: shape", lambda: sky.light_at((0, 0, 0))),
                ("points: shape", lambda: sky.light_at(np.zeros((2, 4)))),
                ("position_m", lambda: sky.light_at([(0, math.nan, 0)])),
                ("direction: 0, 0, 0", lambda: sky.air((0, 0, 0), 1)),
                ("direction", lambda: sky.air((0, math.nan, 0), 1)),
                ("metres", lambda: sky.air((0, 0, 1), -1)),
                ("metres", lambda: sky.air((0, 0, 1), math.nan)),
                ("shape", lambda: sky.shadow(*around)),
                ("shape", lambda: sky.shadow(*around, (4,))),
                ("shape", lambda: sky.shadow(*around, (0, 4))),
                ("shape", lambda: sky.shadow(*around, (4, 16385))),
                ("format", lambda: sky.shadow(*around, (4, 4), format="r4")),
                ("low", lambda: sky.shadow((math.nan, 0), (1, 1), (4, 4))),
                ("low: shape", lambda: sky.shadow((0, 0, 0), (1, 1), (4, 4))),
                ("size_m", lambda: sky.shadow((0, 0), (0, 1), (4, 4))),
                ("altitude_m", lambda: sky.shadow(*around, (4, 4), altitude=math.nan)),
                ("altitude: shape", lambda: sky.shadow(*around, (4, 4), altitude=np.zeros((4, 5)))),
                ("altitude: shape", lambda: sky.shadow(*around, (4, 4), altitude=np.zeros(4))),
                ("first_row", lambda: sky.shadow(*around, (4, 4), first_row=4)),
                ("rows", lambda: sky.shadow(*around, (4, 4), first_row=2, rows=3)),
                ("out: list", lambda: sky.shadow(*around, out=[1])),
                ("out: float64", lambda: sky.shadow(*around, out=np.zeros((4, 4)))),
                ("out: shape", lambda: sky.shadow(*around, out=np.zeros(4, f4))),
                ("out: shape", lambda: sky.shadow(*around, out=np.zeros((4, 4, 3), np.uint8), format="rgba8")),
                ("first", lambda: sky.shadow(*around, out=np.zeros((4, 4), f4)[::-1])),
                ("that of out", lambda: sky.shadow(*around, (4, 5), out=np.zeros((4, 4), f4))),
                ("shape", lambda: sky.render(np.zeros((14, 24, 3), f4))),
                ("host_depth: shape", lambda: sky.render(host_depth=np.ones((24, 14)))),
                ("host_kind", lambda: sky.render(host_depth=np.ones((14, 24)), host_kind="z")),
                ("depth", lambda: sky.render(host_depth=np.ones((14, 24)), host_kind="buffer")),
                ("blend", lambda: sky.render(blend="under"))):
            with self.subTest(what):
                with self.assertRaisesRegex(pileus.BadInput, what) as told:
                    wrong()
                self.assertNotIn("\n", str(told.exception))
        for wrong in (lambda: sky.place([{"kind": -1}]), lambda: sky.set_weather(None),
                      lambda: pileus.Sky(None), lambda: sky.add_layer(None)):
            with self.assertRaises((TypeError, AttributeError)):
                wrong()
        self.assertEqual(sky.render(hash=True).hash, before)
        for _ in range(8):
            sky.add_layer(world)
        with self.assertRaisesRegex(pileus.BadInput, "layer: one more"):
            sky.add_layer(world)

    def test_one_thread_at_a_time(self):
        sky = open_sky(AIR, [{"offset": (x, 0, 0), "yaw_deg": x / 100} for x in range(0, 300, 100)])
        done, refused = threading.Event(), 0
        worker = threading.Thread(target=lambda: (sky.render(), done.set()))
        worker.start()
        while not done.is_set():
            try:
                sky.move((0, 0, 0))
            except pileus.BadInput as fault:
                self.assertIn("one thread at a time", str(fault))
                refused += 1
            done.wait(0.001)
        worker.join()
        self.assertGreater(refused, 0)

    def test_worlds_outlive_their_names(self):
        sky = open_sky(clouds=[{}])
        sky.add_layer(cumulus())
        first = sky.render(hash=True).hash
        other = open_sky()
        other.add_kind(cumulus())
        other.add_layer(cumulus())
        other.place([{}])
        del sky
        self.assertEqual(other.render(hash=True).hash, first)


if __name__ == "__main__":
    unittest.main()
