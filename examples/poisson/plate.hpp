// The meshes of the example: a square plate with a round hole.
#ifndef PLATE_HPP
#define PLATE_HPP

#include <array>
#include <cstdint>
#include <vector>

using point = std::array<double, 3>;
using triangle = std::array<std::uint32_t, 3>;

struct mesh {
    std::vector<point> points;
    std::vector<triangle> triangles;
    /* 1 on the outer border and on that of the hole. */
    std::vector<std::uint8_t> on_border;
};

/* Made by gmsh; `size` is the edge length at the outer border, a sixth of that at the hole's. */
mesh make_plate(double size);

/* Shifts every inner vertex at random, as far as no triangle turns over or gets flatter than `least`, which is twice
   the area over the squared size of the triangles around. */
void scatter(mesh &m, double least);

double twice_area(const mesh &m, const triangle &t);

#endif
