// SPDX-License-Identifier: Apache-2.0
// Lorenz-Mie scattering by clouds of water spheres, in double precision.
// in: wavelength, refractive index, a gamma distribution of sizes, angles -> out: phase function.
// docs/phase.md, "Mie"; Bohren and Huffman 1983, chapter 4; Hansen and Travis 1974, equation 2.56.
#pragma once
#include <vector>

namespace pileus {

/// Number of droplets of radius r: r^7 exp(-10 r / effective radius), effective variance 0.1.
struct MieCloud {
    double effective_radius_um = 10;  ///< > 0
    double wavelength_um = 0.55;
    double index = 1.333;    ///< of water; nothing is absorbed
    double size_step = 0.1;  ///< between size parameters 2 pi r / wavelength of the sum
};

struct MieResult {
    double extinction_efficiency = 0;  ///< mean cross-section over mean area of the disks
    double mean_cosine = 0;            ///< exact, from the coefficients
    std::vector<double> density;       ///< 1/sr, one for each angle, light over the sphere is 1
};

/// Efficiency and mean cosine of one sphere of size parameter x > 0.
void mie_sphere(double x, double index, double& extinction_efficiency, double& mean_cosine);

/// Time grows as the square of the radius times the angles: 0.2 s at 4 um and 400 angles.
MieResult mie_cloud(const MieCloud& cloud, const std::vector<double>& angle_deg);

/// Angles of the tables that the program holds: close in the peak, the bows and the glory.
std::vector<double> mie_table_angles();

}  // namespace pileus
