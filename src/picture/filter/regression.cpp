// SPDX-License-Identifier: Apache-2.0
// See regression.h.
#include "src/picture/filter/regression.h"

#include <cstring>
#include <vector>

#include "kernels_cpu/core/math.h"
#include "platform/threads.h"

namespace pileus {
namespace {

constexpr int kK = kFilterFeatures;
constexpr int kTile = 8;                    // pixels
constexpr int kMatrix = kK * (kK + 1) / 2;  // numbers of a symmetric matrix
constexpr int kRight = 3 * kK + 3 + 1;      // right-hand sides, squares, count
constexpr int kStored = kK + 1;             // features and weight of a pixel
constexpr double kLeastAlpha = 0.02;
constexpr double kDropped = 1e-7;  // share of a pivot below which a feature says nothing new

constexpr double kStrict = 1.5;  // noise counts for so much more where windows shrink
constexpr double kFirstRidge = 1e-4, kRidge = 0.02;  // of a feature's mean square
constexpr double kFewest = 0.05;            // pixels, like all on average, that say nothing changes
constexpr int kWidest = 8, kNarrowest = 2;  // half widths of windows, tiles

struct Tiles {
    int across, down;
    std::size_t count() const { return std::size_t(across) * std::size_t(down); }
};

Tiles tiles_of(int width, int height) {
    return {(width + kTile - 1) / kTile, (height + kTile - 1) / kTile};
}

/// Calls use(pixel, x, y) for the pixels of a tile, row by row.
template <class Use>
void for_tile(const RegressionInput& in, int tx, int ty, Use use) {
    const int x1 = (tx + 1) * kTile < in.width ? (tx + 1) * kTile : in.width;
    const int y1 = (ty + 1) * kTile < in.height ? (ty + 1) * kTile : in.height;
    for (int y = ty * kTile; y < y1; ++y)
        for (int x = tx * kTile; x < x1; ++x)
            use(std::size_t(y) * std::size_t(in.width) + std::size_t(x), x, y);
}

/// One group of pixels, filtered apart from the others.
struct Work {
    const RegressionInput& in;
    Tiles tiles;
    Buffer<float> numbers;
    Buffer<double> sums;
    Span<float> features;                     // [pixel][kStored]; weight 0: not of this group
    Span<float> fit;                          // [3][pixel]
    Span<double> matrix, right, wide, wider;  // [tile][...], those of windows in `wide`, `wider`
    Span<double> across;                      // scratch
    Span<double> coefficients;                // [tile][3][kK]
    Span<double> scale;  // [tile][kK], squares of the features in the widest windows
    Span<double> noise;  // [tile][3], mean weighted square, of the widest windows
    double common[kK] = {};
    std::vector<double> norm_x, norm_y;

    void share_out(std::size_t pixels) {
        features = {numbers.data(), pixels * kStored};
        fit = {numbers.data() + pixels * kStored, pixels * 3};
        double* at = sums.data();
        const auto take = [&](std::size_t each) {
            const Span<double> own{at, each * tiles.count()};
            at += own.size;
            return own;
        };
        matrix = take(kMatrix), wide = take(kMatrix), across = take(kMatrix);
        right = take(kRight), wider = take(kRight);
        coefficients = take(3 * kK), scale = take(kK), noise = take(3);
    }
    explicit Work(const RegressionInput& input)
        : in(input), tiles(tiles_of(input.width, input.height)) {}
};

void set_features(Work& w, bool opaque) {
    const RegressionInput& in = w.in;
    const std::size_t pixels = std::size_t(in.width) * std::size_t(in.height);
    parallel_for(in.threads, w.in.height, [&](std::int64_t y, int) {
        for (int x = 0; x < in.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(in.width) + std::size_t(x);
            float* f = w.features.data + i * kStored;
            const bool solid = in.opaque_depth != nullptr && in.opaque_depth[i] < kNothingSolid;
            const float alpha = 1.0f - in.transmittance[i];
            const bool mine = solid == opaque && alpha > 0.0f;
            if (!mine) {
                for (int k = 0; k < kStored; ++k) f[k] = 0;
                continue;
            }
            f[0] = alpha;
            f[1] = log_(1.0f + in.optical_depth[i]);
            for (int g = 0; g < 3; ++g) f[2 + g] = in.guides[std::size_t(g) * pixels + i];
            f[5] = alpha * (float(x) - 0.5f * float(in.width)) / float(in.width);
            f[6] = alpha * (float(y) - 0.5f * float(in.height)) / float(in.width);
            f[7] = 1.0f / (alpha + float(kLeastAlpha));
        }
    });
}

void sum_matrix(Work& w) {
    parallel_for(w.in.threads, w.tiles.down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < w.tiles.across; ++tx) {
            double* out =
                w.matrix.data +
                (std::size_t(ty) * std::size_t(w.tiles.across) + std::size_t(tx)) * kMatrix;
            for (int i = 0; i < kMatrix; ++i) out[i] = 0;
            for_tile(w.in, tx, int(ty), [&](std::size_t pixel, int, int) {
                const float* f = w.features.data + pixel * kStored;
                if (!(f[kK] > 0)) return;
                for (int a = 0, at = 0; a < kK; ++a) {
                    const double wa = double(f[kK]) * double(f[a]);
                    for (int b = 0; b <= a; ++b) out[at++] += wa * double(f[b]);
                }
            });
        }
    });
}

