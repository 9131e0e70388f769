// The mesh of the example.
#ifndef TORUS_HPP
#define TORUS_HPP

#include "decomposition.hpp"

/* A torus of 2 * around * across triangles whose vertices are scattered along it. The same on every machine. */
mesh make_torus(std::uint32_t around, std::uint32_t across);

#endif
