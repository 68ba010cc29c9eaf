// SPDX-License-Identifier: Apache-2.0
// The samples of a PNG file as whole numbers, without any curve, and such a file from samples.
// in: the bytes of a grey PNG of 1 to 16 bits, or of colours that are equal -> out: numbers.
// docs/solids.md, "Height maps".
#pragma once
#include <cstdint>
#include <string>

#include "src/base/buffer.h"
#include "src/base/span.h"
#include "src/base/status.h"

namespace pileus {

/// Reads in two steps, so that the caller may refuse a size before there is memory for it.
class PngSamples {
public:
    /// `bytes` and `name` outlive this.
    Status read_head(const std::string& name, Span<const char> bytes);
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    /// Of all bits set: 255 or 65535; fewer bits are scaled to 255.
    double full_scale() const { return deep_ ? 65535 : 255; }
    /// Rows from the top.
    Status read_samples(Span<float> to);

private:
    std::string name_;
    Span<const char> bytes_;
    int columns_ = 0, rows_ = 0;
    bool deep_ = false;
};

/// A grey file of 16 bits from samples, rows from the top.
Status encode_png_samples(int columns, int rows, Span<const std::uint16_t> samples,
                          Buffer<char>& bytes);

}  // namespace pileus
