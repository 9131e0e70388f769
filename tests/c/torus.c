#include "torus.h"

#include <math.h>

static const double TURN = 6.283185307179586;

/* Shift of a vertex in units of the distance between grid lines, -0.35 to 0.35. */
static double shift(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return ((double)(*state >> 8) / 16777216.0 - 0.5) * 0.7;
}

static void place(double *vertex, double around, double across)
{
    double radius = 2.0 + cos(across);
    vertex[0] = radius * cos(around);
    vertex[1] = radius * sin(around);
    vertex[2] = sin(across);
}

static void cut_cell(uint32_t *cell, uint32_t i, uint32_t j)
{
    uint32_t next_i = (i + 1) % TORUS_AROUND;
    uint32_t next_j = (j + 1) % TORUS_ACROSS;
    uint32_t a = i * TORUS_ACROSS + j;
    uint32_t b = next_i * TORUS_ACROSS + j;
    uint32_t c = next_i * TORUS_ACROSS + next_j;
    uint32_t d = i * TORUS_ACROSS + next_j;
    cell[0] = a;
    cell[1] = b;
    cell[2] = c;
    cell[3] = a;
    cell[4] = c;
    cell[5] = d;
}

void torus(double positions[3 * TORUS_VERTICES], uint32_t indices[TORUS_INDICES])
{
    shifted_torus(positions, indices, 1.0);
}

void shifted_torus(double positions[3 * TORUS_VERTICES], uint32_t indices[TORUS_INDICES], double share)
{
    uint32_t state = 2007u;
    uint32_t i, j;
    for (i = 0; i < TORUS_AROUND; i++) {
        for (j = 0; j < TORUS_ACROSS; j++) {
            uint32_t v = i * TORUS_ACROSS + j;
            double around = (i + share * shift(&state)) * TURN / TORUS_AROUND;
            double across = (j + share * shift(&state)) * TURN / TORUS_ACROSS;
            place(positions + 3 * v, around, across);
            cut_cell(indices + 6 * v, i, j);
        }
    }
}

double torus_volume(const double positions[3 * TORUS_VERTICES], const uint32_t indices[TORUS_INDICES])
{
    return enclosed_volume(positions, indices, TORUS_INDICES);
}

double enclosed_volume(const double *positions, const uint32_t *indices, size_t index_count)
{
    double sum = 0.0;
    size_t t;
    for (t = 0; t < index_count; t += 3) {
        const double *a = positions + 3 * indices[t];
        const double *b = positions + 3 * indices[t + 1];
        const double *c = positions + 3 * indices[t + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6.0;
}
