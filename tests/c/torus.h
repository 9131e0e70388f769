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

/* Enclosed volume, summed from the origin. */
double torus_volume(const double positions[3 * TORUS_VERTICES], const uint32_t indices[TORUS_INDICES]);

#ifdef __cplusplus
}
#endif

#endif
