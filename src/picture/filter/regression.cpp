// SPDX-License-Identifier: Apache-2.0
// See regression.h.
#include "src/picture/filter/regression.h"

#include <cstring>
#include <vector>

#include "platform/threads.h"
#include "src/picture/filter/features.h"

namespace pileus {
namespace {

constexpr int kK = kFilterFeatures;
constexpr int kTile = 8;                    // pixels
constexpr int kMatrix = kK * (kK + 1) / 2;  // numbers of a symmetric matrix
constexpr int kSide = 3 * kK;               // right-hand sides of three colours
constexpr int kFolds = 4;                   // pixels of 2 x 2 are in as many parts of the picture
constexpr int kRight = kFolds * kSide;
constexpr int kStored = kFilterStored;
constexpr int kKept = 6;           // squares that fits explain, and of the noise in them
constexpr double kDropped = 1e-7;  // share of a pivot below which a feature says nothing new

constexpr double kStrict = 1.25;  // noise counts for so much more where windows shrink
constexpr double kFirstRidge = 1e-4, kRidge = 0.002;  // of a feature's mean square
constexpr double kFewest = 0.2;             // pixels, like all on average, that say nothing changes
constexpr int kWidest = 8, kNarrowest = 2;  // half widths of windows, tiles
constexpr std::size_t kShrinking = 2;       // levels of windows narrower than the widest
constexpr int kGround = 2;                  // the group of the ground, after two of the media

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
    Span<double> scale;              // [tile][kK], squares of the features in the widest windows
    Span<double> kept, kept_around;  // [tile][kKept], of windows, and around them
    double common[kK] = {};
    double* own_kept = nullptr;  // [level][tile][3], of in.kept
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
        matrix = take(kMatrix), wide = take(kMatrix), across = take(kRight);
        right = take(kRight), wider = take(kRight);
        coefficients = take(kSide), scale = take(kK);
        kept = take(kKept), kept_around = take(kKept);
    }
    explicit Work(const RegressionInput& input)
        : in(input), tiles(tiles_of(input.width, input.height)) {}
};

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
    const double fewest = w.in.fold < 0 || w.in.kept == nullptr ? kFewest : kFewest / kFolds;
    for (int k = 0; k < kK; ++k) w.common[k] = count > 0 ? fewest * sum[k] / count : 0;
}

