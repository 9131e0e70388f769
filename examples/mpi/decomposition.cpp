#include "decomposition.hpp"

#include <metis.h>

#include <algorithm>
#include <stdexcept>

namespace {

std::vector<idx_t> part_of_triangles(const mesh &whole, int parts)
{
    std::vector<idx_t> part(whole.triangles.size(), 0), part_of_nodes(whole.points.size(), 0);
    if (parts == 1) {
        return part;
    }
    std::vector<idx_t> starts{0}, corners;
    for (const triangle &t : whole.triangles) {
        corners.insert(corners.end(), t.begin(), t.end());
        starts.push_back(static_cast<idx_t>(corners.size()));
    }
    auto triangles = static_cast<idx_t>(whole.triangles.size());
    auto vertices = static_cast<idx_t>(whole.points.size());
    idx_t edge = 2, count = parts, cut_edges = 0;
    if (METIS_PartMeshDual(&triangles, &vertices, starts.data(), corners.data(), nullptr, nullptr, &edge, &count,
                           nullptr, nullptr, &cut_edges, part.data(), part_of_nodes.data()) != METIS_OK) {
        throw std::runtime_error("METIS could not partition the mesh");
    }
    return part;
}

/* Adds the vertices of all triangles that have a vertex among the marked ones; says which triangles these are. */
std::vector<triangle> widen(const mesh &whole, std::vector<std::uint8_t> &marked)
{
    const std::vector<std::uint8_t> before = marked;
    std::vector<triangle> touched;
    for (const triangle &t : whole.triangles) {
        if (before[t[0]] || before[t[1]] || before[t[2]]) {
            touched.push_back(t);
            marked[t[0]] = marked[t[1]] = marked[t[2]] = 1;
        }
    }
    return touched;
}

void renumber(part &p)
{
    for (triangle &t : p.local.triangles) {
        for (std::uint32_t &v : t) {
            v = static_cast<std::uint32_t>(std::lower_bound(p.global.begin(), p.global.end(), v) - p.global.begin());
        }
    }
}

} // namespace

cut cut_by_metis(const mesh &whole, int parts)
{
    const std::vector<idx_t> part = part_of_triangles(whole, parts);
    cut c{parts, std::vector<int>(whole.points.size(), parts), std::vector<std::uint8_t>(whole.points.size(), 0)};
    for (std::size_t t = 0; t < part.size(); t++) {
        for (const std::uint32_t v : whole.triangles[t]) {
            const bool is_first = c.owner[v] == parts;
            c.on_interface[v] |= !is_first && c.owner[v] != part[t];
            c.owner[v] = std::min(c.owner[v], static_cast<int>(part[t]));
        }
    }
    return c;
}

part make_part(const mesh &whole, const cut &c, int number)
{
    part p;
    p.number = number;
    std::vector<std::uint8_t> held(whole.points.size(), 0);
    for (std::size_t v = 0; v < held.size(); v++) {
        held[v] = c.owner[v] == number;
    }
    widen(whole, held);
    p.local.triangles = widen(whole, held);
    for (std::uint32_t v = 0; v < held.size(); v++) {
        if (held[v]) {
            p.global.push_back(v);
            p.local.points.push_back(whole.points[v]);
            p.inner_lock.push_back(c.owner[v] != number || c.on_interface[v]);
            p.interface_lock.push_back(c.owner[v] != number || !c.on_interface[v]);
        }
    }
    renumber(p);
    return p;
}

std::vector<std::vector<std::uint32_t>> shared_vertices(const cut &c, const std::vector<part> &parts)
{
    std::vector<std::uint8_t> is_shared(c.owner.size(), 0);
    for (const part &p : parts) {
        for (const std::uint32_t v : p.global) {
            is_shared[v] |= c.owner[v] != p.number;
        }
    }
    std::vector<std::vector<std::uint32_t>> shared(parts.size());
    for (std::uint32_t v = 0; v < is_shared.size(); v++) {
        if (is_shared[v]) {
            shared[static_cast<std::size_t>(c.owner[v])].push_back(v);
        }
    }
    return shared;
}
