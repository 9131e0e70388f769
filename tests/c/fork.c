/* A program that forks: the child calls the library as the parent does, and gets the same bits. */
#define _POSIX_C_SOURCE 200112L
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"
#include "qsmesh.h"

/* Enough vertices for a call to use threads. */
enum { AROUND = 210, ACROSS = 200, VERTICES = AROUND * ACROSS, INDICES = 6 * (AROUND - 1) * (ACROSS - 1) };

static double before[3 * VERTICES], expected[3 * VERTICES], found[3 * VERTICES];
static uint32_t indices[INDICES];

/* An uneven grid on a curved surface. */
static void make(void)
{
    size_t i, j, corner = 0;
    for (i = 0; i < AROUND; i++) {
        for (j = 0; j < ACROSS; j++) {
            double *p = before + 3 * (i * ACROSS + j);
            p[0] = (double)i + 0.3 * (double)(i * j % 7) / 7.0;
            p[1] = (double)j + 0.3 * (double)((i + 3 * j) % 5) / 5.0;
            p[2] = 0.001 * (p[0] * p[0] + p[1] * p[1]);
        }
    }
    for (i = 0; i + 1 < AROUND; i++) {
        for (j = 0; j + 1 < ACROSS; j++) {
            uint32_t a = (uint32_t)(i * ACROSS + j), b = a + ACROSS;
            indices[corner++] = a, indices[corner++] = b, indices[corner++] = b + 1;
            indices[corner++] = a, indices[corner++] = b + 1, indices[corner++] = a + 1;
        }
    }
}

static void smooth(double *positions)
{
    qsm_options options;
    qsm_options_init(&options);
    options.threads = 2;
    memcpy(positions, before, sizeof before);
    CHECK(qsm_smooth_f64(positions, VERTICES, 24, indices, INDICES, &options, NULL) == QSM_OK);
}

int main(void)
{
    pid_t child;
    int status;
    make();
    smooth(expected);
    CHECK(memcmp(expected, before, sizeof before) != 0);
    child = fork();
    CHECK(child >= 0);
    smooth(found);
    CHECK(memcmp(found, expected, sizeof expected) == 0);
    if (child == 0) {
        return 0;
    }
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    return 0;
}
