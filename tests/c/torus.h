/* A closed test mesh: a torus whose vertices are shifted at random along its surface. */
#ifndef TORUS_H
#define TORUS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    TORUS_AROUND = 48,
    TORUS_ACROSS = 24,
    TORUS_VERTICES = TORUS_AROUND * TORUS_ACROSS,
    TORUS_INDICES = 6 * TORUS_VERTICES
};

/* Radii 2 and 1; the same in every run. */
void torus(double positions[3 * TORUS_VERTICES], uint32_t indices[TORUS_INDICES]);

/* The same, each vertex shifted by the given share of what torus shifts it. */
void shifted_torus(double positions[3 * TORUS_VERTICES], uint32_t indices[TORUS_INDICES], double share);

/* Enclosed volume of any mesh, summed from the origin. */
double enclosed_volume(const double *positions, const uint32_t *indices, size_t index_count);

/* Enclosed volume of a torus. */
double torus_volume(const double positions[3 * TORUS_VERTICES], const uint32_t indices[TORUS_INDICES]);

#ifdef __cplusplus
}
#endif

#endif
