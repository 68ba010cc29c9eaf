// SPDX-License-Identifier: Apache-2.0
// Keys of lights that do not go together are reported at their places, with what is allowed.
// in: small scene texts with one fault each -> out: the expected line of the message.
// docs/lights.md; docs/scene.md, section Messages.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/scene_faults.h"

namespace {

using namespace scene_faults;

TEST_CASE("faults of lights") {
    const std::string light = "[method]\nname = \"path\"\n[[light]]\ntype = ";
    const std::string spot = light + "\"spot\"\nposition_m = [1, 2, 3]\n";
    const Row rows[] = {
        {kCamera + "[[light]]\nradius_m = 1\n",
         "s.toml:4:1: light.0.type: missing, nothing, allowed: point, spot, directional"},
        {kCamera + light + "\"lamp\"\n", "s.toml:7:8: light.0.type: ..."},
        {kCamera + light + "\"point\"\n",
         "s.toml:7:8: light.0.position_m: missing, nothing, allowed: 3 numbers, metres"},
        {kCamera + light + "\"point\"\nposition_m = [0, 0, 0]\ncone_deg = 20\n",
         "s.toml:9:12: light.0.cone_deg: not of a light of type point, 20, allowed: left out, or "
         "type spot"},
        {kCamera + light + "\"directional\"\nintensity = 2\n",
         "s.toml:8:13: light.0.intensity: not of a light of type directional, 2, allowed: left "
         "out, or type point, spot"},
        {kCamera + spot,
         "s.toml:7:8: light.0.direction: missing, nothing, allowed: direction or "
         "target_m"},
        {kCamera + spot + "direction = [0, 0, 0]\n",
         "s.toml:9:13: light.0.direction: no direction, [0, 0, 0], allowed: any but the zero "
         "vector"},
        {kCamera + spot + "target_m = [1, 2, 3]\n",
         "s.toml:9:12: light.0.target_m: same as position_m, [1, 2, 3], allowed: any other point"},
        {kCamera + spot + "target_m = [1, 2, 4]\ndirection = [0, 0, 1]\n",
         "s.toml:9:12: light.0.target_m: conflicts with direction, [1, 2, 4], allowed: one of "
         "both"},
        {kCamera + spot + "target_m = [1, 2, 4]\ncone_deg = 20\npenumbra_deg = 11\n",
         "s.toml:11:16: light.0.penumbra_deg: wider than the cone, 11, allowed: at most half of "
         "cone_deg 20"},
        {kCamera + spot + "target_m = [1, 2, 4]\ncone_deg = 0\n",
         "s.toml:10:12: light.0.cone_deg: out of range, 0, allowed: ..."},
        {kCamera + light + "\"directional\"\nshadow_samples = 4\n",
         "s.toml:8:18: light.0.shadow_samples: not of a light of type directional, 4, allowed: "
         "left out, or type point, spot"},
        {kCamera + light + "\"point\"\nposition_m = [0, 0, 30]\nradius_m = 31\n[ground]\n",
         "s.toml:9:12: light.0.radius_m: reaches below the ground, 31, allowed: at most 30, or "
         "shadow_samples = 1"},
        {kCamera + "[method]\nname = \"collectors\"\n[collectors]\ndisplay = \"billboards\"\n"
                   "[[light]]\ntype = \"point\"\nposition_m = [0, 0, 0]\n",
         "s.toml:9:8: light.0.type: not for collectors as billboards in this version, \"point\", "
         "allowed: collectors.display = \"march\", ..."},
    };
    for (const Row& row : rows) check(row);
}

}  // namespace
