#include "tetrahedra.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_map>

namespace {

constexpr int TETRAHEDRON = 4;

using point = std::array<double, 3>;

point minus(const point &a, const point &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const point &a, const point &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
point cross(const point &a, const point &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/* Smallest angle between two faces of a tetrahedron, degrees. */
double smallest_dihedral(const std::array<point, 4> &p)
{
    double smallest = 180;
    for (int i = 0; i < 4; i++) {
        for (int j = i + 1; j < 4; j++) {
            // The edge is that of the two other corners; the faces are seen along it.
            const int k = i == 0 ? (j == 1 ? 2 : 1) : 0;
            const int l = 6 - i - j - k;
            const point edge = minus(p[l], p[k]);
            const point a = cross(edge, minus(p[i], p[k])), b = cross(edge, minus(p[j], p[k]));
            const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
            smallest = std::min(smallest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::acos(-1.0));
        }
    }
    return smallest;
}

/* Mean ratio of a tetrahedron, 1 for a regular one, 0 for a flat one. */
double mean_ratio(const std::array<point, 4> &p)
{
    double squares = 0;
    for (int i = 0; i < 4; i++) {
        for (int j = i + 1; j < 4; j++) {
            squares += dot(minus(p[i], p[j]), minus(p[i], p[j]));
        }
    }
    const double volume = std::fabs(dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]))) / 6;
    return 12 * std::cbrt(9 * volume * volume) / squares;
}

} // namespace

void print_tetrahedra(const char *name)
{
    std::vector<std::size_t> tags, elements, nodes;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, point> at;
    for (std::size_t v = 0; v < tags.size(); v++) {
        at[tags[v]] = {coordinates[3 * v], coordinates[3 * v + 1], coordinates[3 * v + 2]};
    }
    gmsh::model::mesh::getElementsByType(TETRAHEDRON, elements, nodes);
    std::size_t below = 0;
    double angle = 180, ratio = 1, sum = 0;
    for (std::size_t i = 0; i < nodes.size(); i += 4) {
        const std::array<point, 4> corners{at[nodes[i]], at[nodes[i + 1]], at[nodes[i + 2]], at[nodes[i + 3]]};
        const double smallest = smallest_dihedral(corners), quality = mean_ratio(corners);
        below += smallest < 20;
        angle = std::min(angle, smallest);
        ratio = std::min(ratio, quality);
        sum += quality;
    }
    std::printf("%s: %zu tetrahedra, dihedral min %.2f, below 20: %zu, mean ratio min %.4f mean %.4f\n", name,
                elements.size(), angle, below, ratio, sum / static_cast<double>(elements.size()));
}
