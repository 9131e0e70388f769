#include "torus.hpp"

#include <cmath>

namespace {

constexpr double TURN = 6.283185307179586;

/* Shift in units of the distance between grid lines. */
double shift(std::uint32_t &state)
{
    state = state * 1664525u + 1013904223u;
    return ((state >> 8) / 16777216.0 - 0.5) * 0.8;
}

} // namespace

mesh make_torus(std::uint32_t around, std::uint32_t across)
{
    mesh m;
    std::uint32_t state = 2007;
    const auto at = [=](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
    for (std::uint32_t i = 0; i < around; i++) {
        for (std::uint32_t j = 0; j < across; j++) {
            const double u = (i + shift(state)) * TURN / around, v = (j + shift(state)) * TURN / across;
            m.points.push_back({(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
            m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return m;
}