void sum_right(Work& w, const float* light) {
    const std::size_t pixels = std::size_t(w.in.width) * std::size_t(w.in.height);
    parallel_for(w.in.threads, w.tiles.down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < w.tiles.across; ++tx) {
            double* out =
                w.right.data +
                (std::size_t(ty) * std::size_t(w.tiles.across) + std::size_t(tx)) * kRight;
            for (int i = 0; i < kRight; ++i) out[i] = 0;
            for_tile(w.in, tx, int(ty), [&](std::size_t pixel, int x, int y) {
                const float* f = w.features.data + pixel * kStored;
                if (!(f[kK] > 0)) return;
                // What is one fold has folds of its own.
                const int part = w.in.fold < 0 ? filter_fold(x, y) : filter_fold(x >> 1, y >> 1);
                double* fold = out + part * kSide;
                for (int c = 0; c < 3; ++c) {
                    const std::size_t at = std::size_t(c) * pixels + pixel;
                    const double wl = (double(light[at]) - double(w.fit[at])) * double(f[kK]);
                    for (int k = 0; k < kK; ++k) fold[c * kK + k] += wl * double(f[k]);
                }
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

/// Solves a window for one colour. `squares` gets what the fit explains, and how much of that is
/// noise by how far the folds of the picture, each fitted by itself, are apart.
void fit_folds(const Factors& f, const double* right, double* x, double* squares) {
    double sum[kK] = {}, own = 0, explained = 0;
    for (int fold = 0; fold < kFolds; ++fold) {
        const double* b = right + fold * kSide;
        solve(f, b, x);
        for (int k = 0; k < kK; ++k) own += x[k] * b[k], sum[k] += b[k];
    }
    solve(f, sum, x);
    for (int k = 0; k < kK; ++k) explained += x[k] * sum[k];
    squares[0] = explained;
    squares[3] = (kFolds * own - explained) / (kFolds - 1);
}

void solve_windows(Work& w, bool shrinks) {
    parallel_for(w.in.threads, w.tiles.down, [&](std::int64_t ty, int) {
        for (int tx = 0; tx < w.tiles.across; ++tx) {
            const std::size_t tile =
                std::size_t(ty) * std::size_t(w.tiles.across) + std::size_t(tx);
            double* matrix = w.wide.data + tile * kMatrix;
            double* scale = w.scale.data + tile * kK;
            for (int k = 0, at = 0; k < kK; ++k, at += k + 1) {
                if (!shrinks) scale[k] = matrix[at];
                matrix[at] += (shrinks ? kRidge : kFirstRidge) * scale[k] + w.common[k];
            }
            const Factors f = factor(matrix);
            for (int c = 0; c < 3; ++c)
                fit_folds(f, w.wider.data + tile * kRight + c * kK,
                          w.coefficients.data + tile * kSide + c * kK,
                          w.kept.data + tile * kKept + c);
        }
    });
}

/// Keeps as much of each window's fit as the windows around say is no noise: what a window says of
/// its own noise is short of it where no bright path went through, and fits would be too dark.
void keep_confirmed(Work& w, int h) {
    spread(w, w.kept.data, kKept, h, w.kept_around.data, false);
    for (std::size_t t = 0; t < w.tiles.count(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const double explained = w.kept_around[t * kKept + c];
            const double squares = kStrict * w.kept_around[t * kKept + 3 + c];
            const double noise = squares > 0 ? squares : 0;  // below it by rounding alone
            double keep = explained > noise ? 1 - noise / explained : 0;
            if (w.own_kept != nullptr) {
                double& whole = w.own_kept[3 * t + c];
                if (w.in.fold >= 0) keep = whole;
                whole = keep;
            }
            for (std::size_t k = 0; k < kK; ++k) w.coefficients[t * kSide + c * kK + k] *= keep;
        }
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
        std::vector<double> row(std::size_t(nx) * kSide);
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
            const double *a = row.data() + x0 * kSide, *b = row.data() + x1 * kSide;
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
    solve_windows(w, shrinks);
    if (shrinks) keep_confirmed(w, h);
    if (shrinks && w.own_kept != nullptr) w.own_kept += 3 * w.tiles.count();
    spread(w, w.coefficients.data, kSide, h, w.wide.data, false);
    std::memcpy(w.coefficients.data, w.wide.data, w.tiles.count() * kSide * sizeof(double));
    add_fit(w);
}

Status make_work(const RegressionInput& in, Work& w) {
    const std::size_t pixels = std::size_t(in.width) * std::size_t(in.height);
    PILEUS_TRY(allocate(arrays::filter_features(pixels), w.numbers));
    PILEUS_TRY(allocate(arrays::filter_sums(in.width, in.height), w.sums));
    w.share_out(pixels);
    return Status::ok();
}

/// Replaces the light of the pixels that have features: `number` 0 and 1 of the media, 2 ground.
void filter_group(Work& w, int number, float* light) {
    const RegressionInput& in = w.in;
    if (in.kept != nullptr)
        w.own_kept = in.kept + std::size_t(number) * kShrinking * 3 * w.tiles.count();
    const std::size_t pixels = std::size_t(in.width) * std::size_t(in.height);
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

}  // namespace

Array<float> arrays::filter_features(std::uint64_t pixels) {
    return {"features of the filter", bytes_of(kStored + 3, pixels), Stage::kLayers,
            Stage::kLayers};
}

Array<double> arrays::filter_sums(int width, int height) {
    constexpr std::uint64_t kEach = 2 * kMatrix + 3 * kRight + kSide + kK + 2 * kKept;
    return {"sums of the filter", bytes_of(kEach, tiles_of(width, height).count()), Stage::kLayers,
            Stage::kLayers};
}

Array<double> arrays::filter_kept(int width, int height) {
    return {"sums of the filter",
            bytes_of((kGround + 1) * kShrinking * 3, tiles_of(width, height).count()),
            Stage::kLayers, Stage::kLayers};
}

Status filter_light(const RegressionInput& in, float* light) {
    Work w(in);
    PILEUS_TRY(make_work(in, w));
    for (int group = 0; group < (in.opaque_depth != nullptr ? 2 : 1); ++group) {
        media_features(in, group == 1, w.features.data);
        filter_group(w, group, light);
    }
    return Status::ok();
}

Status filter_ground(const RegressionInput& in, float* light) {
    Work w(in);
    PILEUS_TRY(make_work(in, w));
    ground_features(in, w.features.data);
    filter_group(w, kGround, light);
    return Status::ok();
}

}  // namespace pileus
