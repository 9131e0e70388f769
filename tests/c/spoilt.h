/* A torus with a few very bad triangles. */
#ifndef SPOILT_H
#define SPOILT_H

#include "torus.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    /* Vertices moved almost onto a neighbour. */
    SPOILT_NEEDLES = 6,
    /* Triangles with a vertex put into their middle, and their three edges to be marked as features: only removing that
       vertex makes them good again. */
    SPOILT_CENTRES = 8,
    SPOILT_VERTICES = TORUS_VERTICES + SPOILT_CENTRES,
    SPOILT_INDICES = TORUS_INDICES + 6 * SPOILT_CENTRES,
    SPOILT_TRIANGLES = SPOILT_INDICES / 3,
    SPOILT_EDGES = 3 * SPOILT_CENTRES
};

/* The centres are the first vertices, so that all others get new numbers where these are removed. */
void spoilt(double positions[3 * SPOILT_VERTICES], uint32_t indices[SPOILT_INDICES], uint32_t edges[2 * SPOILT_EDGES]);

/* Vertex of the torus, counted without the centres, at which the given bad place is: needles first. */
uint32_t spoilt_at(uint32_t place);

#ifdef __cplusplus
}
#endif

#endif
