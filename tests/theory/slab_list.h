// SPDX-License-Identifier: Apache-2.0
// Thirty slabs that span optical depth, asymmetry, absorption and the sun's height.
// in: nothing -> out: a fixed list, the four that every run takes first.
// docs/validation.md; tests/theory/adding_doubling.h gives the answers.
#pragma once

namespace slab_list {

struct Case {
    double tau;
    float g, albedo;
    double mu0;
};

constexpr int kPlain = 4;
constexpr Case kCases[30] = {
    {0.5, 0.85f, 1.0f, 0.5}, {4, 0.0f, 0.9f, 0.2},     {16, 0.85f, 0.999f, 1.0},
    {2, 0.95f, 0.99f, 0.1},  {0.1, 0.0f, 1.0f, 1.0},   {0.1, 0.5f, 0.5f, 0.1},
    {0.1, 0.85f, 0.9f, 0.5}, {0.1, 0.95f, 1.0f, 0.2},  {0.25, 0.75f, 0.99f, 0.1},
    {0.5, 0.0f, 0.5f, 0.8},  {0.5, 0.5f, 0.99f, 0.2},  {0.5, 0.95f, 0.9f, 1.0},
    {1, 0.0f, 1.0f, 0.1},    {1, 0.3f, 0.8f, 0.5},     {1, 0.75f, 0.99f, 0.8},
    {1, 0.9f, 1.0f, 1.0},    {2, 0.0f, 0.99f, 1.0},    {2, 0.5f, 1.0f, 0.5},
    {2, 0.85f, 0.5f, 0.2},   {4, 0.5f, 0.999f, 0.8},   {4, 0.85f, 1.0f, 0.1},
    {4, 0.95f, 0.8f, 1.0},   {8, 0.0f, 1.0f, 0.5},     {8, 0.75f, 0.9f, 0.2},
    {8, 0.9f, 0.999f, 1.0},  {16, 0.3f, 1.0f, 1.0},    {32, 0.85f, 1.0f, 0.8},
    {32, 0.0f, 0.99f, 0.1},  {64, 0.95f, 0.999f, 0.5}, {64, 0.85f, 1.0f, 1.0},
};

}  // namespace slab_list
