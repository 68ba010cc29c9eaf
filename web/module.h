// SPDX-License-Identifier: Apache-2.0
// One picture that grows, for callers that have numbers and texts alone: the page's worker, and a
// native check. in: a scene as text, lines of overrides, a sun -> out: pixels, their hash, a line
// where something is wrong. docs/web.md
#pragma once

extern "C" {

struct WebPicture;

/// Reads a scene and makes its world; `overrides`: "key=value", one a line. Never null.
WebPicture* web_open(const char* text, const char* overrides);
void web_close(WebPicture* picture);

/// What went wrong first; "" if nothing did. After a fault nothing else is done.
const char* web_fault(const WebPicture* picture);

/// Begins anew under this sun: nothing that was traced before stays.
void web_begin(WebPicture* picture, double elevation_deg, double azimuth_deg, double red,
               double green, double blue);

/// Units of light that the picture should have, 0 of methods that have none; traces some of them.
int web_units(const WebPicture* picture);
void web_step(WebPicture* picture, int units);

/// Draws what there is: rows from the top, four bytes a pixel, and 16 hexadecimal digits.
void web_draw(WebPicture* picture);
int web_width(const WebPicture* picture);
int web_height(const WebPicture* picture);
const unsigned char* web_pixels(const WebPicture* picture);
const char* web_hash(const WebPicture* picture);
}
