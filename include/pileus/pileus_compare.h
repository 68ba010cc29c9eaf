/* SPDX-License-Identifier: Apache-2.0
 * The part of pileus.h that compares pictures; included by it, not by itself.
 */
#ifndef PILEUS_H
#error "include pileus.h"
#endif
#ifndef PILEUS_COMPARE_H
#define PILEUS_COMPARE_H

/* ---- Comparing --------------------------------------------------------------------------- */

/** Linear radiances in the caller's memory, rows from the top. */
typedef struct pileus_picture {
    uint32_t struct_size;
    uint32_t width, height;
    uint32_t channels;   /**< 3: R G B; 4: and alpha */
    const float* values; /**< [row][column][channels] */
    int64_t stride;      /**< bytes from row to row; 0: rows lie close */
} pileus_picture;

/** As `pileus compare` prints them: docs/compare.md, "Figures". */
typedef struct pileus_figures {
    uint32_t struct_size;
    int32_t identical;
    uint64_t pixels, cloud_pixels, not_finite;
    double mean, mean_reference;
    double rmse, relmse, relmse_trimmed;
    double bias, largest;
    uint32_t largest_at[2]; /**< column, row */
    double percentile_999, relative_percentile_999;
    double flip, flip_percentile_99, flip_largest; /**< of HDR-FLIP; NaN where it is left out */
} pileus_figures;

/** Measures `a` against `reference`, both of one size. Pixels count whose alpha in the reference is
 * above `alpha_least` (the program: 0.02); below 0, or without an alpha, all do. FLIP, over all
 * pixels, takes longer than all the rest. `host` may be null. */
PILEUS_API pileus_code pileus_compare(const pileus_picture* a, const pileus_picture* reference,
                                      double alpha_least, int32_t with_flip,
                                      const pileus_host* host, pileus_figures* figures,
                                      pileus_error* error);

#endif /* PILEUS_COMPARE_H */