/// Mean square of each feature over all pixels, times kFewest.
void find_common(Work& w) {
    double sum[kK] = {}, count = 0;
    for (std::size_t t = 0; t < w.tiles.count(); ++t)
        for (int k = 0, at = 0; k < kK; ++k, at += k + 1)
            sum[k] += w.matrix.data[t * kMatrix + std::size_t(at)];
    const std::size_t pixels = std::size_t(w.in.width) * std::size_t(w.in.height);
    for (std::size_t i = 0; i < pixels; ++i) count += w.features.data[i * kStored + kK] > 0 ? 1 : 0;
    for (int k = 0; k < kK; ++k) w.common[k] = count > 0 ? kFewest * sum[k] / count : 0;
}

void sum_right(Work& w, const float* light) {
    const std::size_t pixels = std::size_t(w.in.width) * std::size_t(w.in.height);
    parallel_for(w.in.threads, w.tiles.down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < w.tiles.across; ++tx) {
            double* out =
                w.right.data +
                (std::size_t(ty) * std::size_t(w.tiles.across) + std::size_t(tx)) * kRight;
            for (int i = 0; i < kRight; ++i) out[i] = 0;
            for_tile(w.in, tx, int(ty), [&](std::size_t pixel, int, int) {
                const float* f = w.features.data + pixel * kStored;
                if (!(f[kK] > 0)) return;
                for (int c = 0; c < 3; ++c) {
                    const std::size_t at = std::size_t(c) * pixels + pixel;
                    const double left = double(light[at]) - double(w.fit[at]);
                    const double wl = left * double(f[kK]);
                    for (int k = 0; k < kK; ++k) out[c * kK + k] += wl * double(f[k]);
                    out[3 * kK + c] += wl * left;
                }
                out[3 * kK + 3] += 1;
            });
        }
    });
}

/// 1 - |d| / h of tiles d apart.
double tent(int d, int h) { return 1.0 - double(d < 0 ? -d : d) / double(h); }

/// One over the sum of a tile's weights in all windows.
std::vector<double> norms(int count, int h) {
    std::vector<double> out(std::size_t(count), 0.0);
    for (int p = 0; p < count; ++p) {
        double sum = 0;
        for (int d = 1 - h; d < h; ++d)
            if (p + d >= 0 && p + d < count) sum += tent(d, h);
        out[std::size_t(p)] = 1 / sum;
    }
    return out;
}

