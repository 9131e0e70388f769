// A mesh as the comparison hands it around.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct Mesh {
    std::vector<double> positions;        // three a vertex
    std::vector<std::uint32_t> triangles; // three a triangle

    std::size_t vertex_count() const { return positions.size() / 3; }
    std::size_t triangle_count() const { return triangles.size() / 3; }
};

// Reads two counts of 64 bits, the positions and the triangles, as they lie in memory. Throws std::runtime_error.
Mesh read_mesh(const std::string& path);

// Writes nothing but the positions. Throws std::runtime_error.
void write_positions(const std::string& path, const std::vector<double>& positions);
