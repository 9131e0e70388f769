#include "spoilt.h"

uint32_t spoilt_at(uint32_t place)
{
    return (2 + 3 * place) * TORUS_ACROSS + 3 + 5 * (place % 4);
}

static void make_needle(double *torus_positions, uint32_t at)
{
    double *vertex = torus_positions + 3 * at;
    size_t k;
    for (k = 0; k < 3; k++) {
        vertex[k] = vertex[k + 3] + 0.02 * (vertex[k] - vertex[k + 3]);
    }
}

static void put_centre(double *positions, uint32_t centre, const uint32_t *triangle)
{
    size_t k;
    for (k = 0; k < 3; k++) {
        positions[3 * centre + k] =
            (positions[3 * triangle[0] + k] + positions[3 * triangle[1] + k] + positions[3 * triangle[2] + k]) / 3.0;
    }
}

/* Triangle a, b, c becomes a, b, centre; the other two are added. */
static void cut(uint32_t *triangle, uint32_t *added, uint32_t centre, uint32_t *edges)
{
    size_t k;
    for (k = 0; k < 3; k++) {
        edges[2 * k] = triangle[k];
        edges[2 * k + 1] = triangle[(k + 1) % 3];
    }
    added[0] = edges[2];
    added[1] = edges[3];
    added[3] = edges[4];
    added[4] = edges[5];
    triangle[2] = added[2] = added[5] = centre;
}

void spoilt(double positions[3 * SPOILT_VERTICES], uint32_t indices[SPOILT_INDICES], uint32_t edges[2 * SPOILT_EDGES])
{
    uint32_t n;
    shifted_torus(positions + 3 * SPOILT_CENTRES, indices, 0.2);
    for (n = 0; n < TORUS_INDICES; n++) {
        indices[n] += SPOILT_CENTRES;
    }
    for (n = 0; n < SPOILT_NEEDLES; n++) {
        make_needle(positions + 3 * SPOILT_CENTRES, spoilt_at(n));
    }
    for (n = 0; n < SPOILT_CENTRES; n++) {
        uint32_t *triangle = indices + 6 * spoilt_at(SPOILT_NEEDLES + n);
        put_centre(positions, n, triangle);
        cut(triangle, indices + TORUS_INDICES + 6 * n, n, edges + 6 * n);
    }
}