/// Sums of `n` numbers a tile over windows of half width h: out[t] = sum over tiles p of W(t - p)
/// from[p].
void spread(Work& w, const double* from, int n, int h, double* out, bool of_window) {
    const int nx = w.tiles.across, ny = w.tiles.down;
    double* mid = w.across.data;
    const auto share = [&](const std::vector<double>& norm, int t, int p, int d) {
        return tent(d, h) * norm[std::size_t(of_window ? p : t)];
    };
    parallel_for(w.in.threads, ny, [&](std::int64_t y, int) {
        for (int x = 0; x < nx; ++x) {
            double* to = mid + (std::size_t(y) * std::size_t(nx) + std::size_t(x)) * std::size_t(n);
            for (int i = 0; i < n; ++i) to[i] = 0;
            for (int d = 1 - h; d < h; ++d) {
                if (x + d < 0 || x + d >= nx) continue;
                const double s = share(w.norm_x, x, x + d, d);
                const double* f =
                    from + (std::size_t(y) * std::size_t(nx) + std::size_t(x + d)) * std::size_t(n);
                for (int i = 0; i < n; ++i) to[i] += s * f[i];
            }
        }
    });
    parallel_for(w.in.threads, ny, [&](std::int64_t y, int) {
        for (int x = 0; x < nx; ++x) {
            double* to = out + (std::size_t(y) * std::size_t(nx) + std::size_t(x)) * std::size_t(n);
            for (int i = 0; i < n; ++i) to[i] = 0;
            for (int d = 1 - h; d < h; ++d) {
                if (y + d < 0 || y + d >= ny) continue;
                const double s = share(w.norm_y, int(y), int(y) + d, d);
                const double* f =
                    mid + (std::size_t(y + d) * std::size_t(nx) + std::size_t(x)) * std::size_t(n);
                for (int i = 0; i < n; ++i) to[i] += s * f[i];
            }
        }
    });
}

struct Factors {
    double l[kK][kK];
    double d[kK];
    int rank;
};

/// A = L D L^T; features that say nothing new have d = 0.
Factors factor(const double* a) {
    Factors f{};
    for (int i = 0, at = 0; i < kK; ++i) {
        for (int j = 0; j <= i; ++j, ++at) {
            double v = a[at];
            for (int k = 0; k < j; ++k) v -= f.l[i][k] * f.d[k] * f.l[j][k];
            if (j < i)
                f.l[i][j] = f.d[j] > 0 ? v / f.d[j] : 0;
            else
                f.d[i] = v > kDropped * a[at] ? v : 0;
        }
        f.rank += f.d[i] > 0 ? 1 : 0;
    }
    return f;
}

void solve(const Factors& f, const double* b, double* x) {
    for (int i = 0; i < kK; ++i) {
        double v = b[i];
        for (int k = 0; k < i; ++k) v -= f.l[i][k] * x[k];
        x[i] = f.d[i] > 0 ? v : 0;
    }
    for (int i = 0; i < kK; ++i) x[i] = f.d[i] > 0 ? x[i] / f.d[i] : 0;
    for (int i = kK - 1; i >= 0; --i) {
        double v = x[i];
        for (int k = i + 1; k < kK; ++k) v -= f.l[k][i] * x[k];
        x[i] = f.d[i] > 0 ? v : 0;
    }
}

/// Sum of squares of the window's weights over their sum, of tents.
double thinness(int h) {
    double one = 0, two = 0;
    for (int d = 1 - h; d < h; ++d) one += tent(d, h), two += tent(d, h) * tent(d, h);
    return two / one * two / one / (double(h) * double(h));
}

void solve_windows(Work& w, int h, bool shrinks) {
    const double kappa = thinness(h);
    parallel_for(w.in.threads, w.tiles.down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < w.tiles.across; ++tx) {
            const std::size_t tile =
                std::size_t(ty) * std::size_t(w.tiles.across) + std::size_t(tx);
            const double* right = w.wider.data + tile * kRight;
            double* out = w.coefficients.data + tile * 3 * kK;
            const double count = right[3 * kK + 3];
            double* matrix = w.wide.data + tile * kMatrix;
            double* scale = w.scale.data + tile * kK;
            for (int k = 0, at = 0; k < kK; ++k, at += k + 1) {
                if (!shrinks) scale[k] = matrix[at];
                matrix[at] += (shrinks ? kRidge : kFirstRidge) * scale[k] + w.common[k];
            }
            const Factors f = factor(matrix);
            for (int c = 0; c < 3; ++c) {
                double* x = out + c * kK;
                if (f.rank == 0 || !(count > 0)) {
                    for (int k = 0; k < kK; ++k) x[k] = 0;
                    continue;
                }
                solve(f, right + c * kK, x);
                double explained = 0;
                for (int k = 0; k < kK; ++k) explained += x[k] * right[c * kK + k];
                double& noise_here = w.noise[tile * 3 + std::size_t(c)];
                if (!shrinks) {
                    const double left = right[3 * kK + c] - explained;
                    noise_here = left > 0 ? left / count : 0;
                    continue;
                }
                const double noise = noise_here * kappa * f.rank * kStrict;
                const double keep = explained > noise ? 1 - noise / explained : 0;
                for (int k = 0; k < kK; ++k) x[k] *= keep;
            }
        }
    });
}

