// A mesh cut into parts, so that each can be smoothed where it is and all together come out as one mesh would.
//
// A vertex belongs to the lowest part among those of its triangles, its owner. It is on the interface if its triangles
// are in several parts. A part holds every triangle around the vertices that it owns, and every triangle around the
// vertices of these: a move looks at the triangles around a vertex and at those across their edges, to tell a fold. The
// vertices of its neighbours that it holds thereby are never moved by it.
#ifndef DECOMPOSITION_HPP
#define DECOMPOSITION_HPP

#include <array>
#include <cstdint>
#include <vector>

using point = std::array<double, 3>;
using triangle = std::array<std::uint32_t, 3>;

struct mesh {
    std::vector<point> points;
    std::vector<triangle> triangles;
};

struct cut {
    int parts;
    /* By vertex of the whole mesh. */
    std::vector<int> owner;
    std::vector<std::uint8_t> on_interface;
};

/* What one process needs of one part. */
struct part {
    int number;
    mesh local;
    /* By local vertex. Global numbers rise, so that local vertices are visited in the order of the whole mesh. */
    std::vector<std::uint32_t> global;
    std::vector<std::uint8_t> inner_lock, interface_lock;
};

/* Cuts by METIS into parts of about as many triangles each, with short borders. */
cut cut_by_metis(const mesh &whole, int parts);

part make_part(const mesh &whole, const cut &c, int number);

/* For each part the vertices that it owns and another part holds, by global number, rising. */
std::vector<std::vector<std::uint32_t>> shared_vertices(const cut &c, const std::vector<part> &parts);

#endif
