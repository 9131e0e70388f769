// The surface mesh of a CAD part, from gmsh and back into it.
#ifndef SURFACE_HPP
#define SURFACE_HPP

#include <array>
#include <cstdint>
#include <map>
#include <vector>

using point = std::array<double, 3>;
using triangle = std::array<std::uint32_t, 3>;

/* The mesh of all faces of the part, numbered from 0. */
struct surface {
    std::vector<std::size_t> tags;
    std::vector<point> points;
    std::vector<triangle> triangles;
    /* CAD face of each triangle, and whether the part lies on the other side of it than its normal says. */
    std::vector<int> faces;
    std::map<int, bool> turned;
    std::vector<std::uint8_t> on_edges;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

/* The mesh of all faces of the part `part` of gmsh's current model. */
surface read_surface(int part);

/* Replaces the mesh of all faces. Nodes on CAD edges stay as they are in gmsh, others are put onto their CAD face. */
void write_surface(const surface &s);

#endif
