// SPDX-License-Identifier: Apache-2.0
// A tiled OpenEXR file that grows by bands of rows: the picture need never be whole in memory.
// in: bands from the top -> out: a file that is complete or not there.
// docs/formats.md, "OpenEXR"
#pragma once
#include <memory>
#include <string>

#include "src/base/status.h"
#include "src/io/images/image.h"

namespace pileus {

class TiledExr {
public:
    TiledExr();
    TiledExr(const TiledExr&) = delete;
    TiledExr& operator=(const TiledExr&) = delete;
    /// Without `end` nothing is left.
    ~TiledExr();

    /// Tiles of `side` pixels. kIo: the file cannot be written; kBadInput: no OpenEXR.
    Status begin(const std::string& path, int side);
    /// Rows from `y` on, a whole number of tiles or the last, of a picture of `height` rows. The
    /// first band brings channels and attributes.
    Status add(int y, int height, const Image& band);
    /// The picture's hash; the file gets its name.
    Status end(const std::string& hash);

private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

}  // namespace pileus
