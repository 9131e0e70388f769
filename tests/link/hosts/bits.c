/* Improves an OBJ file of nothing but vertices and triangles through the C calls: bits IN OUT */
#include <qsmesh.h>

#include "check.h"

static double *positions;
static uint32_t *indices;
static size_t vertex_count, index_count;

static void read_mesh(FILE *file)
{
    char line[256];
    unsigned long corner[3];
    size_t room = 0, index_room = 0, k;
    while (fgets(line, (int)sizeof line, file) != NULL) {
        if (line[0] == 'v') {
            if (vertex_count == room) {
                room = 2 * room + 1024;
                positions = (double *)realloc(positions, 3 * room * sizeof *positions);
                CHECK(positions != NULL);
            }
            CHECK(sscanf(line + 1, "%lf %lf %lf", positions + 3 * vertex_count, positions + 3 * vertex_count + 1,
                         positions + 3 * vertex_count + 2) == 3);
            vertex_count++;
        } else if (line[0] == 'f') {
            if (index_count == index_room) {
                index_room = 2 * index_room + 3072;
                indices = (uint32_t *)realloc(indices, index_room * sizeof *indices);
                CHECK(indices != NULL);
            }
            CHECK(sscanf(line + 1, "%lu %lu %lu", corner, corner + 1, corner + 2) == 3);
            for (k = 0; k < 3; k++) {
                indices[index_count++] = (uint32_t)(corner[k] - 1);
            }
        }
    }
}

static void write_mesh(FILE *file)
{
    size_t i;
    for (i = 0; i < vertex_count; i++) {
        fprintf(file, "v %.17g %.17g %.17g\n", positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    }
    for (i = 0; i < index_count; i += 3) {
        fprintf(file, "f %lu %lu %lu\n", (unsigned long)indices[i] + 1, (unsigned long)indices[i + 1] + 1,
                (unsigned long)indices[i + 2] + 1);
    }
}

int main(int argc, char **argv)
{
    FILE *file;
    qsm_options options;
    CHECK(argc == 3);
    file = fopen(argv[1], "r");
    CHECK(file != NULL);
    read_mesh(file);
    fclose(file);
    qsm_options_init(&options);
    options.iterations = 3;
    options.feature_angle = 40;
    options.tail_min_angle = 25;
    CHECK(qsm_improve_f64(positions, &vertex_count, 3 * sizeof(double), indices, &index_count, &options, NULL, NULL) ==
          QSM_OK);
    file = fopen(argv[2], "w");
    CHECK(file != NULL);
    write_mesh(file);
    CHECK(fclose(file) == 0);
    free(positions);
    free(indices);
    return 0;
}
