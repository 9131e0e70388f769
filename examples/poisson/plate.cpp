#include "plate.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <unordered_map>

namespace {

constexpr int LINE = 1, TRIANGLE = 2;

void describe_plate(double size)
{
    namespace occ = gmsh::model::occ;
    gmsh::clear();
    gmsh::model::add("plate");
    occ::addRectangle(-1, -1, 0, 2, 2, 1);
    occ::addDisk(0, 0, 0, 0.3, 0.3, 2);
    gmsh::vectorpair plate;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{2, 1}}, {{2, 2}}, plate, map);
    occ::synchronize();
    gmsh::vectorpair corners, hole;
    gmsh::model::getEntities(corners, 0);
    gmsh::model::mesh::setSize(corners, size);
    gmsh::model::getEntitiesInBoundingBox(-0.4, -0.4, -0.1, 0.4, 0.4, 0.1, hole, 0);
    gmsh::model::mesh::setSize(hole, size / 6);
}

/* Nodes of all elements of a type, one element after the other. */
std::vector<std::size_t> nodes_of(int type)
{
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(type, elements, nodes);
    return nodes;
}

/* For each vertex the triangles around it. */
std::vector<std::vector<std::size_t>> triangles_around(const mesh &m)
{
    std::vector<std::vector<std::size_t>> around(m.points.size());
    for (std::size_t t = 0; t < m.triangles.size(); t++) {
        for (const std::uint32_t v : m.triangles[t]) {
            around[v].push_back(t);
        }
    }
    return around;
}

} // namespace

mesh make_plate(double size)
{
    describe_plate(size);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::model::mesh::generate(2);
    mesh m;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::unordered_map<std::size_t, std::uint32_t> numbers;
    for (std::size_t v = 0; v < tags.size(); v++) {
        m.points.push_back({coordinates[3 * v], coordinates[3 * v + 1], 0});
        numbers.emplace(tags[v], static_cast<std::uint32_t>(v));
    }
    const std::vector<std::size_t> corners = nodes_of(TRIANGLE);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        m.triangles.push_back({numbers[corners[i]], numbers[corners[i + 1]], numbers[corners[i + 2]]});
    }
    m.on_border.assign(m.points.size(), 0);
    for (const std::size_t node : nodes_of(LINE)) {
        m.on_border[numbers[node]] = 1;
    }
    return m;
}

void scatter(mesh &m, double least)
{
    const auto around = triangles_around(m);
    std::mt19937 random(2007);
    const auto shift = [&random] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (std::size_t v = 0; v < m.points.size(); v++) {
        double size = 0;
        for (const std::size_t t : around[v]) {
            size = std::max(size, std::sqrt(twice_area(m, m.triangles[t])));
        }
        const point from = m.points[v];
        const auto is_flat = [&](std::size_t t) { return twice_area(m, m.triangles[t]) < least * size * size; };
        for (double step = m.on_border[v] ? 0 : 2 * size; step > 0.01 * size; step *= 0.7) {
            m.points[v] = {from[0] + step * shift(), from[1] + step * shift(), 0};
            if (std::none_of(around[v].begin(), around[v].end(), is_flat)) {
                break;
            }
            m.points[v] = from;
        }
    }
}

double twice_area(const mesh &m, const triangle &t)
{
    const point &a = m.points[t[0]], &b = m.points[t[1]], &c = m.points[t[2]];
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
