// What is compared: something that holds a mesh and smooths it.
#pragma once

#include "mesh.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

// The constructor of a peer makes room and copies the points, which is not timed.
class Peer {
public:
    virtual ~Peer() = default;
    // Finds out which triangles are neighbours, where that is not part of smoothing but of the peer's form of the mesh:
    // links the halfedges. Timed as adjacency.
    virtual void connect() {}
    // Smooths, with everything else that the peer needs for it: normals, weights, trees, neighbours. Timed.
    virtual void smooth(unsigned iterations) = 0;
    virtual std::vector<double> positions() const = 0;
};

struct Entry {
    std::string name;
    std::function<std::unique_ptr<Peer>(const Mesh&)> build;
};

std::vector<Entry> cgal_entries();
std::vector<Entry> openmesh_entries();
std::vector<Entry> plain_entries();
std::vector<Entry> qsmesh_entries();
