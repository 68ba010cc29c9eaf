// SPDX-License-Identifier: Apache-2.0
// The hash of a whole picture of the page, by this machine's own instructions.
// in: a scene file, lines of overrides, elevation, azimuth, red, green, blue -> out: the hash; exit
// 2 on a fault docs/web.md; tools/web
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "web/module.h"

int main(int count, char** words) {
    if (count != 8) {
        std::fprintf(stderr, "usage: %s SCENE OVERRIDES ELEVATION AZIMUTH RED GREEN BLUE\n",
                     words[0]);
        return 2;
    }
    std::ifstream file(words[1]);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    double numbers[5];
    for (int i = 0; i < 5; ++i) numbers[i] = std::atof(words[3 + i]);
    WebPicture* picture = web_open(text.c_str(), words[2]);
    web_begin(picture, numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]);
    web_step(picture, web_units(picture));
    web_draw(picture);
    const std::string fault = web_fault(picture);
    std::printf("%s\n", web_hash(picture));
    web_close(picture);
    if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
    return fault.empty() ? 0 : 2;
}