/// Adds what the coefficients say of each pixel, between the middles of tiles linearly.
void add_fit(Work& w) {
    const int nx = w.tiles.across, ny = w.tiles.down;
    const std::size_t pixels = std::size_t(w.in.width) * std::size_t(w.in.height);
    const auto place = [](int pixel, int count, int& low, int& high, double& f) {
        const double at = (pixel + 0.5) / kTile - 0.5;
        low = at < 0 ? 0 : int(at);
        f = at < 0 ? 0 : at - low;
        high = low + 1 < count ? low + 1 : low;
    };
    parallel_for(w.in.threads, w.in.height, [&](std::int64_t y, int) {
        int y0, y1;
        double fy;
        place(int(y), ny, y0, y1, fy);
        std::vector<double> row(std::size_t(nx) * 3 * kK);
        for (std::size_t i = 0; i < row.size(); ++i) {
            const double a = w.coefficients[std::size_t(y0) * row.size() + i];
            row[i] = a + fy * (w.coefficients[std::size_t(y1) * row.size() + i] - a);
        }
        for (int x = 0; x < w.in.width; ++x) {
            const std::size_t pixel = std::size_t(y) * std::size_t(w.in.width) + std::size_t(x);
            const float* f = w.features.data + pixel * kStored;
            if (!(f[kK] > 0)) continue;
            int x0, x1;
            double fx;
            place(x, nx, x0, x1, fx);
            const double *a = row.data() + x0 * 3 * kK, *b = row.data() + x1 * 3 * kK;
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int k = 0; k < kK; ++k) {
                    const double v = a[c * kK + k];
                    sum += (v + fx * (b[c * kK + k] - v)) * double(f[k]);
                }
                w.fit[std::size_t(c) * pixels + pixel] += float(sum);
            }
        }
    });
}

void run_level(Work& w, const float* light, int h, bool shrinks) {
    w.norm_x = norms(w.tiles.across, h);
    w.norm_y = norms(w.tiles.down, h);
    sum_right(w, light);
    spread(w, w.matrix.data, kMatrix, h, w.wide.data, true);
    spread(w, w.right.data, kRight, h, w.wider.data, true);
    solve_windows(w, h, shrinks);
    spread(w, w.coefficients.data, 3 * kK, h, w.wide.data, false);
    std::memcpy(w.coefficients.data, w.wide.data, w.tiles.count() * 3 * kK * sizeof(double));
    add_fit(w);
}

}  // namespace

Array<float> arrays::filter_features(std::uint64_t pixels) {
    return {"features of the filter", bytes_of(kStored + 3, pixels), Stage::kLayers,
            Stage::kLayers};
}

Array<double> arrays::filter_sums(int width, int height) {
    constexpr std::uint64_t kEach = 3 * kMatrix + 2 * kRight + 4 * kK + 3;
    return {"sums of the filter", bytes_of(kEach, tiles_of(width, height).count()), Stage::kLayers,
            Stage::kLayers};
}

Status filter_light(const RegressionInput& in, float* light) {
    const std::size_t pixels = std::size_t(in.width) * std::size_t(in.height);
    Work w(in);
    PILEUS_TRY(allocate(arrays::filter_features(pixels), w.numbers));
    PILEUS_TRY(allocate(arrays::filter_sums(in.width, in.height), w.sums));
    w.share_out(pixels);
    for (int group = 0; group < (in.opaque_depth != nullptr ? 2 : 1); ++group) {
        set_features(w, group == 1);
        sum_matrix(w);
        find_common(w);
        std::memset(w.fit.data, 0, pixels * 3 * sizeof(float));
        if (in.radius_pixels > 0) {
            const int h = (in.radius_pixels + kTile - 1) / kTile;
            run_level(w, light, h < 1 ? 1 : h, false);
        } else
            for (int h = kWidest; h >= kNarrowest; h /= 2) run_level(w, light, h, h < kWidest);
        for (std::size_t i = 0; i < pixels; ++i)
            if (w.features[i * kStored + kK] > 0)
                for (std::size_t c = 0; c < 3; ++c) light[c * pixels + i] = w.fit[c * pixels + i];
    }
    return Status::ok();
}

}  // namespace pileus
