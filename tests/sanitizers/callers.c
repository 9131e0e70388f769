/* Many callers at once: each improves a mesh of its own with several threads, and measures one that all have in common.
   Usage: callers THREADS, the number of threads of a call. Compiled with VALGRIND it is small, and a call is made before the
   others start: helgrind and drd take for a race how Rust's standard library makes something once for all. */
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "../c/check.h"
#include "qsmesh.h"

#ifdef VALGRIND
enum { AROUND = 60, ACROSS = 40 };
#else
/* Enough vertices for a call to use two threads. */
enum { AROUND = 320, ACROSS = 126 };
#endif
enum { VERTICES = AROUND * ACROSS, INDICES = 6 * VERTICES, CALLERS = 3 };

struct mesh {
    double positions[3 * VERTICES];
    uint32_t indices[INDICES];
    size_t vertex_count, index_count;
};

static struct mesh common, own[CALLERS];
static qsm_measurement expected;
static uint32_t threads_of_a_call;

/* A torus with every vertex off its place, by another amount for another seed. */
static void make(struct mesh *mesh, unsigned seed)
{
    const double turn = 6.283185307179586;
    size_t i, j, corner = 0;
    for (i = 0; i < AROUND; i++) {
        for (j = 0; j < ACROSS; j++) {
            size_t right = (i + 1) % AROUND, up = (j + 1) % ACROSS;
            double u, v, *p = mesh->positions + 3 * (i * ACROSS + j);
            uint32_t a = (uint32_t)(i * ACROSS + j), b = (uint32_t)(right * ACROSS + j);
            uint32_t c = (uint32_t)(right * ACROSS + up), d = (uint32_t)(i * ACROSS + up);
            uint32_t cell[6];
            seed = seed * 1664525u + 1013904223u;
            u = turn * ((double)i + (seed >> 16) % 1000 * 4e-4) / AROUND;
            seed = seed * 1664525u + 1013904223u;
            v = turn * ((double)j + (seed >> 16) % 1000 * 4e-4) / ACROSS;
            p[0] = (3.0 + cos(v)) * cos(u);
            p[1] = (3.0 + cos(v)) * sin(u);
            p[2] = sin(v);
            cell[0] = a, cell[1] = b, cell[2] = c, cell[3] = a, cell[4] = c, cell[5] = d;
            memcpy(mesh->indices + corner, cell, sizeof cell);
            corner += 6;
        }
    }
    mesh->vertex_count = VERTICES;
    mesh->index_count = INDICES;
}

static void improve(struct mesh *mesh, uint32_t threads)
{
    qsm_options options;
    qsm_options_init(&options);
    options.threads = threads;
    options.iterations = 1;
    options.tail_operations = 5;
    CHECK(qsm_improve_f64(mesh->positions, &mesh->vertex_count, 24, mesh->indices, &mesh->index_count, &options, NULL,
                          NULL) == QSM_OK);
}

static void *call(void *mesh)
{
    qsm_measurement found;
    improve(mesh, threads_of_a_call);
    qsm_measurement_init(&found);
    CHECK(qsm_measure_f64(common.positions, VERTICES, 24, common.indices, INDICES, &found) == QSM_OK);
    CHECK(found.volume == expected.volume && found.edge_ratio.mean == expected.edge_ratio.mean);
    return NULL;
}

int main(int count, char **arguments)
{
    static struct mesh alone;
    pthread_t callers[CALLERS];
    size_t k;
    CHECK(count == 2);
    threads_of_a_call = (uint32_t)strtoul(arguments[1], NULL, 10);
    make(&common, 77);
    qsm_measurement_init(&expected);
    CHECK(qsm_measure_f64(common.positions, VERTICES, 24, common.indices, INDICES, &expected) == QSM_OK);
#ifdef VALGRIND
    make(&alone, 1);
    improve(&alone, 1);
#endif
    for (k = 0; k < CALLERS; k++) {
        make(&own[k], (unsigned)k);
        CHECK(pthread_create(&callers[k], NULL, call, &own[k]) == 0);
    }
    for (k = 0; k < CALLERS; k++) {
        CHECK(pthread_join(callers[k], NULL) == 0);
    }
    make(&alone, 1);
    improve(&alone, 1);
    CHECK(alone.vertex_count == own[1].vertex_count);
    CHECK(memcmp(alone.positions, own[1].positions, 24 * alone.vertex_count) == 0);
    return 0;
}
